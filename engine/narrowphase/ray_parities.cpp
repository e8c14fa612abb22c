#include <engine/narrowphase/ray_parities.hpp>

#include <algorithm>

namespace nearfield::narrowphase {

using simd::VisitsLeft;
using simd::kernels::LineOfEdge;
using simd::kernels::Ray;

void RayParities::Batch::clear() {
    x.clear();
    y.clear();
    along_x.clear();
    along_y.clear();
    tickets.clear();
}

void RayParities::begin(const simd::AabbTree& tree) {
    tree_.emplace(tree);
    trials_ = {};
    from_points_.clear();
    for (Batch& batch : from_edges_) {
        batch.clear();
    }
    parities_.assign({0, 1});
}

template <class Search>
RayParities::Ticket RayParities::find(const Search& search, Batch& batch, const Ray& ray) {
    if (!trials_.skip()) {
        VisitsLeft left{most_visits};
        const bool is_odd = search(left);
        trials_.record(left.count == 0);
        if (left.count > 0) {
            return known(is_odd);
        }
    }
    const auto ticket = static_cast<Ticket>(parities_.size());
    batch.x.push_back(ray.x);
    batch.y.push_back(ray.y);
    batch.tickets.push_back(ticket);
    parities_.push_back(0);
    return ticket;
}

RayParities::Ticket RayParities::ask(double x, double y) {
    const Ray ray{x, y};
    return find(
        [&](VisitsLeft& left) { return simd::kernels::crossings_are_odd(*tree_, ray, left); },
        from_points_, ray);
}

RayParities::Ticket RayParities::ask(const Ray& ray, const LineOfEdge& line) {
    Batch& batch = from_edges_[ray.upwards ? 1 : 0];
    const Ticket ticket = find(
        [&](VisitsLeft& left) {
            return simd::kernels::crossings_of_others_are_odd(*tree_, ray, line, left);
        },
        batch, ray);
    if (ticket > odd) {
        batch.along_x.push_back(line.along_x);
        batch.along_y.push_back(line.along_y);
        rounding_ = line.rounding;
    }
    return ticket;
}

void RayParities::answer() {
    answer(from_points_, false);
    from_points_.clear();
    for (const bool upwards : {false, true}) {
        answer(from_edges_[upwards ? 1 : 0], upwards);
        from_edges_[upwards ? 1 : 0].clear();
    }
}

void RayParities::answer(const Batch& batch, bool upwards) {
    if (batch.tickets.empty()) {
        return;
    }
    const bool is_on_edges = !batch.along_x.empty();
    const simd::kernels::Rays rays{static_cast<std::uint32_t>(batch.tickets.size()),
                                   batch.x.data(),
                                   batch.y.data(),
                                   is_on_edges ? batch.along_x.data() : nullptr,
                                   is_on_edges ? batch.along_y.data() : nullptr,
                                   rounding_,
                                   upwards};
    if (found_.size() < rays.count) {
        found_.resize(rays.count);
    }
    simd::kernels::find_odd_crossings(tree_->all_edges(), rays, division_, found_.data());
    for (std::uint32_t i = 0; i < rays.count; ++i) {
        parities_[batch.tickets[i]] = found_[i];
    }
}

}  // namespace nearfield::narrowphase
