#include <engine/base/stopwatch.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/buffer_parts.hpp>
#include <engine/raster/raster.hpp>

#include <algorithm>
#include <cstring>
#include <span>
#include <string>

namespace nearfield::raster {
namespace {

template <class Element>
void copy_to(std::byte* target, const std::vector<Element>& elements) {
    if (!elements.empty()) {
        std::memcpy(target, elements.data(), bytes_of(elements));
    }
}

template <class Element>
std::uint64_t bytes_of_all(std::span<const std::vector<Element>> meshes) {
    std::uint64_t bytes = 0;
    for (const std::vector<Element>& mesh : meshes) {
        bytes += bytes_of(mesh);
    }
    return bytes;
}

std::span<const std::vector<shaders::CellGroup>> groups_of(const DrawnBatch& batch) {
    return batch.groups;
}

/// One after the other.
template <class Element>
void copy_all_to(std::byte* target, std::span<const std::vector<Element>> meshes) {
    for (const std::vector<Element>& mesh : meshes) {
        copy_to(target, mesh);
        target += bytes_of(mesh);
    }
}

/// The tile batches of a batch in flight, which are drawn.
class DrawnTiles final : public render::TileWork {
public:
    DrawnTiles(const gpu::Device& device, const graph::ComputeLayout& layout, Raster& raster);

    void build(const device_input::Plan& plan) override;
    [[nodiscard]] const device_input::TileBatch& batch(std::uint32_t number) const override {
        return batches_[number];
    }

protected:
    void upload() override;
    [[nodiscard]] render::UsedGraph graph_for(std::uint32_t number) override {
        auto graph = raster_->graph_for(batches_[number], atlas_);
        return {graph, graph->outputs()};
    }
    void bind_input(std::uint32_t number, graph::BoundResources& resources) override;
    void record_tiles(std::uint32_t number, const graph::BoundResources& resources,
                      std::uint32_t sample_capacity, VkCommandBuffer commands,
                      gpu::Timestamps& timestamps) const override;

private:
    /// Byte offsets of a tile batch's parts in the common buffers.
    struct InputParts {
        std::uint64_t tiles = 0, geometry = 0, points = 0, field_points = 0, end = 0;
        std::uint64_t groups_end = 0;               // of the groups that follow the tiles
        std::uint64_t tile_meshes = 0, meshes = 0;  // in the buffer of meshes
    };

    void lay_out(const DrawnBatch& batch, InputParts& parts, std::uint64_t& input_end,
                 std::uint64_t& mesh_end) const;
    void copy(const DrawnBatch& batch, const InputParts& parts) const;

    Raster* raster_;
    std::vector<DrawnBatch> batches_;  // the first count() of them
    TileSize atlas_;                   // that all of them take
    std::vector<InputParts> parts_;    // by tile batch
    gpu::MappedBuffer mesh_;
    gpu::MappedBuffer input_;
};

DrawnTiles::DrawnTiles(const gpu::Device& device, const graph::ComputeLayout& layout,
                       Raster& raster)
    : TileWork(device, layout, raster),
      raster_(&raster),
      mesh_(device, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, gpu::Direction::upload, "nearfield mesh"),
      input_(device, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Direction::upload,
             "nearfield input") {}

void DrawnTiles::build(const device_input::Plan& plan) {
    set_count(raster_->builder().build(plan, batches_));
    atlas_ = raster_->builder().extent();
}

void DrawnTiles::upload() {
    parts_.resize(count());
    std::uint64_t mesh_end = 0;
    std::uint64_t input_end = 0;
    for (std::uint32_t i = 0; i < count(); ++i) {
        lay_out(batches_[i], parts_[i], input_end, mesh_end);
    }
    input_.reserve(input_end);
    mesh_.reserve(mesh_end);
    for (std::uint32_t i = 0; i < count(); ++i) {
        copy(batches_[i], parts_[i]);
    }
    input_.flush();
    mesh_.flush();
}

void DrawnTiles::lay_out(const DrawnBatch& batch, InputParts& parts, std::uint64_t& input_end,
                         std::uint64_t& mesh_end) const {
    const auto& geometry = batch.lists.geometry();
    require_range(device(), bytes_of(geometry), "the edges");
    require_range(device(), std::max(bytes_of(batch.points), bytes_of(batch.field_points)),
                  "the points");
    parts.tiles = align(input_end);
    parts.groups_end = parts.tiles + bytes_of(batch.tiles) + bytes_of_all(groups_of(batch));
    parts.geometry = align(parts.groups_end);
    parts.points = align(parts.geometry + bytes_of(geometry));
    parts.field_points = align(parts.points + bytes_of(batch.points));
    parts.end = parts.field_points + bytes_of(batch.field_points);
    input_end = parts.end + smallest_part;
    parts.tile_meshes = mesh_end;
    parts.meshes = mesh_end + bytes_of_all(batch.meshes.tile_meshes());
    mesh_end = align(parts.meshes + bytes_of_all(batch.meshes.meshes()));
}

void DrawnTiles::copy(const DrawnBatch& batch, const InputParts& parts) const {
    copy_to(input_.data() + parts.tiles, batch.tiles);
    copy_all_to(input_.data() + parts.tiles + bytes_of(batch.tiles), groups_of(batch));
    copy_to(input_.data() + parts.geometry, batch.lists.geometry());
    copy_to(input_.data() + parts.points, batch.points);
    copy_to(input_.data() + parts.field_points, batch.field_points);
    copy_all_to(mesh_.data() + parts.tile_meshes, batch.meshes.tile_meshes());
    copy_all_to(mesh_.data() + parts.meshes, batch.meshes.meshes());
}

void DrawnTiles::bind_input(std::uint32_t number, graph::BoundResources& resources) {
    const InputParts& parts = parts_[number];
    const auto& graph = graph_of<DrawnGraph>(number);
    const auto set = [&](std::uint32_t part, std::uint64_t from, std::uint64_t to) {
        resources.set(graph.input(), input_.part(from, to - from), part);
    };
    set(input_parts::tiles, parts.tiles, parts.groups_end);
    set(input_parts::edges, parts.geometry,
        parts.geometry + bytes_of(batches_[number].lists.geometry()));
    set(input_parts::points, parts.points, parts.field_points);
    set(input_parts::field_points, parts.field_points, parts.end);
    resources.set(graph.mesh(), mesh_.part(0, mesh_.capacity()));
}

void DrawnTiles::record_tiles(std::uint32_t number, const graph::BoundResources& resources,
                              std::uint32_t sample_capacity, VkCommandBuffer commands,
                              gpu::Timestamps& timestamps) const {
    const DrawContext context{batches_[number], mesh_.handle(), parts_[number].meshes,
                              parts_[number].tile_meshes, sample_capacity};
    raster_->pipelines().intersect.reset(commands, context);
    graph_of<DrawnGraph>(number).execute(commands, timestamps, resources, context);
}

}  // namespace

Raster::Raster(const gpu::Device& device, const graph::ComputeLayout& layout, bool makes_pipelines)
    : device_(&device), layout_(&layout), builder_({device.subpixel_steps()}) {
    if (makes_pipelines) {
        static_cast<void>(pipelines());
    }
}

std::unique_ptr<render::TileWork> Raster::make_work() {
    return std::make_unique<DrawnTiles>(*device_, *layout_, *this);
}

const Pipelines& Raster::pipelines() {
    if (!pipelines_) {
        const Stopwatch start;
        pipelines_.emplace(*device_, *layout_);
        milliseconds_ += start.milliseconds();
    }
    return *pipelines_;
}

std::shared_ptr<const DrawnGraph> Raster::graph_for(const DrawnBatch& batch, TileSize atlas) {
    constexpr std::uint32_t gap = atlas_gap;
    constexpr std::size_t max_graphs = 8;
    const DrawKey needs(batch);
    VkExtent2D extent{queries::smallest_atlas + gap, queries::smallest_atlas + gap};
    const auto known = std::find_if(graphs_.begin(), graphs_.end(),
                                    [&](const auto& graph) { return graph->needs() == needs; });
    const bool grows = known != graphs_.end();
    if (grows) {
        extent = (*known)->extent();
        if (extent.width >= atlas.width && extent.height >= atlas.height) {
            return *known;
        }
        graphs_.erase(known);
    }
    // Powers of two and a gap, so that an atlas that grows a little each frame is not recreated
    // each frame.
    while (extent.width < atlas.width) {
        extent.width = 2 * (extent.width - gap) + gap;
    }
    while (extent.height < atlas.height) {
        extent.height = 2 * (extent.height - gap) + gap;
    }
    device_->log(grows ? LogLevel::warning : LogLevel::information, [&] {
        return std::string(grows ? "images grow to " : "images for a new kind of batch: ") +
               std::to_string(extent.width) + " x " + std::to_string(extent.height);
    });
    set_last_graph(nullptr);  // so that its images go before others are made
    if (graphs_.size() == max_graphs) {
        graphs_.erase(graphs_.begin());
    }
    return graphs_.emplace_back(std::make_shared<DrawnGraph>(*device_, pipelines(), needs, extent));
}

}  // namespace nearfield::raster
