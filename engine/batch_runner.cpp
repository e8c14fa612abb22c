#include <engine/batch_runner.hpp>
#include <engine/stopwatch.hpp>

namespace nearfield {

BatchRunner::BatchRunner(const plan::PlanLimits& limits, const char* gradient_format,
                         Renderer& renderer)
    : renderer_(&renderer),
      planner_(limits),
      builder_(limits.subpixel),
      decoder_(gradient_format) {}

void BatchRunner::run(std::span<const AnyQuery> queries, const plan::FindShape& find_shape,
                      Results& results) {
    Timings& timings = results.timings;
    const Stopwatch plan_start;
    planner_.plan(queries, find_shape, plan_, results.results);
    timings.localize += planner_.localize_milliseconds();
    timings.plan += plan_start.milliseconds() - planner_.localize_milliseconds();

    builder_.begin_batch();
    decoder_.begin_batch(plan_);
    for (std::uint32_t number = 0; number < plan_.rounds; ++number) {
        const Stopwatch build_start;
        builder_.build(plan_, number, round_);
        timings.plan += build_start.milliseconds();
        renderer_->render(round_, plan_.extent, timings);

        const Stopwatch decode_start;
        decoder_.add_points(round_, renderer_->points());
        decoder_.add_field(plan_, round_, renderer_->field_words(), results.results);
        ResultDecoder::add_summaries(plan_, round_, renderer_->summaries(), results.results);
        decoder_.add_samples(plan_, round_, renderer_->samples());
        timings.decode += decode_start.milliseconds();
    }
    const Stopwatch decode_start;
    decoder_.finish(plan_, results.results);
    timings.decode += decode_start.milliseconds();
}

}  // namespace nearfield
