#include "answers.hpp"

#include <tests/support/pair_tables.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <sstream>

namespace nearfield::test {

Questions any_questions(Random& random, const Rectangle& box, int count) {
    Questions questions;
    const double width = box.max.x - box.min.x;
    const double height = box.max.y - box.min.y;
    const auto point = [&]() -> Vector2 {
        const Vector2 at{box.min.x + random.between(-0.1, 1.1) * width,
                         box.min.y + random.between(-0.1, 1.1) * height};
        // Whole numbers are where squares of whole numbers tie.
        return random.whole(0, 3) == 0 ? Vector2{std::round(at.x), std::round(at.y)} : at;
    };
    for (int i = 0; i < count; ++i) {
        questions.poses.push_back({point(), random.whole(0, 3) * random.between(-1.0, 1.0)});
        questions.points.push_back(point());
        questions.segments.push_back({point(), point()});
        const Vector2 low = point();
        questions.rectangles.push_back(
            {low, {low.x + random.scale(1e-3, 2.0), low.y + random.scale(1e-3, 2.0)}});
        if (i % 8 == 0) {
            const Pose start{point(), random.between(0.0, 3.0)};
            questions.sweeps.push_back({start, {point(), start.angle + random.whole(0, 1)}});
        }
    }
    if (random.whole(0, 3) == 0) {
        questions.options.filter.mask = static_cast<std::uint32_t>(random.whole(1, 15));
    }
    questions.clearances.min_clearance = random.whole(0, 1) == 0 ? 0.0 : -random.scale(1e-3, 1.0);
    questions.clearances.max_clearance = random.scale(1e-3, 3.0);
    questions.nearest.count = static_cast<std::uint32_t>(random.whole(1, 6));
    questions.edges.count = static_cast<std::uint32_t>(random.whole(1, 9));
    questions.edges.kind = NearestKind::edges;
    questions.nearest_of_shape.count = static_cast<std::uint32_t>(random.whole(1, 6));
    questions.edges_of_shape.count = questions.edges.count;
    if (random.whole(0, 1) == 0) {
        questions.nearest.max_distance = random.scale(1e-2, 5.0);
        questions.edges.max_distance = random.scale(1e-2, 5.0);
        questions.nearest_of_shape.max_distance = random.scale(1e-2, 5.0);
        questions.edges_of_shape.max_distance = questions.edges.max_distance;
    }
    questions.contact_distance = random.whole(0, 1) == 0 ? 0.0 : random.scale(1e-3, 0.5);
    return questions;
}

bool Answers::note(Status status, const char* call) {
    begin(call);
    if (!status.ok() && status_.ok()) {
        status_ = std::move(status);
    }
    return status_.ok();
}

void Answers::add(const RayHit& hit) {
    add(hit.instance);
    add(hit.parameter);
    add(hit.error_bound);
    add(hit.point);
    add(hit.normal);
    add(static_cast<double>(hit.edge));
}

void Answers::add(const InstanceLists& lists) {
    for (const std::uint32_t offset : lists.offsets) {
        add(static_cast<double>(offset));
    }
    for (const InstanceHandle handle : lists.instances) {
        add(handle);
    }
}

void Answers::add(const Clearance& clearance) {
    add(clearance.distance);
    add(clearance.error_bound);
    add(clearance.instance);
    add(clearance.point);
    add(clearance.nearest);
    add(clearance.direction);
}

void Answers::ask_clearances(World& world, const ClearanceQuery& query,
                             const Questions& questions) {
    std::vector<Clearance> clearances(questions.poses.size());
    if (!note(world.find_clearances(query, questions.poses, clearances, questions.options),
              "find_clearances")) {
        return;
    }
    for (const Clearance& clearance : clearances) {
        add(clearance);
    }
}

void Answers::ask_poses(World& world, ShapeHandle shape, const Questions& questions) {
    std::vector<std::uint8_t> intersects(questions.poses.size());
    if (!note(world.test_poses(shape, questions.poses, intersects, questions.options),
              "test_poses")) {
        return;
    }
    for (const std::uint8_t each : intersects) {
        add(static_cast<double>(each));
    }
    ask_clearances(world, {shape}, questions);
    ClearanceQuery limited = questions.clearances;
    limited.shape = shape;
    ask_clearances(world, limited, questions);
    ShapeNearestQuery several = questions.nearest_of_shape;
    several.shape = shape;
    std::vector<Clearance> nearest(questions.poses.size() * several.count);
    if (note(world.find_nearest(several, questions.poses, nearest, questions.options),
             "find_nearest of a shape")) {
        for (const Clearance& clearance : nearest) {
            add(clearance);
        }
    }
}

void Answers::ask_nearest(World& world, const NearestQuery& query, const Questions& questions) {
    std::vector<NearestHit> hits(questions.points.size() * query.count);
    if (!note(world.find_nearest(query, questions.points, hits, questions.options),
              "find_nearest")) {
        return;
    }
    for (const NearestHit& hit : hits) {
        add(hit.instance);
        add(hit.distance);
        add(hit.error_bound);
        add(hit.nearest);
        add(static_cast<double>(hit.feature.kind));
        add(static_cast<double>(hit.feature.index));
    }
}

void Answers::ask_edges(World& world, ShapeHandle shape, const Questions& questions) {
    ShapeEdgeQuery query = questions.edges_of_shape;
    query.shape = shape;
    std::vector<ShapeEdgeHit> hits(questions.poses.size() * query.count);
    if (!note(world.find_nearest(query, questions.poses, hits, questions.options),
              "find_nearest, edges of a shape")) {
        return;
    }
    for (const ShapeEdgeHit& hit : hits) {
        add(hit.instance);
        add(static_cast<double>(hit.edge));
        add(hit.distance);
        add(hit.error_bound);
        add(hit.point);
        add(hit.nearest);
        add(hit.direction);
    }
}

void Answers::ask_rays(World& world, const Questions& questions) {
    std::vector<RayHit> first(questions.segments.size());
    RayHits all;
    if (!note(world.cast_rays(questions.segments, first, questions.options), "cast_rays, first") ||
        !note(world.cast_rays(questions.segments, all, questions.options), "cast_rays, all")) {
        return;
    }
    for (const RayHit& hit : first) {
        add(hit);
    }
    for (const std::uint32_t offset : all.offsets) {
        add(static_cast<double>(offset));
    }
    for (const RayHit& hit : all.hits) {
        add(hit);
    }
}

void Answers::ask_casts(World& world, ShapeHandle shape, const Questions& questions) {
    std::vector<ShapeCastHit> hits(questions.sweeps.size());
    const ShapeCastQuery query{shape, questions.tolerance, questions.contact_distance};
    if (!note(world.cast_shape(query, questions.sweeps, hits, questions.options), "cast_shape")) {
        return;
    }
    for (const ShapeCastHit& hit : hits) {
        add(static_cast<double>(hit.state));
        add(hit.instance);
        add(hit.time);
        add(hit.time_error_bound);
        add(hit.error_bound);
        add(hit.point);
        add(hit.nearest);
        add(hit.direction);
    }
}

void Answers::ask_impacts(World& world, PairTable<TimeOfImpactQuery>& table,
                          std::span<const InstanceHandle> moving, std::span<const Pose> ends) {
    if (!note(world.update(table, {.moving = moving, .ends = ends}), "update of times of impact")) {
        return;
    }
    for (const PairRow<TimeOfImpactQuery>& row : table.rows()) {
        add(row.a);
        add(row.b);
        add(static_cast<double>(row.status));
        add(static_cast<double>(row.state));
        add(row.time);
        add(row.time_error_bound);
        add(row.error_bound);
        add(row.min_distance);
        add(row.point_a);
        add(row.point_b);
    }
}

void Answers::ask_pairs(World& world, std::span<const InstanceHandle> instances) {
    std::vector<InstanceHandle> a;
    std::vector<InstanceHandle> b;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        for (std::size_t j = i + 1; j < std::min(i + 4, instances.size()); ++j) {
            a.push_back(instances[i]);
            b.push_back(instances[j]);
        }
    }
    PairTable tests(IntersectionTestQuery{}, of_list);
    if (note(world.update(tests, {.a = a, .b = b}), "intersection tests of a list")) {
        for (const PairRow<IntersectionTestQuery>& row : tests.rows()) {
            add(static_cast<double>(row.status));
            add(row.intersects ? 1.0 : 0.0);
            add(row.error_bound);
        }
    }
    PairTable penetrations(
        PenetrationQuery{
            .tolerance = 0.05, .points = PenetrationPoints::vertices, .summary_only = true},
        of_list);
    if (note(world.update(penetrations, {.a = a, .b = b}), "penetrations of a list")) {
        for (const PairRow<PenetrationQuery>& row : penetrations.rows()) {
            add(static_cast<double>(row.status));
            add(row.intersects ? 1.0 : 0.0);
            add(static_cast<double>(row.count));
            add(row.deepest.depth);
            add(row.deepest.position);
            add(row.deepest.nearest);
        }
    }
}

void Answers::ask_overlaps(World& world, ShapeHandle shape, const Questions& questions) {
    InstanceLists lists;
    if (note(world.find_overlaps(questions.rectangles, lists, questions.options),
             "find_overlaps of rectangles")) {
        add(lists);
    }
    if (note(world.find_overlaps(questions.points, lists, questions.options),
             "find_overlaps of points")) {
        add(lists);
    }
    if (note(world.find_overlaps(shape, questions.poses, lists, questions.options),
             "find_overlaps of a shape")) {
        add(lists);
    }
}

void Answers::ask(World& world, ShapeHandle shape, const Questions& questions) {
    ask_poses(world, shape, questions);
    ask_nearest(world, questions.nearest, questions);
    ask_nearest(world, questions.edges, questions);
    ask_edges(world, shape, questions);
    ask_rays(world, questions);
    ask_casts(world, shape, questions);
    ask_overlaps(world, shape, questions);
}

std::string Answers::difference_from(const Answers& other) const {
    const std::size_t size = std::min(numbers_.size(), other.numbers_.size());
    for (std::size_t i = 0; i <= size; ++i) {
        const bool is_end = i == size;
        if (is_end && numbers_.size() == other.numbers_.size()) {
            return {};
        }
        if (!is_end && std::bit_cast<std::uint64_t>(numbers_[i]) ==
                           std::bit_cast<std::uint64_t>(other.numbers_[i])) {
            continue;
        }
        const auto part = std::find_if(parts_.rbegin(), parts_.rend(),
                                       [&](const Part& each) { return each.begin <= i; });
        std::ostringstream text;
        text.precision(17);
        text << part->name << ", number " << i - part->begin << ": ";
        if (is_end) {
            text << numbers_.size() << " numbers and " << other.numbers_.size();
        } else {
            text << numbers_[i] << " and " << other.numbers_[i];
        }
        return text.str();
    }
    return {};
}

}  // namespace nearfield::test
