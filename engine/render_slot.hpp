#pragma once

#include <engine/compute_buffers.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/submission.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/hand_over_slot.hpp>
#include <engine/plan/hand_over.hpp>
#include <engine/plan/round.hpp>
#include <engine/recipe.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_sets.hpp>
#include <passes/frame.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace nearfield {

/// Where the parts of a round start in the buffers of its slot, in bytes.
struct InputParts {
    std::uint64_t tiles = 0, geometry = 0, points = 0, field_points = 0, end = 0;
};
struct OutputParts {
    std::uint64_t points = 0, field = 0, summaries = 0, samples = 0, end = 0;
    std::uint64_t hits = 0;  ///< kept, among the words that stay on the device
};

/// How the commands of a slot get to the device.
enum class Flight {
    none,
    submitted,  ///< by the slot, whose fence says when they are done
    recorded,   ///< into a command buffer of the host, who says when they are done
};

/// One round of a slot as the device has it.
struct RoundOnDevice {
    std::shared_ptr<Recipe> recipe;  ///< kept for as long as the device may use its images
    passes::Frame frame;             ///< what its passes record from
    InputParts input;
    OutputParts output;
    std::uint32_t sample_count = 0;  ///< found; only frame.sample_capacity of them came back

    [[nodiscard]] bool had_room() const { return sample_count <= frame.sample_capacity; }
};

/// The device's side of one batch in flight: what the host must not touch before the device is done
/// with it. All rounds of the batch are in it, each with descriptor sets of its own and parts of
/// the common buffers. Pipelines, recipes and their images belong to the Renderer and are shared by
/// all slots. Keeps its memory; the steady state makes nothing.
class RenderSlot {
public:
    RenderSlot(const gpu::Device& device, const passes::ComputeLayout& layout);
    /// Waits for what it submitted, where the device is still at work on it. What was recorded for
    /// the host is the host's to wait for.
    ~RenderSlot();
    RenderSlot(const RenderSlot&) = delete;
    RenderSlot& operator=(const RenderSlot&) = delete;

    /// Takes rounds to the device's memory, and what is to be handed over of them. They have to
    /// stay as they are until the slot takes others, and the slot must not be in flight.
    void upload(std::span<const plan::Round> rounds, const plan::HandOver& hand_over);
    /// The rounds that the next submission is made of, by position.
    void run(std::uint32_t count);
    void run_those_without_room();
    [[nodiscard]] std::span<const std::uint32_t> running() const { return running_; }
    /// Finds a place for what these rounds bring back, and points their descriptor sets to it.
    void lay_out_output();

    [[nodiscard]] RoundOnDevice& round(std::uint32_t number) { return rounds_[number]; }
    [[nodiscard]] const RoundOnDevice& round(std::uint32_t number) const { return rounds_[number]; }
    /// Points a recipe to the buffers of a round, for what is recorded next.
    void hand_buffers_to(Recipe& recipe, std::uint32_t number) const;

    /// What stays on the device; its commands are part of a batch's first submission.
    [[nodiscard]] const HandOverSlot& hand_over() const { return hand_over_; }
    [[nodiscard]] bool is_to_hand_over() const { return is_to_hand_over_; }
    /// What of the words that stay on the device the host wants all the same.
    struct CopyBack {
        VkBuffer words = VK_NULL_HANDLE;
        VkBuffer read_back = VK_NULL_HANDLE;
        std::span<const VkBufferCopy> ranges;
    };
    [[nodiscard]] CopyBack copy_back() const {
        return {words_.handle(), read_back_.handle(), copies_};
    }

    /// The command buffer, empty.
    [[nodiscard]] VkCommandBuffer begin();
    [[nodiscard]] gpu::Timestamps& timestamps() { return timestamps_; }
    void submit(const Submission& order = {});
    /// Submits the semaphores of a batch that has no commands.
    void submit_semaphores(const Submission& order) { submission_.submit_semaphores(order); }
    /// Ends what was recorded into the host's command buffer. `stamp`, never 0 and never used
    /// before, tells later whether the commands were executed.
    void end_recording(VkCommandBuffer commands, std::uint32_t stamp);
    /// On its way to the device, and not waited for yet.
    [[nodiscard]] Flight flight() const { return flight_; }
    /// wait() would not wait; of what was recorded only the host knows.
    [[nodiscard]] bool is_done() const {
        return flight_ != Flight::submitted || submission_.is_done();
    }
    /// Waits for what was submitted; what was recorded has to be done. Throws Failure
    /// (not_executed) where it was not executed at all.
    void wait();
    /// Lets go of the recipes; not while in flight.
    void release();

    /// What a round brought back: by point, of all fields, by tile (of overlap tiles only), and the
    /// samples of the tiles that list theirs, in any order. After wait(), until the next upload.
    [[nodiscard]] std::span<const std::uint32_t> points(std::uint32_t number) const;
    [[nodiscard]] std::span<const std::uint32_t> field_words(std::uint32_t number) const;
    [[nodiscard]] std::span<const plan::TileSummary> summaries(std::uint32_t number) const;
    [[nodiscard]] std::span<const plan::SampleData> samples(std::uint32_t number) const;

private:
    void make_room_for(std::size_t rounds);
    void lay_out_input(RoundOnDevice& on_device, std::uint64_t& input_end,
                       std::uint64_t& mesh_end) const;
    void copy_input(const RoundOnDevice& on_device) const;
    void empty_output(const RoundOnDevice& on_device) const;
    void find_copies(const RoundOnDevice& on_device);
    void lay_out_words(std::uint64_t end);
    [[nodiscard]] BufferPart hits_of(std::uint32_t number) const;
    void bind_hand_over();
    /// Where a round writes the words of its points and fields.
    [[nodiscard]] VkBuffer words_of(const RoundOnDevice& on_device) const;
    void bind(const RoundOnDevice& on_device) const;
    void bind_compute(std::uint32_t number) const;
    [[nodiscard]] std::uint64_t align(std::uint64_t offset) const;
    void require_stamp();

    const gpu::Device* device_;
    const passes::ComputeLayout* layout_;
    gpu::Submission submission_;
    gpu::Timestamps timestamps_;
    gpu::MappedBuffer mesh_;
    gpu::MappedBuffer input_;
    gpu::MappedBuffer read_back_;
    /// Laid out as the read-back, for rounds whose results stay on the device; behind that what
    /// they found in the cells of intersections.
    gpu::MappedBuffer words_;
    HandOverSlot hand_over_;
    bool is_to_hand_over_ = false;
    std::vector<VkBufferCopy> copies_;
    std::vector<HandOverSlot::Words> hand_over_words_;  // by round
    std::vector<passes::ComputeSets> sets_;             // by round
    /// By round; null where it never was one of the compute technique. Each has scratch memory of
    /// its own, since no barrier stands between the rounds of a submission.
    std::vector<std::unique_ptr<ComputeBuffers>> compute_;
    std::vector<RoundOnDevice> rounds_;
    std::vector<std::uint32_t> running_;
    Flight flight_ = Flight::none;
    std::uint64_t stamp_offset_ = 0;  // in the read-back; what stands there is 0 until it executes
    std::uint32_t stamp_ = 0;
};

}  // namespace nearfield
