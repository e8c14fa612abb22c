#pragma once

#include <engine/device_input/resident_outputs.hpp>
#include <engine/device_input/tile_batch.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/buffer_parts.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/image.hpp>
#include <engine/gpu/timestamps.hpp>
#include <engine/graph/bound_resources.hpp>
#include <engine/graph/compute_layout.hpp>
#include <engine/graph/graph.hpp>
#include <engine/render/pipeline_set.hpp>
#include <nearfield/on_device.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::render {

/// The images and the buffer that one batch in flight provides to the host's shaders, and what the
/// passes need to fill them. Everything is kept from batch to batch and only grows: the first field
/// of a batch takes the first images, and so on.
class ResidentBuffers {
public:
    ResidentBuffers(const gpu::Device& device, const graph::ComputeLayout& layout);

    /// Allocates memory and uploads the tables. `resident` has to stay unchanged until the next
    /// upload. Must not be called while the device uses these buffers or the host uses the resident
    /// outputs.
    void upload(const device_input::ResidentOutputs& resident, const ExportPipelines& passes);

    /// Where a tile batch writes the words of its fields, the summaries of its tiles, and the masks
    /// of intersections.
    struct Words {
        gpu::BufferPart field, summaries, masks;
    };
    /// Binds what the passes use, but for records, and adds it to the updates: the words, by tile
    /// batch; `none`: any part of the buffer that holds the words of fields.
    void bind(std::span<const Words> words, const gpu::BufferPart& none,
              const ExportPipelines& passes, graph::DescriptorUpdates& updates);
    /// The same of records, from the shapes and the scratch memory of a search.
    void bind_records(const gpu::BufferPart& shapes, const gpu::BufferPart& scratch,
                      const passes::ExportRecords& passes, graph::DescriptorUpdates& updates);
    [[nodiscard]] std::size_t count_passes(const ExportPipelines& passes) const;
    /// Records the passes of the records that a part of the search has found, once bound. `part`:
    /// its push constants.
    void record_records(const shaders::SearchPush& part, const passes::ExportRecords& passes,
                        VkCommandBuffer commands, gpu::Timestamps& timestamps) const;
    /// Records the other passes, once bound.
    void record(const ExportPipelines& passes, VkCommandBuffer commands,
                gpu::Timestamps& timestamps) const;

    /// The resident output of the i-th field, records or samples of the batch.
    [[nodiscard]] FieldOnDevice field(std::size_t i) const;
    [[nodiscard]] PointsOnDevice records(std::size_t i) const;
    [[nodiscard]] SamplesOnDevice samples(std::size_t i) const;

private:
    /// Of a field, empty where the host has given an image.
    struct Images {
        gpu::KeptImage signed_distance;
        gpu::KeptImage feature;
    };
    struct Views {
        VkImageView signed_distance = VK_NULL_HANDLE;
        VkImageView feature = VK_NULL_HANDLE;
    };
    /// Where an output lies in the buffer: its header, and what the device writes beside it. A
    /// field has a header alone.
    struct Place {
        std::uint64_t header = 0;        ///< followed by blocks
        std::uint64_t records = 0;       ///< the summary, followed by records or samples
        std::uint64_t record_bytes = 0;  ///< reserved
        std::uint64_t block_bytes = 0;   ///< reserved
    };

    void reserve_images();
    void find_views();
    /// Where the summary of records or samples and what follows it lie.
    [[nodiscard]] gpu::BufferPart range_of(const Place& place,
                                           const device_input::BufferOutput& output) const;
    void lay_out_buffer();
    void move_places();
    /// Makes the place of an output as large as it has to be.
    void grow(std::vector<Place>& places, std::size_t i, std::uint64_t records,
              std::uint64_t blocks);
    [[nodiscard]] gpu::BufferPart header_part(const Place& place) const {
        return records_.part(place.header, shaders::bytes_of_header + place.block_bytes);
    }
    [[nodiscard]] HeaderOnDevice header_at(const Place& place,
                                           const BufferTarget& target = {}) const {
        return target.header_offset ? HeaderOnDevice{target.buffer, *target.header_offset}
                                    : HeaderOnDevice{records_.handle(), place.header};
    }
    /// Calls `use(target, place)` for each header that the host has a place for.
    template <class Use>
    void for_host_headers(const Use& use) const;
    [[nodiscard]] OutputSlot slot() const { return {0, revision_}; }
    void upload_tables();
    void make_resources(const ExportPipelines& passes);
    [[nodiscard]] gpu::BufferPart tables() const {
        return tables_.part(0, bytes_of(resident_->tables));
    }
    void bind_fields(std::span<const Words> words, const passes::ExportField& pass,
                     graph::DescriptorUpdates& updates);
    void bind_samples(std::span<const Words> words, const gpu::BufferPart& none,
                      const passes::ExportSamples& passes, graph::DescriptorUpdates& updates);
    [[nodiscard]] OutputState state(graph::Access access) const;
    /// The state of records or samples.
    [[nodiscard]] OutputState state(const BufferTarget& target) const;

    const gpu::Device* device_;
    const graph::ComputeLayout* layout_;
    const device_input::ResidentOutputs* resident_ = nullptr;
    gpu::MappedBuffer tables_;
    gpu::MappedBuffer records_;
    std::vector<Images> images_;  // by field
    std::vector<Views> views_;    // by field; of the images written
    // What was reserved stays, so that handles and offsets do: a batch uses the first ones of each.
    std::vector<Place> field_places_;
    std::vector<Place> places_;         // by records
    std::vector<Place> sample_places_;  // by samples
    bool are_laid_out_ = false;         // all places, and there is memory for them
    std::uint64_t revision_ = 0;        // see OutputSlot
    // What passes bind, and more of it that an earlier batch had.
    using Bound = std::vector<graph::BoundResources>;
    std::vector<Bound> bound_fields_;   // by field and part
    Bound bound_records_;               // by run
    std::vector<Bound> bound_samples_;  // by samples and run, at least one
    Bound bound_headers_;               // of the host, in the order of for_host_headers()
};

}  // namespace nearfield::render
