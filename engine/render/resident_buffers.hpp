#pragma once

#include <engine/gpu/buffer.hpp>
#include <engine/gpu/buffer_parts.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/image.hpp>
#include <engine/graph/graph.hpp>
#include <engine/plan/resident_outputs.hpp>
#include <engine/plan/tile_batch.hpp>
#include <engine/render/compute_buffers.hpp>
#include <engine/render/resident_targets.hpp>
#include <nearfield/resident.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_sets.hpp>
#include <passes/export_field.hpp>
#include <passes/export_headers.hpp>
#include <passes/export_records.hpp>
#include <passes/export_samples.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::render {

/// The images and the buffer that one batch in flight provides to the host's shaders, and what the
/// passes need to fill them. Everything is kept from batch to batch and only grows: the first field
/// of a batch takes the first images, and so on.
class ResidentBuffers {
public:
    /// `views`: of images of the host. They must outlive this.
    ResidentBuffers(const gpu::Device& device, const passes::ComputeLayout& layout);

    /// Allocates memory and uploads the tables. `resident` has to stay unchanged until the next
    /// upload. Must not be called while the device uses these buffers or the host uses the resident
    /// outputs.
    void upload(const plan::ResidentOutputs& resident);

    /// Where a tile batch writes the words of its points (with their details) and of its fields,
    /// the summaries of its tiles, and the hits in the cells of intersections.
    struct Words {
        BufferPart points, field, summaries, hits;
        std::uint32_t point_count = 0;
    };
    /// Points the descriptor sets to the words, by tile batch; `none`: any part of the buffer that
    /// holds the words of points and fields. `summaries`: the buffer of all summaries.
    void bind(std::span<const Words> words, const BufferPart& none, VkBuffer summaries);

    [[nodiscard]] const plan::ResidentOutputs& resident() const { return *resident_; }
    /// What the passes record from; valid after bind().
    [[nodiscard]] passes::ExportField::Item field_item(std::size_t i) const;
    [[nodiscard]] passes::ExportRecords::Item records_item(std::size_t i) const;
    [[nodiscard]] passes::ExportSamples::Item samples_item(std::size_t i) const;
    [[nodiscard]] passes::ExportHeaders::Item headers_item() const;

    /// The resident output of the i-th field, records or samples of the batch.
    [[nodiscard]] ResidentField field(std::size_t i) const;
    [[nodiscard]] ResidentRecords records(std::size_t i) const;
    [[nodiscard]] ResidentSamples samples(std::size_t i) const;

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
        std::uint64_t header = 0;
        std::uint64_t records = 0;  ///< the summary, followed by records or samples
        std::uint64_t blocks = 0;
        std::uint64_t record_bytes = 0;  ///< reserved
        std::uint64_t block_bytes = 0;   ///< reserved
    };

    void reserve_images();
    void find_views();
    /// Where the summary of records or samples and what follows it lie.
    [[nodiscard]] BufferPart range_of(std::size_t i, const plan::RecordsOutput& records) const;
    [[nodiscard]] BufferPart range_of(std::size_t i, const plan::SamplesOutput& samples) const;
    void lay_out_buffer();
    void move_places();
    /// Makes the place of an output as large as it has to be.
    void grow(std::vector<Place>& places, std::size_t i, std::uint64_t records,
              std::uint64_t blocks);
    void bind_headers();
    [[nodiscard]] ResidentHeader header_at(const Place& place) const {
        return {records_.handle(), place.header};
    }
    [[nodiscard]] ResidentSlot slot() const { return {0, revision_}; }
    void upload_tables();
    void make_sets();
    void append_sets(std::size_t count, std::vector<passes::DescriptorSets>& own);
    void bind_fields(std::span<const Words> words, std::span<const VkDescriptorSet>& sets) const;
    void bind_points(std::span<const Words> words, const BufferPart& none,
                     std::span<const VkDescriptorSet>& sets);
    void bind_samples(std::span<const Words> words, const BufferPart& none,
                      std::span<const VkDescriptorSet>& sets) const;
    void bind_words(VkDescriptorSet set, const BufferPart& words) const;
    void bind_records(VkDescriptorSet set, const Place& place, const BufferPart& range) const;
    [[nodiscard]] ResidentState state(graph::Access access) const;
    /// The state of records or samples.
    [[nodiscard]] ResidentState state(const ResidentBufferTarget& target) const;

    const gpu::Device* device_;
    const passes::ComputeLayout* layout_;
    const plan::ResidentOutputs* resident_ = nullptr;
    gpu::MappedBuffer tables_;
    gpu::MappedBuffer records_;
    std::vector<Images> images_;  // by field
    std::vector<Views> views_;    // by field; of the images written
    // What was reserved stays, so that handles and offsets do: a batch uses the first ones of each.
    std::vector<Place> field_places_;
    std::vector<Place> places_;                    // by records
    std::vector<Place> sample_places_;             // by samples
    bool are_laid_out_ = false;                    // all places, and there is memory for them
    std::uint64_t revision_ = 0;                   // see ResidentSlot
    std::vector<std::uint32_t> details_;           // by run of points
    std::vector<plan::ExportHeaderPush> headers_;  // of fields, records, samples
    // Fields, records and samples each have their own, so that everything that a set was ever bound
    // to is bound anew with every use: lavapipe reads bindings that no shader uses, and the objects
    // they refer to may be gone.
    std::vector<passes::DescriptorSets> sets_of_images_;
    std::vector<passes::DescriptorSets> sets_of_buffers_;
    std::vector<passes::DescriptorSets> sets_of_headers_;
    /// By part of a field; then, for each records output, one per run and one more; then, for each
    /// samples output, two per run and one more; then one per header.
    std::vector<VkDescriptorSet> sets_;
    VkBuffer words_ = VK_NULL_HANDLE;
    VkBuffer summaries_ = VK_NULL_HANDLE;
};

}  // namespace nearfield::render
