#include <engine/failure.hpp>
#include <engine/renderer.hpp>
#include <engine/stopwatch.hpp>

#include <algorithm>
#include <cstring>

namespace nearfield {
namespace {

// All of points and fields, and three for each strategy.
constexpr std::uint32_t most_passes = 16 + 3 * intersection_strategies;

// Recipes that keep their images: more kinds of batches than this take turns.
constexpr std::size_t most_recipes = 8;

// Every part of a buffer that is bound has at least these bytes, its last one too.
constexpr std::uint64_t smallest_range = 16;

template <class Element>
std::uint64_t bytes_of(const std::vector<Element>& elements) {
    return elements.size() * sizeof(Element);
}

template <class Element>
void copy_to(std::byte* target, const std::vector<Element>& elements) {
    if (!elements.empty()) {
        std::memcpy(target, elements.data(), bytes_of(elements));
    }
}

ComputeNeeds compute_needs_of(const plan::Round& round) {
    const plan::ComputeWork& work = round.compute;
    ComputeNeeds needs;
    needs.points = !round.points.empty();
    needs.field_cells = !work.blocks.empty();
    needs.field_points = !work.points.empty();
    needs.fill = !work.rows.empty();
    needs.boundaries_a = !work.polygons_a.empty();
    needs.boundaries_b = !work.polygons_b.empty();
    needs.overlap = !work.overlaps.empty();
    return needs;
}

Needs needs_of(const plan::Round& round) {
    Needs needs;
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

Renderer::Renderer(const gpu::Device& device)
    : device_(&device),
      layout_(device),
      passes_(device, layout_, frame_),
      submission_(device),
      timestamps_(device, most_passes),
      mesh_(device, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, gpu::Direction::upload, "nearfield mesh"),
      input_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload, "nearfield input"),
      read_back_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                 gpu::Direction::readback, "nearfield read-back"),
      compute_(device) {
    frame_.points = layout_.set(0);
    for (std::uint32_t encoding = 0; encoding < passes::sign_encodings; ++encoding) {
        frame_.field[encoding] = layout_.set(1 + encoding);
    }
    frame_.gradients = layout_.set(1 + passes::sign_encodings);
    for (std::uint32_t i = 0; i < intersection_strategies; ++i) {
        frame_.samples[i] = layout_.set(2 + passes::sign_encodings + i);
    }
    frame_.masks = layout_.set(2 + passes::sign_encodings + intersection_strategies);
    frame_.blocks = layout_.set(3 + passes::sign_encodings + intersection_strategies);
    frame_.subpixel_bits = device.limits().subPixelPrecisionBits;
}

std::uint64_t Renderer::align(std::uint64_t offset) const {
    const std::uint64_t step = device_->limits().minStorageBufferOffsetAlignment;
    return (offset + step - 1) / step * step;
}

void Renderer::require_range(std::uint64_t bytes, const char* what) const {
    const std::uint64_t most = device_->limits().maxStorageBufferRange;
    if (bytes > most) {
        throw Failure({StatusCode::too_large, std::string(what) + " take " + std::to_string(bytes) +
                                                  " bytes; a storage buffer of this device holds " +
                                                  std::to_string(most)});
    }
}

Recipe& Renderer::recipe_for(Needs needs, plan::TileSize extent) {
    VkExtent2D atlas{plan::smallest_atlas, plan::smallest_atlas};
    for (const auto& recipe : recipes_) {
        if (recipe->needs() == needs) {
            if (recipe->extent().width >= extent.width &&
                recipe->extent().height >= extent.height) {
                return *recipe;
            }
            atlas = recipe->extent();
        }
    }
    // Powers of two, so that an atlas that grows a little each frame is not made anew each frame.
    while (atlas.width < extent.width) {
        atlas.width *= 2;
    }
    while (atlas.height < extent.height) {
        atlas.height *= 2;
    }
    last_recipe_ = nullptr;
    std::erase_if(recipes_, [&](const auto& recipe) { return recipe->needs() == needs; });
    if (recipes_.size() == most_recipes) {
        recipes_.erase(recipes_.begin());
    }
    recipes_.push_back(std::make_unique<Recipe>(*device_, passes_, needs, atlas));
    return *recipes_.back();
}

Renderer::InputParts Renderer::upload(const plan::Round& round) {
    const auto& geometry = round.lists.geometry();
    InputParts parts;
    parts.geometry = align(bytes_of(round.tiles));
    parts.points = align(parts.geometry + bytes_of(geometry));
    parts.field_points = align(parts.points + bytes_of(round.points));
    parts.end = parts.field_points + bytes_of(round.field_points);
    require_range(bytes_of(geometry), "the edges of one round");
    require_range(std::max(bytes_of(round.points), bytes_of(round.field_points)),
                  "the points of one round");
    input_.reserve(parts.end + smallest_range);
    copy_to(input_.data() + parts.tiles, round.tiles);
    copy_to(input_.data() + parts.geometry, geometry);
    copy_to(input_.data() + parts.points, round.points);
    copy_to(input_.data() + parts.field_points, round.field_points);
    input_.flush();
    mesh_.reserve(bytes_of(round.mesh));
    copy_to(mesh_.data(), round.mesh);
    mesh_.flush();
    return parts;
}

void Renderer::lay_out_output(const plan::Round& round) {
    const std::uint64_t point_bytes = round.points.size() * sizeof(std::uint32_t);
    const std::uint64_t field_bytes = round.field_words * sizeof(std::uint32_t);
    const std::uint64_t sample_bytes =
        sizeof(std::uint32_t) + frame_.sample_capacity * sizeof(plan::SampleData);
    output_.field = align(point_bytes);
    const std::uint64_t summary_bytes = round.tiles.size() * sizeof(plan::TileSummary);
    output_.summaries = align(output_.field + field_bytes);
    output_.samples = align(output_.summaries + summary_bytes);
    output_.end = output_.samples + sample_bytes;
    require_range(std::max({point_bytes, field_bytes, summary_bytes, sample_bytes}),
                  "the results of one round");
    read_back_.reserve(output_.end + smallest_range);
    std::memset(read_back_.data() + output_.samples, 0, sizeof(std::uint32_t));
    const plan::TileSummary empty;
    for (std::size_t i = 0; i < round.tiles.size(); ++i) {
        std::memcpy(read_back_.data() + output_.summaries + i * sizeof(empty), &empty,
                    sizeof(empty));
    }
    read_back_.flush();
    frame_.read_back = read_back_.handle();
    frame_.summaries_offset = output_.summaries;
}

void Renderer::bind(const Recipe& recipe, const plan::Round& round, const InputParts& input) {
    using Layout = passes::ComputeLayout;
    // A range of no bytes is not allowed; a pass without work reads nothing.
    const auto write = [&](VkDescriptorSet set, Layout::Binding binding,
                           const gpu::MappedBuffer& buffer, std::uint64_t from, std::uint64_t to) {
        layout_.write_buffer(set, binding, buffer.handle(), from,
                             std::max(to - from, smallest_range));
    };
    const auto write_tiles = [&](VkDescriptorSet set) {
        write(set, Layout::tiles, input_, 0, bytes_of(round.tiles));
        write(set, Layout::geometry, input_, input.geometry,
              input.geometry + bytes_of(round.lists.geometry()));
    };
    if (recipe.needs().points) {
        write_tiles(frame_.points);
        write(frame_.points, Layout::points, input_, input.points, input.field_points);
        write(frame_.points, Layout::output, read_back_, output_.points, output_.field);
    }
    const auto write_field = [&](VkDescriptorSet set) {
        write_tiles(set);
        write(set, Layout::points, input_, input.field_points, input.end);
        write(set, Layout::output, read_back_, output_.field, output_.summaries);
    };
    for (std::size_t encoding = 0; encoding < passes::sign_encodings; ++encoding) {
        if (recipe.needs().field[encoding]) {
            write_field(frame_.field[encoding]);
        }
    }
    if (recipe.needs().blended) {
        write_field(frame_.gradients);
    }
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        if (recipe.needs().overlap[i]) {
            write_tiles(frame_.samples[i]);
            write(frame_.samples[i], Layout::summaries, read_back_, output_.summaries,
                  output_.samples);
            write(frame_.samples[i], Layout::output, read_back_, output_.samples, output_.end);
        }
    }
    recipe.bind_images(layout_, frame_);
}

void Renderer::bind_compute() const {
    const auto part = [&](std::uint64_t from, std::uint64_t to) {
        return BufferPart{read_back_.handle(), from, to - from};
    };
    compute_.bind(layout_, frame_,
                  {part(output_.points, output_.field), part(output_.field, output_.summaries),
                   part(output_.summaries, output_.samples), part(output_.samples, output_.end)});
}

void Renderer::render(const plan::Round& round, plan::TileSize extent, Timings& timings) {
    const Stopwatch start;
    const Needs needs = needs_of(round);
    Recipe& recipe = recipe_for(needs, extent);
    last_recipe_ = &recipe;
    InputParts input;
    if (round.by_compute) {
        compute_.upload(round);
    } else {
        input = upload(round);
    }
    frame_.round = &round;
    frame_.mesh = mesh_.handle();
    frame_.scratch = compute_.scratch();
    frame_.sample_capacity = static_cast<std::uint32_t>(std::min<std::uint64_t>(
        round.listed_cells, std::max<std::uint64_t>(most_samples_, 4096 + round.listed_cells / 8)));
    timings.plan += start.milliseconds();

    for (;;) {
        lay_out_output(round);
        recipe.set_buffers(mesh_.handle(), round.by_compute ? compute_.input() : input_.handle(),
                           compute_.scratch(), read_back_.handle());
        if (round.by_compute) {
            bind_compute();
        } else {
            bind(recipe, round, input);
        }
        submit_and_wait(recipe, timings);
        std::memcpy(&sample_count_, read_back_.data() + output_.samples, sizeof(sample_count_));
        most_samples_ = std::max(most_samples_, sample_count_);
        if (sample_count_ <= frame_.sample_capacity) {
            return;
        }
        frame_.sample_capacity = sample_count_;
    }
}

void Renderer::submit_and_wait(const Recipe& recipe, Timings& timings) {
    const Stopwatch start;
    const VkCommandBuffer commands = submission_.begin();
    timestamps_.reset(commands);
    passes_.early_out.reset(commands);
    recipe.execute(commands, timestamps_);
    timings.record += start.milliseconds();

    const Stopwatch submitted;
    submission_.submit();
    submission_.wait();
    timings.device += submitted.milliseconds();
    timestamps_.collect(timings.passes);
    read_back_.invalidate();
}

std::span<const std::uint32_t> Renderer::points() const {
    return {reinterpret_cast<const std::uint32_t*>(read_back_.data() + output_.points),
            frame_.round->points.size()};
}

std::span<const std::uint32_t> Renderer::field_words() const {
    return {reinterpret_cast<const std::uint32_t*>(read_back_.data() + output_.field),
            frame_.round->field_words};
}

std::span<const plan::SampleData> Renderer::samples() const {
    return {reinterpret_cast<const plan::SampleData*>(read_back_.data() + output_.samples +
                                                      sizeof(std::uint32_t)),
            sample_count_};
}

std::span<const plan::TileSummary> Renderer::summaries() const {
    return {reinterpret_cast<const plan::TileSummary*>(read_back_.data() + output_.summaries),
            frame_.round->tiles.size()};
}

std::string Renderer::print(GraphFormat format) const {
    return last_recipe_ == nullptr ? std::string() : last_recipe_->print(format);
}

}  // namespace nearfield
