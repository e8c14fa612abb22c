// The rows of the table of a GPU, and how each way does its work.

#include <nearfield/world.hpp>
#include <nearfield/world_device.hpp>

#include <tools/benchmark/crowds.hpp>
#include <tools/benchmark/objects.hpp>
#include <tools/benchmark/outlines.hpp>
#include <tools/benchmark/questions.hpp>
#include <tools/cli/gpu_times.hpp>
#include <tools/common/add_shape.hpp>
#include <tools/common/library_error.hpp>
#include <tools/common/scene_runner.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace nearfield::tools {
namespace {

constexpr double crowd_tolerance = 0.01;

/// One batch a frame, as of `nearfield bench --scene --keep`.
class BatchWork : public GpuWork {
public:
    BatchWork(Scene scene, Technique technique, Context& context) : scene_(std::move(scene)) {
        set_technique(scene_, technique);
        runner_.emplace(scene_, "bench", context);
    }

    void run_frame() override {
        runner_->run_frame(FrameInput::poses);
        runner_->require_results();
    }
    [[nodiscard]] const Timings& timings() const override { return runner_->timings(); }
    [[nodiscard]] std::uint64_t pairs() const override { return runner_->pair_count(); }
    [[nodiscard]] std::uint64_t found() const override {
        std::uint64_t found = 0;
        for (const SceneAnswer& answer : runner_->answers()) {
            if (const auto* const points = std::get_if<PenetrationResult>(&answer.result)) {
                found += points->count;
            }
        }
        return found;
    }

private:
    Scene scene_;
    std::optional<SceneRunner> runner_;
};

/// A world of which the device finds the pairs.
class DevicePairWork : public GpuWork {
public:
    DevicePairWork(const Scene& scene, bool reads_rows, Context& context)
        : context_(context),
          world_(take(World::create(context))),
          table_({.tolerance = crowd_tolerance, .records = false}),
          reads_rows_(reads_rows) {
        for (const SceneShape& shape : scene.shapes) {
            shapes_.push_back(take(add_shape(context, shape.rings, shape.deviation)));
        }
        for (const SceneInstance& instance : scene.instances) {
            poses_.push_back(instance.pose);
            handles_.push_back(
                take(world_.add({.shape = shapes_[instance.shape], .pose = instance.pose})));
        }
    }
    ~DevicePairWork() override {
        for (const ShapeHandle shape : shapes_) {
            static_cast<void>(context_.remove_shape(shape));  // fails only for an unknown shape
        }
    }
    DevicePairWork(const DevicePairWork&) = delete;
    DevicePairWork& operator=(const DevicePairWork&) = delete;

    void run_frame() override {
        for (Pose& pose : poses_) {
            pose.translation.x =
                std::nextafter(pose.translation.x, std::numeric_limits<double>::infinity());
        }
        require(world_.move(handles_, poses_), "bench");
        require(world_.update(table_), "bench");
        if (reads_rows_) {
            found_ = 0;
            for (std::uint32_t i = 0; i < table_.size(); ++i) {
                found_ += take(table_.row(i)).count;
            }
        }
    }
    [[nodiscard]] const Timings& timings() const override { return table_.timings(); }
    [[nodiscard]] std::uint64_t pairs() const override { return table_.candidates(); }
    [[nodiscard]] std::uint64_t found() const override { return found_; }

private:
    Context& context_;
    World world_;
    DevicePairTable<PenetrationQuery> table_;
    bool reads_rows_;
    std::vector<ShapeHandle> shapes_;
    std::vector<InstanceHandle> handles_;
    std::vector<Pose> poses_;
    std::uint64_t found_ = 0;
};

GpuRowPlan::Way batch_way(const char* name, Technique technique, std::function<Scene()> scene) {
    return {name, [technique, scene = std::move(scene)](Context& context) {
                return std::make_unique<BatchWork>(scene(), technique, context);
            }};
}

GpuRowPlan crowd_row(std::size_t objects) {
    const auto scene = [objects] {
        QueryRequest request = benchmark::boundary_penetration(crowd_tolerance);
        request.records = false;
        return benchmark::asked(benchmark::crowd_scene(objects), request, benchmark::Pairs::all);
    };
    const auto of_world = [objects](bool reads_rows) {
        return [objects, reads_rows](Context& context) {
            return std::make_unique<DevicePairWork>(benchmark::crowd_scene(objects), reads_rows,
                                                    context);
        };
    };
    return {"crowd of " + std::to_string(objects) + " objects",
            true,
            0,
            {batch_way("cpu", Technique::cpu, scene),
             batch_way("raster", Technique::raster, scene),
             batch_way("compute", Technique::compute, scene),
             {"device pairs", of_world(false)},
             {"device pairs, read", of_world(true)}}};
}

GpuRowPlan field_row(std::size_t cells) {
    const auto scene = [cells] {
        constexpr double window = 3.0;
        Scene alone;
        benchmark::add_object(alone, {benchmark::coast(1, 8000)}, {});
        return benchmark::asked(std::move(alone), benchmark::square_field({}, window, cells), 0, 0);
    };
    return {"field " + std::to_string(cells) + " x " + std::to_string(cells),
            false,
            std::uint64_t{cells} * cells,
            {batch_way("cpu", Technique::cpu, scene), batch_way("raster", Technique::raster, scene),
             batch_way("compute", Technique::compute, scene)}};
}

}  // namespace

std::vector<GpuRowPlan> gpu_rows() {
    std::vector<GpuRowPlan> rows;
    for (const std::size_t objects : {420U, 1000U, 4200U, 12'500U, 42'000U}) {
        rows.push_back(crowd_row(objects));
    }
    for (const std::size_t cells : {256U, 512U, 1024U, 2048U, 4096U}) {
        rows.push_back(field_row(cells));
    }
    return rows;
}

}  // namespace nearfield::tools
