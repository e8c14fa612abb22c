#include "pair.hpp"

#include <gtest/gtest.h>
#include <tests/oracle/boundary.hpp>
#include <tests/oracle/overlap.hpp>

#include <cmath>
#include <sstream>

namespace nearfield::test {
namespace {

ShapeHandle add(Context& context, const NamedRings& shape) {
    Expected<ShapeHandle> handle = context.add_shape(shape.rings);
    EXPECT_TRUE(handle.has_value()) << shape.name << ": " << handle.error().text();
    return handle.has_value() ? *handle : ShapeHandle{};
}

Vector2 any_offset(Random& random) {
    if (random.whole(0, 3) > 0) {
        return {};
    }
    return {random.between(-1e6, 1e6), random.between(-1e6, 1e6)};
}

}  // namespace

PlacedPair::PlacedPair(Context& context, Pair pair, Technique technique)
    : context_(&context),
      technique_(technique),
      pair_(std::move(pair)),
      oracle_a_(pair_.a.rings, pair_.pose_a),
      oracle_b_(pair_.b.rings, pair_.pose_b),
      handle_a_(add(context, pair_.a)),
      handle_b_(add(context, pair_.b)) {}

PlacedPair::~PlacedPair() {
    for (const ShapeHandle handle : {handle_a_, handle_b_}) {
        const Status status = context_->remove_shape(handle);
        EXPECT_TRUE(status.ok()) << status.text();
    }
}

Truth PlacedPair::intersects() const {
    if (!intersects_) {
        intersects_ = find_whether_they_intersect();
    }
    return *intersects_;
}

Truth PlacedPair::find_whether_they_intersect() const {
    const bool apart = oracle::boundary_distance(oracle_a_, oracle_b_) > rounding();
    const bool intersect = oracle::intersects(oracle_a_, oracle_b_);
    if (apart) {
        return intersect ? Truth::yes : Truth::no;
    }
    const double accuracy = tolerance() / 10;
    const bool clear =
        oracle::deepest_on_boundary(oracle_a_, oracle_b_, accuracy).depth > rounding() ||
        oracle::deepest_on_boundary(oracle_b_, oracle_a_, accuracy).depth > rounding();
    return clear ? Truth::yes : Truth::too_close_to_call;
}

namespace {

template <class Query>
Query asked(const PlacedPair& pair, Technique technique) {
    Query query;
    query.a = pair.instance_a();
    query.b = pair.instance_b();
    query.tolerance = pair.tolerance();
    query.technique = technique;
    return query;
}

}  // namespace

double PlacedPair::common_area() const {
    if (!common_area_) {
        common_area_ = oracle::overlap(oracle_a_, oracle_b_).area;
    }
    return *common_area_;
}

PenetrationQuery PlacedPair::penetration(PenetrationPoints points) const {
    auto query = asked<PenetrationQuery>(*this, technique_);
    query.points = points;
    return query;
}

IntersectionQuery PlacedPair::intersection(IntersectionKind kind) const {
    auto query = asked<IntersectionQuery>(*this, technique_);
    query.kind = kind;
    return query;
}

ContactQuery PlacedPair::contacts(double contact_distance) const {
    auto query = asked<ContactQuery>(*this, technique_);
    query.contact_distance = contact_distance;
    return query;
}

SeparationQuery PlacedPair::separation() const {
    return {instance_a(), instance_b(), tolerance(), technique_};
}

ClosestPointQuery PlacedPair::closest_point() const {
    return {instance_a(), instance_b(), tolerance(), technique_};
}

Pose pose_at(const Vector2& own, const Vector2& world, double angle) {
    const double cosine = std::cos(angle);
    const double sine = std::sin(angle);
    return {{world.x - (cosine * own.x - sine * own.y), world.y - (sine * own.x + cosine * own.y)},
            angle};
}

Pair any_pair(Random& random) {
    const double size_a = random.scale(0.5, 50.0);
    const double size_b = size_a * random.scale(0.2, 5.0);
    const Vector2 own_a = any_offset(random);
    const Vector2 own_b = any_offset(random);
    const Vector2 world_a = any_offset(random);
    const double direction = random.between(-3.2, 3.2);
    const double apart = random.between(0.0, 0.8) * (size_a + size_b);
    const Vector2 world_b{world_a.x + apart * std::cos(direction),
                          world_a.y + apart * std::sin(direction)};
    Pair pair;
    pair.a = any_shape(random);
    pair.b = any_shape(random);
    pair.a.rings = scaled_and_moved(pair.a.rings, size_a, own_a);
    pair.b.rings = scaled_and_moved(pair.b.rings, size_b, own_b);
    pair.pose_a = pose_at(own_a, world_a, random.between(-4.0, 4.0));
    pair.pose_b = pose_at(own_b, world_b, random.between(-4.0, 4.0));
    pair.tolerance = std::min(size_a, size_b) * random.scale(0.008, 0.15);
    return pair;
}

std::vector<Pair> family_pairs(std::uint64_t seed) {
    Random random(seed);
    const std::vector<NamedRings> shapes = every_family(seed);
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        Pair pair;
        pair.a = shapes[i];
        pair.b = shapes[(i + 1 + seed % (shapes.size() - 1)) % shapes.size()];
        pair.a.rings = scaled_and_moved(pair.a.rings, 10.0, {});
        pair.b.rings = scaled_and_moved(pair.b.rings, 10.0, {});
        pair.pose_a.angle = random.between(-4.0, 4.0);
        pair.pose_b = {{random.between(-9.0, 9.0), random.between(-4.0, 4.0)}, 0.3};
        pair.tolerance = 0.15;
        pairs.push_back(std::move(pair));
    }
    return pairs;
}

std::string describe(const Pair& pair) {
    std::ostringstream text;
    text.precision(17);
    const auto write = [&](const char* name, const NamedRings& shape, const Pose& pose) {
        text << name << " = " << shape.name << ' ' << to_text(shape.rings) << " at ("
             << pose.translation.x << ", " << pose.translation.y << ") turned by " << pose.angle
             << '\n';
    };
    write("A", pair.a, pair.pose_a);
    write("B", pair.b, pair.pose_b);
    text << "d = " << pair.tolerance;
    return text.str();
}

}  // namespace nearfield::test
