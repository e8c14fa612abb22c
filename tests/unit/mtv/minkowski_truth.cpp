#include <engine/geometry/segment.hpp>
#include <engine/mtv/separating_translation.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace nearfield::mtv {
namespace {

using geometry::Polygon;
using geometry::Vector;
using samples::Rings;

using Convex = std::vector<Vector>;  ///< counter-clockwise

/// A shape and convex parts whose union it is.
struct Parted {
    Rings rings;
    std::vector<Convex> parts;
};

double cross(const Vector& i, const Vector& j) {
    return i.x() * j.y() - i.y() * j.x();
}

Convex rectangle(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// A bar with teeth upwards: `teeth` of width `tooth`, one every unit.
Parted comb(int teeth, double tooth, double high) {
    Parted shape;
    Ring ring{{teeth - 1 + tooth, -0.3}, {0.0, -0.3}};
    std::reverse(ring.begin(), ring.end());
    shape.parts.push_back(rectangle(0.0, -0.3, teeth - 1 + tooth, 0.0));
    for (int i = teeth - 1; i >= 0; --i) {
        const double x = i;
        ring.insert(ring.end(), {{x + tooth, 0.0}, {x + tooth, high}, {x, high}, {x, 0.0}});
        shape.parts.push_back(rectangle(x, 0.0, x + tooth, high));
    }
    shape.rings = {ring};
    return shape;
}

/// Around the origin; its parts are the triangles between the origin and the edges.
Parted star(samples::Random& random, std::uint32_t size) {
    Parted shape;
    shape.rings = {samples::star(random, size, 0.25, 1.0)};
    for (std::uint32_t i = 0; i < size; ++i) {
        const Vector2 one = shape.rings[0][i];
        const Vector2 next = shape.rings[0][(i + 1) % size];
        shape.parts.push_back({Vector::Zero(), {one.x, one.y}, {next.x, next.y}});
    }
    return shape;
}

/// A square with a square hole.
Parted frame(double outer, double inner) {
    return {{samples::rectangle(-outer, -outer, outer, outer),
             samples::rectangle(-inner, -inner, inner, inner)},
            {rectangle(-outer, -outer, outer, -inner), rectangle(-outer, inner, outer, outer),
             rectangle(-outer, -inner, -inner, inner), rectangle(inner, -inner, outer, inner)}};
}

/// Rectangles beside each other that do not touch.
Parted scattered(samples::Random& random) {
    Parted shape;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 2; ++row) {
            const double x = 0.7 * column - 1.0 + random.between(0.0, 0.1);
            const double y = 0.7 * row - 0.7 + random.between(0.0, 0.1);
            const double right = x + random.between(0.2, 0.55);
            const double up = y + random.between(0.2, 0.55);
            shape.rings.push_back(samples::rectangle(x, y, right, up));
            shape.parts.push_back(rectangle(x, y, right, up));
        }
    }
    return shape;
}

Convex placed(const Convex& part, const Pose& pose, double sign) {
    Convex result;
    const Eigen::Rotation2Dd turn(pose.angle);
    for (const Vector& vertex : part) {
        result.push_back(sign * (turn * vertex + Vector(pose.translation.x, pose.translation.y)));
    }
    return result;
}

/// The convex hull, counter-clockwise, of few points.
Convex hull_of(Convex points) {
    std::sort(points.begin(), points.end(), [](const Vector& i, const Vector& j) {
        return i.x() < j.x() || (i.x() == j.x() && i.y() < j.y());
    });
    Convex hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = hull.size();
        for (const Vector& point : points) {
            while (hull.size() >= first + 2 &&
                   cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 1e-13) {
                hull.pop_back();
            }
            hull.push_back(point);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

/// All translations of A for which the shapes share a point: a convex polygon for each pair of
/// parts, the Minkowski sum of B's and the mirrored part of A.
std::vector<Convex> overlapping_translations(const Parted& a, const Pose& pose_a, const Parted& b,
                                             const Pose& pose_b) {
    std::vector<Convex> sums;
    for (const Convex& part_a : a.parts) {
        const Convex mirrored = placed(part_a, pose_a, -1.0);
        for (const Convex& part_b : b.parts) {
            Convex points;
            for (const Vector& of_b : placed(part_b, pose_b, 1.0)) {
                for (const Vector& of_a : mirrored) {
                    points.emplace_back(of_b + of_a);
                }
            }
            sums.push_back(hull_of(points));
        }
    }
    return sums;
}

bool contains(const Convex& convex, const Vector& point) {
    for (std::size_t i = 0; i < convex.size(); ++i) {
        const Vector& start = convex[i];
        const Vector& end = convex[(i + 1) % convex.size()];
        if (cross(end - start, point - start) < 0.0) {
            return false;
        }
    }
    return true;
}

struct Segment {
    Vector start;
    Vector end;
};

/// Where the shortest way out can end, if shorter than `longest`: at right angles to an edge of one
/// of the polygons, or where two edges cross.
std::vector<Vector> candidate_ends(const std::vector<Convex>& sums, double longest) {
    std::vector<Segment> edges;
    std::vector<Vector> ends;
    for (const Convex& sum : sums) {
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const Segment edge{sum[i], sum[(i + 1) % sum.size()]};
            const auto foot = geometry::nearest_on_segment(Vector::Zero(), edge.start, edge.end);
            if (foot.squared_distance < longest * longest) {
                edges.push_back(edge);
                ends.push_back(foot.point);
            }
        }
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const Vector along = edges[i].end - edges[i].start;
            const Vector other = edges[k].end - edges[k].start;
            const Vector between = edges[k].start - edges[i].start;
            const double area = cross(along, other);
            const double part = cross(between, other) / area;
            const double other_part = cross(between, along) / area;
            if (part >= 0.0 && part <= 1.0 && other_part >= 0.0 && other_part <= 1.0) {
                ends.emplace_back(edges[i].start + part * along);
            }
        }
    }
    return ends;
}

/// The length of the shortest separating translation below `longest`, or that: ends are tried a
/// little way off in many directions, so a way out narrower than twice that may be missed.
double shortest_below(const std::vector<Convex>& sums, double longest, double little) {
    constexpr int directions = 64;
    double shortest = longest;
    for (const Vector& end : candidate_ends(sums, longest)) {
        for (int i = 0; i < directions && end.norm() < shortest; ++i) {
            const double angle = 2.0 * std::numbers::pi * (i + 0.3) / directions;
            const Vector beside = end + little * Vector(std::cos(angle), std::sin(angle));
            if (std::none_of(sums.begin(), sums.end(),
                             [&](const Convex& sum) { return contains(sum, beside); })) {
                shortest = end.norm();
            }
        }
    }
    return shortest;
}

struct Found {
    SeparatingTranslation way;
    double truth = 0.0;
};

constexpr double little = 1e-8;

/// Holds what is found against the truth.
Found check(const Parted& a, const Pose& pose_a, const Parted& b, const Pose& pose_b,
            double tolerance, std::uint64_t max_work = 20'000'000) {
    const Polygon polygon_a = samples::polygon(a.rings);
    const Polygon polygon_b = samples::polygon(b.rings);
    simd::TransformedInstances instances;
    const std::uint32_t index_a = instances.place(polygon_a, pose_a);
    const std::uint32_t index_b = instances.place(polygon_b, pose_b);
    instances.complete(index_a);
    instances.complete(index_b);
    SeparatingTranslationFinder finder;
    Found found;
    found.way = finder.find(instances[index_a], instances[index_b], pose_a, {tolerance, max_work});
    const std::vector<Convex> sums = overlapping_translations(a, pose_a, b, pose_b);
    const auto meet_after = [&](const Vector& shift) {
        return std::any_of(sums.begin(), sums.end(),
                           [&](const Convex& sum) { return contains(sum, shift); });
    };
    EXPECT_EQ(found.way.intersect, meet_after(Vector::Zero()));
    if (found.way.intersect) {
        EXPECT_FALSE(meet_after(found.way.vector));
        const double length = found.way.vector.norm();
        found.truth = shortest_below(sums, length, little);
        EXPECT_LE(found.way.lower_bound, found.truth + little);
        EXPECT_LE(found.way.lower_bound, length);
    }
    return found;
}

Pose any_pose(samples::Random& random, double far) {
    return {{random.between(-far, far), random.between(-far, far)},
            random.below(3) == 0 ? 0.0 : random.between(-3.0, 3.0)};
}

TEST(MinkowskiTruth, StarsOfManyEdges) {
    samples::Random random(701);
    int close = 0;
    int cases = 0;
    for (int i = 0; i < 24; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const Parted a = star(random, 5 + random.below(6));
        const Parted b = star(random, 5 + random.below(6));
        const Found found =
            check(a, any_pose(random, 0.5), b, any_pose(random, 0.1), 1e-3, 20'000'000);
        if (found.way.intersect) {
            ++cases;
            close += found.way.vector.norm() - found.truth <= 1e-3 ? 1 : 0;
        }
    }
    EXPECT_GT(cases, 15);
    EXPECT_GE(close, cases - 2);
}

TEST(MinkowskiTruth, CombsWhoseTeethJustFit) {
    // The way out leads into the other comb's gaps, which are wider than the teeth by very little.
    samples::Random random(702);
    for (int i = 0; i < 30; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const double room = std::pow(10.0, random.between(-5.0, -1.0));
        const Parted a = comb(3 + static_cast<int>(random.below(3)), 0.5, 1.0);
        const Parted b = comb(4, 0.5 - room, 1.0);
        const Pose pose_a{{random.between(-0.3, 0.3), random.between(-0.1, 0.1)}, std::numbers::pi};
        // A is turned over: its teeth point down, between B's.
        const Pose pose_b{{-2.0 + random.between(-0.4, 0.4), -0.9 + random.between(-0.2, 0.0)},
                          0.0};
        check(a, {{pose_a.translation.x + 1.0, pose_a.translation.y}, pose_a.angle}, b, pose_b,
              1e-4);
    }
}

TEST(MinkowskiTruth, CombsOfManyTeeth) {
    // More than 256 edges: cells are divided by the edges that cross in them.
    samples::Random random(705);
    for (int i = 0; i < 6; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const Parted a = comb(65, 0.5, 3.0);
        const Parted b = comb(2, random.between(0.2, 0.6), 4.0);
        const Pose pose_a{{33.0 + random.between(-0.4, 0.4), random.between(2.5, 3.5)},
                          std::numbers::pi};
        const Found found = check(a, pose_a, b, {}, 1e-3);
        EXPECT_GE(found.way.lower_bound, 0.95 * found.way.vector.norm());
    }
}

TEST(MinkowskiTruth, WhateverTheWork) {
    // Work that runs out in the midst of the search leaves a bound that holds.
    samples::Random random(704);
    for (int i = 0; i < 240; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const auto work = static_cast<std::uint64_t>(std::pow(10.0, random.between(3.0, 6.0)));
        const Parted a = i % 2 == 0 ? comb(3, 0.5, 1.0) : star(random, 5 + random.below(4));
        const Parted b = i % 3 == 0 ? comb(4, 0.45, 1.0) : scattered(random);
        check(a, any_pose(random, 0.7), b, any_pose(random, 0.3), 1e-4, work);
    }
}

TEST(MinkowskiTruth, FramesBarsAndScatteredParts) {
    samples::Random random(703);
    for (int i = 0; i < 30; ++i) {
        SCOPED_TRACE("case " + std::to_string(i));
        const Parted wide = frame(1.5, 1.0);
        // Into the hole, into which it fits or not by very little; or out.
        const double size =
            1.0 + (random.below(2) == 0 ? -1.0 : 1.0) * std::pow(10.0, random.between(-4.0, -1.0));
        const Parted block{{samples::rectangle(-size, -size, size, size)},
                           {rectangle(-size, -size, size, size)}};
        check(block, {{random.between(-0.3, 0.3), random.between(-0.3, 0.3)}, 0.0}, wide, {}, 1e-4);
        check(scattered(random), any_pose(random, 0.5), scattered(random), {}, 1e-3);
        check(scattered(random), any_pose(random, 0.5), wide, {}, 1e-3);
    }
}

}  // namespace
}  // namespace nearfield::mtv
