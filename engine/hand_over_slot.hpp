#pragma once

#include <engine/buffer_parts.hpp>
#include <engine/compute_buffers.hpp>
#include <engine/gpu/buffer.hpp>
#include <engine/gpu/device.hpp>
#include <engine/gpu/image.hpp>
#include <engine/graph/graph.hpp>
#include <engine/plan/hand_over.hpp>
#include <engine/plan/round.hpp>
#include <nearfield/resident.hpp>
#include <passes/compute_layout.hpp>
#include <passes/compute_sets.hpp>
#include <passes/hand_over_field.hpp>
#include <passes/hand_over_records.hpp>
#include <passes/hand_over_samples.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// The images and the buffer that one batch in flight leaves to the host's shaders, and what the
/// passes need to fill them. Everything is kept from batch to batch and only grows: the first field
/// of a batch takes the first images, and so on.
class HandOverSlot {
public:
    HandOverSlot(const gpu::Device& device, const passes::ComputeLayout& layout);

    /// Makes room and takes the tables to the device. `hand_over` has to stay as it is until the
    /// next one. Not while the device uses the slot, or the host what was handed over.
    void upload(const plan::HandOver& hand_over);

    /// Where a round leaves the words of its points, with their details, of its fields, and the
    /// summaries of its tiles; and what it found in the cells of intersections.
    struct Words {
        BufferPart points, field, summaries, hits;
        std::uint32_t point_count = 0;
    };
    /// Points the descriptor sets to the words, by round; `none`: some part of the buffer that
    /// words of points and fields are in. `summaries`: the buffer of all summaries.
    void bind(std::span<const Words> words, const BufferPart& none, VkBuffer summaries);

    [[nodiscard]] const plan::HandOver& hand_over() const { return *hand_over_; }
    /// What the passes record from; after bind().
    [[nodiscard]] passes::HandOverField::Item field_item(std::size_t i) const;
    [[nodiscard]] passes::HandOverRecords::Item records_item(std::size_t i) const;
    [[nodiscard]] passes::HandOverSamples::Item samples_item(std::size_t i) const;

    /// What is handed over of the i-th field, records or samples of the batch.
    [[nodiscard]] ResidentField field(std::size_t i) const;
    [[nodiscard]] ResidentRecords records(std::size_t i) const;
    [[nodiscard]] ResidentSamples samples(std::size_t i) const;

private:
    struct Images {
        gpu::KeptImage signed_distance;
        gpu::KeptImage feature;
    };
    struct Place {
        std::uint64_t records = 0;  ///< in the buffer: the summary, behind it records or samples
        std::uint64_t blocks = 0;
        std::uint64_t end = 0;
    };

    void lay_out_buffer();
    [[nodiscard]] Place place_at(std::uint64_t end, std::uint64_t records,
                                 std::uint64_t blocks) const;
    void upload_tables();
    void make_sets();
    void append_sets(std::size_t count, std::vector<passes::DescriptorSets>& own);
    void bind_fields(std::span<const Words> words, std::span<const VkDescriptorSet>& sets) const;
    void bind_points(std::span<const Words> words, const BufferPart& none,
                     std::span<const VkDescriptorSet>& sets);
    void bind_samples(std::span<const Words> words, const BufferPart& none,
                      std::span<const VkDescriptorSet>& sets) const;
    void bind_words(VkDescriptorSet set, const BufferPart& words) const;
    void bind_records(VkDescriptorSet set, const Place& place) const;
    [[nodiscard]] HandedOver state(graph::Access access) const;

    const gpu::Device* device_;
    const passes::ComputeLayout* layout_;
    const plan::HandOver* hand_over_ = nullptr;
    gpu::MappedBuffer tables_;
    gpu::MappedBuffer records_;
    std::vector<Images> images_;          // by field
    std::vector<Place> places_;           // by records
    std::vector<Place> sample_places_;    // by samples
    std::vector<std::uint32_t> details_;  // by run of points
    // Of fields, and of records and samples, each their own, so that all that a set was ever bound
    // to is bound anew with every use: lavapipe reads bindings that no shader does, and what they
    // name may be gone.
    std::vector<passes::DescriptorSets> sets_of_images_;
    std::vector<passes::DescriptorSets> sets_of_buffers_;
    /// By part of a field; then, for each records, by run and one more; then, for each samples, two
    /// by run and one more.
    std::vector<VkDescriptorSet> sets_;
    VkBuffer words_ = VK_NULL_HANDLE;
    VkBuffer summaries_ = VK_NULL_HANDLE;
};

}  // namespace nearfield
