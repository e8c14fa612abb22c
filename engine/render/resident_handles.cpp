#include <engine/graph/access.hpp>
#include <engine/render/resident_buffers.hpp>

namespace nearfield::render {

// The part of ResidentBuffers that tells the host where its results are.

OutputState ResidentBuffers::state(graph::Access access) const {
    const graph::AccessTraits traits = graph::traits(access, device_->queue_flags());
    const bool exclusive = device_->reader_families().empty();
    return {traits.stages, traits.access(), traits.layout,
            exclusive ? device_->queue_family() : VK_QUEUE_FAMILY_IGNORED};
}

OutputState ResidentBuffers::state(const BufferTarget& target) const {
    return target.buffer == VK_NULL_HANDLE
               ? state(graph::Access::exported_buffer)
               : OutputState{target.after.stages, target.after.access, VK_IMAGE_LAYOUT_UNDEFINED,
                             device_->queue_family()};
}

FieldOnDevice ResidentBuffers::field(std::size_t i) const {
    const plan::FieldOutputs& field = resident_->fields[i];
    const Images& images = images_[i];
    VkExtent2D extent{};
    const auto image = [&](const ImageTarget& target, const gpu::KeptImage& kept,
                           VkImageView view) {
        if (target.image != VK_NULL_HANDLE) {
            return ImageOnDevice{target.image, view, target.format};
        }
        extent = kept.extent();
        return ImageOnDevice{kept.handle(), view, kept.format()};
    };
    const ImageOnDevice signed_distance =
        image(field.target.signed_distance, images.signed_distance, views_[i].signed_distance);
    ImageOnDevice feature;
    if (field.has_features) {
        feature = image(field.target.feature, images.feature, views_[i].feature);
    }
    return {signed_distance,
            feature,
            field.width,
            field.height,
            extent,
            geometry::to_public(field.origin),
            field.cell,
            field.error_bound,
            state(graph::Access::exported_image),
            header_at(field_places_[i]),
            slot()};
}

PointsOnDevice ResidentBuffers::records(std::size_t i) const {
    const plan::RecordsOutput& records = resident_->records[i];
    const gpu::BufferPart range = range_of(i, records);
    const std::uint64_t max_size =
        sizeof(SummaryData) + std::uint64_t{records.max_capacity} * sizeof(PointData);
    return {range.buffer,          range.offset,
            range.bytes,           max_size,
            records.capacity,      geometry::to_public(records.origin),
            records.error_bound,   state(records.target),
            header_at(places_[i]), slot()};
}

SamplesOnDevice ResidentBuffers::samples(std::size_t i) const {
    const plan::SamplesOutput& samples = resident_->samples[i];
    const gpu::BufferPart range = range_of(i, samples);
    return {range.buffer,
            range.offset,
            range.bytes,
            samples.capacity,
            geometry::to_public(samples.origin),
            samples.cell,
            samples.error_bound,
            state(samples.target),
            header_at(sample_places_[i]),
            slot()};
}

}  // namespace nearfield::render
