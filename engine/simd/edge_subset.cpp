#include <engine/simd/edge_subset.hpp>

namespace nearfield::simd {

void EdgeSubset::pick(const TransformedEdges& from, const Extent& box) {
    count_ = kernels::find_edges_in(from, box, indices_);
    if (count_ == 0) {
        return;
    }
    for (std::uint32_t i = 0; i < count_; ++i) {
        const std::uint32_t index = indices_[i];
        start_x_[i] = from.start_x[index];
        start_y_[i] = from.start_y[index];
        end_x_[i] = from.end_x[index];
        end_y_[i] = from.end_y[index];
        inverse_length_[i] = from.inverse_length[index];
    }
    // The padding is a zero-length edge, which no ray crosses.
    for (std::size_t i = count_; i < padded(count_); ++i) {
        start_x_[i] = end_x_[i] = end_x_[count_ - 1];
        start_y_[i] = end_y_[i] = end_y_[count_ - 1];
        inverse_length_[i] = 0.0;
    }
}

EdgeArrays EdgeSubset::edges() const {
    return {count_, start_x_, start_y_, end_x_, end_y_, inverse_length_};
}

}  // namespace nearfield::simd
