#pragma once

#include <engine/gpu/device.hpp>
#include <engine/plan/round.hpp>
#include <engine/recipe.hpp>
#include <engine/render_slot.hpp>
#include <nearfield/result.hpp>
#include <passes/copy_back.hpp>
#include <passes/hand_over_field.hpp>
#include <passes/hand_over_records.hpp>
#include <passes/hand_over_samples.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nearfield {

/// Which samples of intersections there is room for: as many as are likely, since what finds none
/// can be submitted again; or all.
enum class SampleRoom { likely, all };

/// Takes the rounds of a batch to the device in one submission, or into a command buffer of the
/// host. Owns what all batches in flight
/// share: pipelines, and recipes with their images, which batches and rounds use one after the
/// other (the graph's barriers order them, in one command buffer and from one submission to the
/// next on the same queue). What each of them has to itself is in its RenderSlot. Recipes only
/// grow; the steady state allocates nothing and creates nothing.
class Renderer {
public:
    /// Makes the pipelines of these techniques, and no others later.
    Renderer(const gpu::Device& device, const DeviceTechniques& techniques);

    /// The name of the format that gradients are blended in.
    [[nodiscard]] const char* gradient_format() const;

    /// A slot for this renderer, which must outlive it.
    [[nodiscard]] std::unique_ptr<RenderSlot> make_slot() const;

    /// Uploads rounds, and what is handed over of them, and finds room for what they bring back;
    /// adds to the time of planning. They have to stay as they are, and the slot untouched, until
    /// the device is done.
    void prepare(std::span<const plan::Round> rounds, const plan::HandOver& hand_over,
                 plan::TileSize extent, SampleRoom room, RenderSlot& slot, Timings& timings);
    /// Records what was prepared and submits it; adds to the time of recording.
    void submit(RenderSlot& slot, const Submission& order, Timings& timings);
    /// Records what was prepared into a command buffer of the host, with a stamp at its end
    /// (RenderSlot::end_recording). Before anything is recorded whatever can fail has been done.
    void record(RenderSlot& slot, VkCommandBuffer commands, std::uint32_t stamp, Timings& timings);
    /// Waits for what was submitted, if it was, and adds the times of the passes. What the rounds
    /// brought back is then in the slot, but for rounds that found more samples than they had room
    /// for.
    void wait(RenderSlot& slot, Timings& timings);
    /// Submits those rounds again, with room for all, overwriting what came back of the others.
    /// Returns false where there are none.
    [[nodiscard]] bool submit_those_without_room(RenderSlot& slot, Timings& timings);

    /// The graph of the last round submitted, and those that handed over; empty before the first.
    [[nodiscard]] std::string print(GraphFormat format) const;

private:
    [[nodiscard]] std::shared_ptr<Recipe> recipe_for(Needs needs, plan::TileSize extent);
    [[nodiscard]] std::uint32_t sample_capacity(const plan::Round& round, SampleRoom room) const;
    void record_rounds(RenderSlot& slot, VkCommandBuffer commands);
    void record_hand_over(RenderSlot& slot, VkCommandBuffer commands);

    const gpu::Device* device_;
    passes::Frame frame_;  // of the round that is being recorded
    passes::ComputeLayout layout_;
    Passes passes_;
    passes::CopyBack copy_back_;
    passes::HandOverField hand_over_field_;
    passes::HandOverRecords hand_over_records_;
    passes::HandOverSamples hand_over_samples_;
    std::vector<std::shared_ptr<Recipe>> recipes_;
    std::shared_ptr<const Recipe> last_recipe_;
    bool last_had_fields_ = false;  // among what was handed over of the last batch
    bool last_had_records_ = false;
    bool last_had_samples_ = false;
    std::uint32_t most_samples_ = 0;  // that any round found, so that the next one has room
};

}  // namespace nearfield
