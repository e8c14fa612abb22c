#include <engine/graph/format.hpp>
#include <engine/renderer.hpp>
#include <engine/stopwatch.hpp>

#include <algorithm>

namespace nearfield {
namespace {

// Recipes that keep their images: more kinds of batches than this take turns.
constexpr std::size_t most_recipes = 8;

ComputeNeeds compute_needs_of(const plan::Round& round) {
    const plan::ComputeWork& work = round.compute;
    ComputeNeeds needs;
    needs.points = !round.points.empty();
    needs.field_values = !work.blocks.empty();
    needs.field_features = work.features;
    needs.field_points = !work.points.empty();
    needs.fill = !work.rows.empty();
    needs.boundaries_a = !work.polygons_a.empty();
    needs.boundaries_b = !work.polygons_b.empty();
    needs.overlap = !work.overlaps.empty();
    return needs;
}

Needs needs_of(const plan::Round& round) {
    Needs needs;
    needs.keeps_hits = round.keeps_hits;
    if (round.by_compute) {
        needs.compute = compute_needs_of(round);
        return needs;
    }
    needs.points = !round.points.empty();
    needs.field_points = !round.field_point_runs.empty();
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        needs.overlap[i] = !round.overlap_draws[i].empty();
    }
    for (const plan::TileDraw& draw : round.distance_draws) {
        const auto encoding = static_cast<std::size_t>(draw.sign);
        needs.field[encoding] = needs.field[encoding] || draw.field;
        needs.field_cells = needs.field_cells || draw.first_value != plan::not_asked ||
                            draw.first_feature != plan::not_asked;
        needs.blended = needs.blended || draw.blended;
    }
    return needs;
}

}  // namespace

Renderer::Renderer(const gpu::Device& device, const DeviceTechniques& techniques)
    : device_(&device),
      layout_(device),
      copy_back_(device),
      hand_over_field_(device, layout_),
      hand_over_records_(device, layout_),
      hand_over_samples_(device, layout_) {
    if (techniques.raster) {
        passes_.raster.emplace(device, layout_, frame_);
    }
    if (techniques.compute) {
        passes_.compute.emplace(device, layout_, frame_);
    }
}

const char* Renderer::gradient_format() const {
    return graph::find_format(device_->gradient_format())->name;
}

std::unique_ptr<RenderSlot> Renderer::make_slot() const {
    return std::make_unique<RenderSlot>(*device_, layout_);
}

/// What a slot in flight uses lives on in it, whatever becomes of it here.
std::shared_ptr<Recipe> Renderer::recipe_for(Needs needs, plan::TileSize extent) {
    VkExtent2D atlas{plan::smallest_atlas, plan::smallest_atlas};
    bool grows = false;
    for (const auto& recipe : recipes_) {
        if (recipe->needs() == needs) {
            if (recipe->extent().width >= extent.width &&
                recipe->extent().height >= extent.height) {
                return recipe;
            }
            atlas = recipe->extent();
            grows = true;
        }
    }
    // Powers of two, so that an atlas that grows a little each frame is not made anew each frame.
    while (atlas.width < extent.width) {
        atlas.width *= 2;
    }
    while (atlas.height < extent.height) {
        atlas.height *= 2;
    }
    device_->log(grows ? LogLevel::warning : LogLevel::information, [&] {
        return std::string(grows ? "images grow to " : "images for a new kind of batch: ") +
               std::to_string(atlas.width) + " x " + std::to_string(atlas.height);
    });
    last_recipe_ = nullptr;
    std::erase_if(recipes_, [&](const auto& recipe) { return recipe->needs() == needs; });
    if (recipes_.size() == most_recipes) {
        recipes_.erase(recipes_.begin());
    }
    recipes_.push_back(std::make_shared<Recipe>(*device_, passes_, needs, atlas));
    return recipes_.back();
}

std::uint32_t Renderer::sample_capacity(const plan::Round& round, SampleRoom room) const {
    if (room == SampleRoom::all) {
        return static_cast<std::uint32_t>(round.listed_cells);
    }
    const std::uint64_t expected =
        std::max<std::uint64_t>(most_samples_, 4096 + round.listed_cells / 8);
    return static_cast<std::uint32_t>(std::min(round.listed_cells, expected));
}

void Renderer::prepare(std::span<const plan::Round> rounds, const plan::HandOver& hand_over,
                       plan::TileSize extent, SampleRoom room, RenderSlot& slot, Timings& timings) {
    const Stopwatch start;
    slot.upload(rounds, hand_over);
    last_had_fields_ = !hand_over.fields.empty();
    last_had_records_ = !hand_over.records.empty();
    last_had_samples_ = !hand_over.samples.empty();
    slot.run(static_cast<std::uint32_t>(rounds.size()));
    for (const std::uint32_t number : slot.running()) {
        RoundOnDevice& round = slot.round(number);
        round.recipe = recipe_for(needs_of(rounds[number]), extent);
        round.frame.sample_capacity = sample_capacity(rounds[number], room);
        last_recipe_ = round.recipe;
    }
    slot.lay_out_output();
    timings.plan += start.milliseconds();
}

void Renderer::submit(RenderSlot& slot, const Submission& order, Timings& timings) {
    const Stopwatch start;
    record_rounds(slot, slot.begin());
    timings.record += start.milliseconds();
    slot.submit(order);
}

void Renderer::record(RenderSlot& slot, VkCommandBuffer commands, std::uint32_t stamp,
                      Timings& timings) {
    const Stopwatch start;
    device_->begin_label(commands, "nearfield");
    record_rounds(slot, commands);
    slot.end_recording(commands, stamp);
    device_->end_label(commands);
    timings.record += start.milliseconds();
}

bool Renderer::submit_those_without_room(RenderSlot& slot, Timings& timings) {
    slot.run_those_without_room();
    if (slot.running().empty()) {
        return false;
    }
    slot.lay_out_output();
    submit(slot, {}, timings);
    return true;
}

void Renderer::record_rounds(RenderSlot& slot, VkCommandBuffer commands) {
    slot.timestamps().reset(commands);
    for (const std::uint32_t number : slot.running()) {
        const RoundOnDevice& round = slot.round(number);
        frame_ = round.frame;
        if (!frame_.round->by_compute) {
            passes_.raster->early_out.reset(commands);
        }
        slot.hand_buffers_to(*round.recipe, number);
        round.recipe->execute(commands, slot.timestamps());
    }
    record_hand_over(slot, commands);
}

void Renderer::record_hand_over(RenderSlot& slot, VkCommandBuffer commands) {
    const RenderSlot::CopyBack copies = slot.copy_back();
    if (!copies.ranges.empty()) {
        copy_back_.record(commands, slot.timestamps(), copies.words, copies.read_back,
                          copies.ranges);
    }
    if (slot.is_to_hand_over()) {
        const HandOverSlot& hand_over = slot.hand_over();
        for (std::size_t i = 0; i < hand_over.hand_over().fields.size(); ++i) {
            hand_over_field_.record(commands, slot.timestamps(), hand_over.field_item(i));
        }
        for (std::size_t i = 0; i < hand_over.hand_over().records.size(); ++i) {
            hand_over_records_.record(commands, slot.timestamps(), hand_over.records_item(i));
        }
        for (std::size_t i = 0; i < hand_over.hand_over().samples.size(); ++i) {
            hand_over_samples_.record(commands, slot.timestamps(), hand_over.samples_item(i));
        }
    }
}

void Renderer::wait(RenderSlot& slot, Timings& timings) {
    slot.wait();
    slot.timestamps().collect(timings.passes);
    for (const std::uint32_t number : slot.running()) {
        most_samples_ = std::max(most_samples_, slot.round(number).sample_count);
    }
}

std::string Renderer::print(GraphFormat format) const {
    std::string text = last_recipe_ == nullptr ? std::string() : last_recipe_->print(format);
    if (last_had_fields_) {
        text += hand_over_field_.print(format);
    }
    if (last_had_records_) {
        text += hand_over_records_.print(format);
    }
    if (last_had_samples_) {
        text += hand_over_samples_.print(format);
    }
    return text;
}

}  // namespace nearfield
