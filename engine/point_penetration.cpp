#include <engine/nearest_feature.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/region.hpp>
#include <engine/point_penetration.hpp>

#include <utility>

namespace nearfield {

using exact::PlacedEdges;

void PointPenetration::answer(const plan::PlannedQuery& query, exact::PlacedInstances& instances,
                              PenetrationResult& result) {
    const bool reversed = last_.query + 1 == &query && is_reverse(*last_.query, query);
    const InstancePairIndex pair =
        reversed ? InstancePairIndex{last_.index.b, last_.index.a} : place_pair(query, instances);
    const PlacedEdges& a = instances[pair.a];
    const PlacedEdges& b = instances[pair.b];
    if (Status status = check_numbers(query, a, b, result.tolerance); !status.ok()) {
        result.status = std::move(status);
        return;
    }
    complete_if_near(pair, instances);
    const auto& asked = std::get<PenetrationQuery>(*query.query);
    const bool is_sampled = asked.points == PenetrationPoints::boundary;
    if (asked.records && a.box.intersects(b.box)) {
        result.regions.push_back(
            plan::region_of(plan::Grid::covering(a.box.intersection(b.box), result.cell)));
    }
    if (!reversed || last_.intersects) {
        inside_.clear();
        if (a.box.intersects(b.box) && is_sampled) {
            samples_.find(a, b, reversed && last_.is_sampled, result.cell, inside_);
        } else if (a.box.intersects(b.box)) {
            find_vertices_inside(a.starts(), b);
        }
        if (inside_.size() > 0) {
            nearest_.find(inside_.arrays(), b, result.tolerance * plan::uniqueness_margin);
            write(a.rounding + b.rounding, b, asked.records, result);
        }
        // Of a ring of A that lies in B some point is found: it has a vertex that is a sample.
        result.intersects =
            result.intersects || reversed || meeting_.intersect_without_vertex_inside(a, b);
    }
    last_ = {&query, pair, result.intersects, is_sampled};
}

void PointPenetration::find_vertices_inside(const exact::PointArrays& vertices,
                                            const PlacedEdges& b) {
    inside_.reserve(vertices.count);
    const exact::Extent box = exact::extent_of(b.box);
    const exact::FoundPoints found = inside_.found();
    if (exact::is_small(b)) {
        inside_.resize(
            exact::kernels::find_points_inside(vertices, box, b, beside_.data(), found));
    } else {
        boundary_.set(b);
        inside_.resize(boundary_.keep_inside(
            exact::kernels::find_points_in(vertices, box, found), found));
    }
}

void PointPenetration::write(double touching, const PlacedEdges& b, bool keep_records,
                             PenetrationResult& result) {
    std::size_t deepest = 0;
    double most = 0.0;
    const double* const distance = nearest_.arrays().distance;
    result.intersects = true;
    for (std::size_t i = 0; i < inside_.size(); ++i) {
        if (distance[i] <= touching) {
            continue;
        }
        ++result.count;
        if (keep_records) {
            write(b, i, result.records.emplace_back());
        }
        if (distance[i] > most) {
            deepest = i;
            most = distance[i];
        }
    }
    if (result.count > 0) {
        write(b, deepest, result.deepest);
    }
}

void PointPenetration::write(const PlacedEdges& b, std::size_t i, PenetrationRecord& record) {
    const exact::PointArrays points = inside_.arrays();
    const exact::NearestArrays& nearest = nearest_.arrays();
    const double depth = nearest.distance[i];
    record.point = {points.x[i], points.y[i]};
    record.depth = depth;
    record.nearest = {nearest.x[i], nearest.y[i]};
    record.direction = {(record.nearest.x - record.point.x) / depth,
                        (record.nearest.y - record.point.y) / depth};
    record.feature = feature_at(b.placed, nearest.edge[i], nearest.parameter[i]);
    record.unique = nearest_.is_unique(i);
}

}  // namespace nearfield
