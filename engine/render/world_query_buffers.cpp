#include <engine/base/interruption.hpp>
#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/render/search_memory.hpp>
#include <engine/render/world_query_buffers.hpp>

#include <algorithm>
#include <string>

namespace nearfield::render {
namespace {

struct Sizes {
    std::uint64_t question;
    std::uint64_t answer;
};

Sizes sizes_of(device_input::WorldQuestion question) {
    switch (question) {
        case device_input::WorldQuestion::rays:
            return {sizeof(shaders::RayData), sizeof(shaders::RayAnswerData)};
        case device_input::WorldQuestion::nearest:
            return {sizeof(shaders::NearestData), sizeof(shaders::NearestAnswerData)};
        case device_input::WorldQuestion::poses:
            break;
    }
    return {sizeof(shaders::PoseData), sizeof(std::uint32_t)};
}

}  // namespace

WorldQueryBuffers::WorldQueryBuffers(const gpu::Device& device, const graph::ComputeLayout& layout,
                                     const passes::WorldQueries& passes,
                                     device_input::WorldQuestion question, bool timestamps)
    : device_(&device),
      passes_(&passes),
      question_bytes_(sizes_of(question).question),
      answer_bytes_(sizes_of(question).answer),
      submission_(device),
      timestamps_(device, static_cast<std::uint32_t>(passes.graph.passes().size()), timestamps),
      world_(device),
      questions_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
                 "nearfield world questions"),
      scratch_(device, scratch_usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::Direction::none,
               "nearfield world query scratch"),
      answers_(device, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::Direction::readback,
               "nearfield world answers"),
      resources_(passes.graph.make_resources(layout)),
      updates_(device) {}

WorldQueryBuffers::~WorldQueryBuffers() {
    if (is_submitted_) {
        submission_.wait_to_the_end();
    }
}

std::byte* WorldQueryBuffers::reserve(std::uint64_t count, std::uint64_t memory_limit) {
    ScratchLayout layout;
    input_.push.boxes = layout.units(units_of_boxes(world_.count()));
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
    input_.push.count = static_cast<std::uint32_t>(count);
    input_.push.answers = static_cast<std::uint32_t>(first_answer / shaders::bytes_of_unit);
    input_.copy = {first_answer, 0, answers};
    scratch_.reserve(scratch);
    questions_.reserve(questions);
    answers_.reserve(answers);
    return questions_.data();
}

/// All of what there is, so that the sets stay as they are while the numbers vary.
void WorldQueryBuffers::bind() {
    const std::uint64_t reached = device_->limits().maxStorageBufferRange;
    const auto all_of = [reached](const gpu::MappedBuffer& buffer) {
        return buffer.part(0, std::min(buffer.capacity(), reached));
    };
    resources_.set(passes_->shapes, world_.shape_part());
    resources_.set(passes_->instances, world_.instance_part());
    resources_.set(passes_->questions, all_of(questions_));
    resources_.set(passes_->scratch, all_of(scratch_));
    resources_.set(passes_->answers, all_of(answers_));
    updates_.begin();
    updates_.add(resources_);
    updates_.end();
}

void WorldQueryBuffers::begin(const device_input::SearchShapes& shapes,
                              const shaders::WorldQueryPush& push, Timings& timings) {
    const Stopwatch start;
    checkpoint();
    world_.upload(shapes);
    questions_.flush();
    bind();
    const shaders::WorldQueryPush placed = input_.push;
    input_.push = push;
    input_.push.instances = world_.count();
    input_.push.boxes = placed.boxes;
    input_.push.answers = placed.answers;
    input_.push.count = placed.count;
    VkCommandBuffer commands = submission_.begin();
    timestamps_.reset(commands);
    passes_->graph.execute(commands, timestamps_, resources_, input_);
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
