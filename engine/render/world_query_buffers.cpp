#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/render/search_memory.hpp>
#include <engine/render/world_query_buffers.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace nearfield::render {
namespace {

constexpr std::array<const char*, 1> names_of_query_sets{"nearfield world query set"};

struct Sizes {
    std::uint64_t question;
    std::uint64_t answer;
};

Sizes sizes_of(plan::WorldQuestion question) {
    switch (question) {
        case plan::WorldQuestion::rays:
            return {sizeof(plan::RayData), sizeof(plan::RayAnswerData)};
        case plan::WorldQuestion::nearest:
            return {sizeof(plan::NearestData), sizeof(plan::NearestAnswerData)};
        case plan::WorldQuestion::poses:
            break;
    }
    return {sizeof(plan::PoseData), sizeof(std::uint32_t)};
}

}  // namespace

WorldQueryBuffers::WorldQueryBuffers(const gpu::Device& device, const passes::ComputeLayout& layout,
                                     plan::WorldQuestion question, bool timestamps)
    : device_(&device),
      layout_(&layout),
      question_bytes_(sizes_of(question).question),
      answer_bytes_(sizes_of(question).answer),
      submission_(device),
      timestamps_(device, passes::WorldQueries::max_passes, timestamps),
      world_(device),
      questions_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
                 "nearfield world questions"),
      scratch_(device, scratch_usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::Direction::none,
               "nearfield world query scratch"),
      answers_(device, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::Direction::readback,
               "nearfield world answers"),
      sets_(device, layout, names_of_query_sets) {
    item_.set = sets_[0];
}

WorldQueryBuffers::~WorldQueryBuffers() {
    if (is_submitted_) {
        submission_.wait_to_the_end();
    }
}

std::byte* WorldQueryBuffers::reserve(std::uint64_t count, std::uint64_t memory_limit) {
    ScratchLayout layout;
    item_.push.boxes = layout.units(units_of_boxes(world_.count()));
    const std::uint64_t first_answer = layout.bytes();
    const std::uint64_t reached = device_->limits().maxStorageBufferRange;
    // Divided first: no count overflows.
    const bool is_possible = count <= reached / std::max(question_bytes_, answer_bytes_);
    const std::uint64_t questions = is_possible ? count * question_bytes_ : 0;
    const std::uint64_t answers = is_possible ? count * answer_bytes_ : 0;
    const std::uint64_t scratch = first_answer + answers;
    if (!is_possible || scratch > reached || scratch + questions + answers > memory_limit) {
        throw StatusException(
            {StatusCode::too_large, "there are " + std::to_string(count) + " questions about " +
                                        std::to_string(world_.count()) + " instances, each of " +
                                        std::to_string(question_bytes_) + " bytes and with " +
                                        std::to_string(answer_bytes_) +
                                        " bytes of answers; Settings::memory_limit is " +
                                        std::to_string(memory_limit) + ", and shaders reach " +
                                        std::to_string(reached) + " of a buffer"});
    }
    item_.push.count = static_cast<std::uint32_t>(count);
    item_.push.answers = static_cast<std::uint32_t>(first_answer / plan::bytes_of_unit);
    item_.copy = {first_answer, 0, answers};
    const bool is_new_scratch = reserve_with_texels(*device_, scratch_, scratch_texels_, scratch,
                                                    "nearfield world query scratch texels");
    const bool are_new_questions = questions_.reserve(questions);
    const bool are_new_answers = answers_.reserve(answers);
    is_bound_ = is_bound_ && !is_new_scratch && !are_new_questions && !are_new_answers;
    return questions_.data();
}

void WorldQueryBuffers::bind() {
    using Layout = passes::ComputeLayout;
    layout_->begin_updates();
    world_.write_bindings(*layout_, item_.set);
    const std::uint64_t reached = device_->limits().maxStorageBufferRange;
    const auto write = [&](Layout::Binding binding, const gpu::MappedBuffer& buffer) {
        layout_->write_buffer(item_.set, binding, buffer.handle(), 0,
                              std::min(buffer.capacity(), reached));
    };
    write(Layout::geometry, scratch_);
    layout_->write_texels(item_.set, Layout::scratch_texels, scratch_texels_.get());
    write(Layout::output, questions_);
    layout_->end_updates();
    item_.shapes = world_.shapes().handle();
    item_.instances = world_.instances();
    item_.questions = questions_.handle();
    item_.scratch = scratch_.handle();
    item_.answers = answers_.handle();
    bound_world_ = world_.revision();
    is_bound_ = true;
}

void WorldQueryBuffers::begin(const passes::WorldQueries& passes, const plan::SearchShapes& shapes,
                              const plan::WorldQueryPush& push, Timings& timings) {
    const Stopwatch start;
    checkpoint();
    world_.upload(shapes);
    questions_.flush();
    if (!is_bound_ || bound_world_ != world_.revision()) {
        is_bound_ = false;
        bind();
    }
    const plan::WorldQueryPush placed = item_.push;
    item_.push = push;
    item_.push.instances = world_.count();
    item_.push.boxes = placed.boxes;
    item_.push.answers = placed.answers;
    item_.push.count = placed.count;
    VkCommandBuffer commands = submission_.begin();
    timestamps_.reset(commands);
    passes.record(commands, timestamps_, item_);
    submission_.submit();
    is_submitted_ = true;
    timings.record += start.milliseconds();
}

void WorldQueryBuffers::finish(Timings& timings) {
    const Stopwatch waiting;
    submission_.wait();
    is_submitted_ = false;
    answers_.invalidate();
    timings.device += waiting.milliseconds();
    timestamps_.collect(timings.passes);
}

}  // namespace nearfield::render
