#include <engine/edge_samples.hpp>

#include <algorithm>

namespace nearfield {

exact::PointArrays EdgeSamples::sample(const exact::PlacedEdges& edges, const geometry::Box& within,
                                       double spacing) {
    if (near_.size() < exact::padded(edges.count)) {
        near_.resize(exact::padded(edges.count));
    }
    const std::uint32_t near =
        exact::kernels::find_edges_in(edges, exact::extent_of(within), near_.data());
    places_.clear();
    plan::sample_edges(edges.placed, {near_.data(), near}, spacing, within, places_);
    const std::size_t room = exact::padded(places_.size());
    // Each by itself: where memory ran out between the two, they differ.
    x_.resize(std::max(x_.size(), room));
    y_.resize(std::max(y_.size(), room));
    const exact::Extent box = exact::extent_of(within);
    std::uint32_t count = 0;
    for (const auto& [edge, parameter] : places_) {
        // As plan::position() has it.
        const double x =
            edges.start_x[edge] + parameter * (edges.end_x[edge] - edges.start_x[edge]);
        const double y =
            edges.start_y[edge] + parameter * (edges.end_y[edge] - edges.start_y[edge]);
        x_[count] = x;
        y_[count] = y;
        const bool is_in = x >= box.low_x && x <= box.high_x && y >= box.low_y && y <= box.high_y;
        count += is_in ? 1U : 0U;
    }
    return {count, x_.data(), y_.data()};
}

}  // namespace nearfield
