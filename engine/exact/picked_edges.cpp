#include <engine/exact/picked_edges.hpp>

namespace nearfield::exact {

void PickedEdges::pick(const PlacedEdges& from, const Extent& box) {
    count_ = kernels::find_edges_in(from, box, indices_);
    if (count_ == 0) {
        return;
    }
    const auto lanes = static_cast<std::uint32_t>(padded(count_));
    for (std::uint32_t i = 0; i < lanes; ++i) {
        // What fills up the last lanes is the last one once more.
        const std::uint32_t index = indices_[i < count_ ? i : count_ - 1];
        start_x_[i] = from.start_x[index];
        start_y_[i] = from.start_y[index];
        end_x_[i] = from.end_x[index];
        end_y_[i] = from.end_y[index];
        inverse_length_[i] = from.inverse_length[index];
    }
}

EdgeArrays PickedEdges::edges() const {
    return {count_, start_x_, start_y_, end_x_, end_y_, inverse_length_};
}

}  // namespace nearfield::exact
