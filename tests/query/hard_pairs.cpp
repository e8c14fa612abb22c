#include <tests/query/degenerate_shapes.hpp>
#include <tests/query/hard_pairs.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nearfield::test {
namespace {

double any_angle(Random& random) {
    return random.between(-4.0, 4.0);
}

Pose any_pose(Random& random) {
    const bool turned = random.whole(0, 2) > 0;
    return {{random.between(-3.0, 3.0), random.between(-3.0, 3.0)},
            turned ? any_angle(random) : 0.0};
}

/// Both at one pose, so that what they have in common stays common.
Pair at_one_pose(Random& random, Rings a, Rings b) {
    const Pose pose = any_pose(random);
    const double tolerance = random.scale(0.01, 0.1);
    return {{"A", std::move(a)}, {"B", std::move(b)}, pose, pose, tolerance};
}

/// A side on a side, a corner on a side, or a corner on a corner.
Pair touching(Random& random) {
    const double x = random.whole(1, 20) / 3.0;
    const double y = random.whole(-2, 7) / 7.0;
    const Rings left = rectangle({0.0, 0.0}, {x, 1.0});
    switch (random.whole(0, 3)) {
        case 0:
            return at_one_pose(random, left, rectangle({x, y}, {x + 1.0, y + 0.7}));
        case 1:
            return at_one_pose(random, left, rectangle({x, 1.0}, {x + 1.0, 2.0}));
        case 2:
            return at_one_pose(random, left, {{{x, y}, {x + 1.0, y - 0.3}, {x + 1.0, y + 0.4}}});
        default:  // from inside
            return at_one_pose(random, left, rectangle({x / 2.0, 0.25}, {x, 0.75}));
    }
}

Rings moved_a_little(Random& random, Rings rings, double most) {
    for (Ring& ring : rings) {
        for (Vector2& vertex : ring) {
            vertex = {vertex.x + random.between(-most, most),
                      vertex.y + random.between(-most, most)};
        }
    }
    return rings;
}

/// The same outline twice, or almost, or with other vertices along it.
Pair copies(Random& random) {
    const Rings rings =
        random.whole(0, 2) == 0 ? any_shape(random).rings : star(random, random.whole(3, 40), 0.4);
    switch (random.whole(0, 4)) {
        case 0:
            return at_one_pose(random, rings, rings);
        case 1:
            return at_one_pose(random, rings, with_repeated_vertices(random, rings, 0.5));
        case 2:
            return at_one_pose(random, rings, with_collinear_runs(random, rings, 0.5));
        case 3: {
            Rings reversed = rings;
            for (Ring& ring : reversed) {
                std::reverse(ring.begin(), ring.end());
            }
            return at_one_pose(random, rings, reversed);
        }
        default:
            return at_one_pose(random, rings,
                               moved_a_little(random, rings, random.scale(1e-15, 1e-3)));
    }
}

/// B has some vertices of A, in a row or not, and some of its own.
Pair with_shared_vertices(Random& random) {
    const Rings a = star(random, random.whole(5, 40), 0.4);
    const int every = random.whole(1, 3);
    Ring b;
    for (std::size_t i = 0; i < a.front().size(); ++i) {
        const Vector2& vertex = a.front()[i];
        const double factor = random.between(0.5, 1.5);
        const bool shared = static_cast<int>(i) % (every + 1) < every;
        b.push_back(shared ? vertex : Vector2{vertex.x * factor, vertex.y * factor});
    }
    return at_one_pose(random, a, {b});
}

/// Rings around each other, and a shape between two of them, on one of them, or across some.
Pair nested(Random& random) {
    Rings rings;
    const int count = random.whole(2, 24);
    const int corners = random.whole(3, 9);
    for (int i = 0; i < count; ++i) {
        rings.push_back(scaled_and_moved(regular(corners), 1.0 - 0.9 * i / count, {}).front());
    }
    const int ring = random.whole(0, count - 1);
    const double radius = 1.0 - 0.9 * (ring + random.whole(0, 2) / 2.0) / count;
    if (random.whole(0, 1) == 0) {  // a ring in the same place
        return at_one_pose(random, rings, scaled_and_moved(regular(corners), radius, {}));
    }
    const Vector2 place{radius * random.between(0.7, 1.0), 0.0};
    const double size = 0.9 / count * random.scale(0.1, 2.0);
    return at_one_pose(random, rings,
                       scaled_and_moved(star(random, random.whole(3, 12), 0.5), size, place));
}

/// A small shape in or about a hole; some holes are tiny.
Pair at_a_hole(Random& random) {
    const Rings holes = with_holes(random, random.whole(3, 9));
    const auto last = static_cast<int>(holes.size()) - 1;
    const Ring& hole = holes[static_cast<std::size_t>(random.whole(1, last))];
    if (random.whole(0, 3) == 0) {  // which it fills
        return at_one_pose(random, holes, {hole});
    }
    const double size = std::hypot(hole[1].x - hole[0].x, hole[1].y - hole[0].y);
    return at_one_pose(random, holes,
                       scaled_and_moved(star(random, random.whole(3, 9), 0.5),
                                        size * random.scale(0.1, 3.0), hole.front()));
}

Pair slivers(Random& random) {
    const auto sliver = [&random] {
        return random.whole(0, 1) == 0 ? needle(random.scale(1e-12, 0.05))
                                       : spiky(random, random.whole(2, 15));
    };
    const Rings b = random.whole(0, 1) == 0 ? sliver() : star(random, random.whole(3, 60), 0.3);
    Pair pair = at_one_pose(random, sliver(), b);
    if (random.whole(0, 3) > 0) {
        pair.pose_a = any_pose(random);
        pair.pose_b = pose_at({}, pair.pose_a.translation, any_angle(random));
    }
    return pair;
}

/// Sizes apart by up to four orders of magnitude, the small one at a vertex of the large one or
/// near it. The tolerance is that of either size, but no more than a thousandth of the large one is
/// sampled then.
Pair of_different_sizes(Random& random) {
    const NamedRings large = any_shape(random);
    const double size = random.scale(1e-4, 0.1);
    const Vector2 corner = large.rings.front().front();
    const double off = random.whole(0, 2) == 0 ? 0.0 : size * random.scale(0.01, 3.0);
    const Rings small =
        scaled_and_moved(star(random, random.whole(3, 30), 0.5), size, {corner.x + off, corner.y});
    Pair pair = random.whole(0, 1) == 0 ? at_one_pose(random, small, large.rings)
                                        : at_one_pose(random, large.rings, small);
    pair.tolerance = random.whole(0, 1) == 0 ? size * random.scale(0.02, 0.2) : 0.05;
    return pair;
}

Pair far_from_the_origin(Random& random) {
    Pair pair = any_pair(random);
    const Vector2 far{random.between(-1e6, 1e6), random.between(-1e6, 1e6)};
    for (Pose* pose : {&pair.pose_a, &pair.pose_b}) {
        pose->translation = {pose->translation.x + far.x, pose->translation.y + far.y};
    }
    return pair;
}

Pair apart(Random& random) {
    Pair pair = any_pair(random);
    pair.pose_b.translation.x += random.scale(0.1, 1000.0) * 10.0 * pair.tolerance;
    return pair;
}

Rectangle box_of_pair(const Pair& pair) {
    const Rectangle a = oracle::ShapeOracle(pair.a.rings, pair.pose_a).box();
    const Rectangle b = oracle::ShapeOracle(pair.b.rings, pair.pose_b).box();
    return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y)},
            {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y)}};
}

/// Pairs at one pose stay at one.
Pair scaled(Pair pair, double factor) {
    pair.a.rings = scaled_and_moved(pair.a.rings, factor, {});
    pair.b.rings = scaled_and_moved(pair.b.rings, factor, {});
    for (Pose* pose : {&pair.pose_a, &pair.pose_b}) {
        pose->translation = {pose->translation.x * factor, pose->translation.y * factor};
    }
    pair.tolerance *= factor;
    return pair;
}

}  // namespace

Pair any_hard_pair(Random& random) {
    using Make = Pair (*)(Random&);
    constexpr std::pair<const char*, Make> kinds[] = {
        {"any", any_pair},
        {"any", any_pair},
        {"touching", touching},
        {"copies", copies},
        {"shared vertices", with_shared_vertices},
        {"nested", nested},
        {"at a hole", at_a_hole},
        {"slivers", slivers},
        {"different sizes", of_different_sizes},
        {"far away", far_from_the_origin},
        {"apart", apart},
    };
    const auto& [name, make] =
        kinds[static_cast<std::size_t>(random.whole(0, static_cast<int>(std::size(kinds)) - 1))];
    Pair pair = make(random);
    pair.a.name = std::string(name) + ", " + pair.a.name;
    return pair;
}

std::vector<Pair> degenerate_pairs(Context& context, Random& random, int count) {
    constexpr std::uint32_t cells = 40;
    const std::vector<NamedRings> shapes =
        degenerate_shapes(context, cells, static_cast<std::uint64_t>(random.whole(0, 1 << 30)));
    const auto any = [&] {
        return shapes[static_cast<std::size_t>(
            random.whole(0, static_cast<int>(shapes.size()) - 1))];
    };
    std::vector<Pair> pairs;
    for (int i = 0; i < count; ++i) {
        const Pose pose = random.whole(0, 1) == 0 ? Pose{} : any_pose(random);
        pairs.push_back({any(), any(), {}, pose, random.scale(0.5, 3.0)});
    }
    return pairs;
}

namespace {

/// The pairs in other units, in which all have this tolerance, one beside the other in a row along
/// x that begins at `origin`. What the shapes of a pair have in common stays so, bit for bit, where
/// their poses are equal.
std::vector<Pair> in_a_row(std::vector<Pair> pairs, double tolerance, const Vector2& origin) {
    double x = origin.x;
    for (Pair& pair : pairs) {
        pair = scaled(std::move(pair), tolerance / pair.tolerance);
        pair.tolerance = tolerance;
        const Rectangle box = box_of_pair(pair);
        const Vector2 by{x - box.min.x, origin.y - box.min.y};
        for (Pose* pose : {&pair.pose_a, &pair.pose_b}) {
            pose->translation = {pose->translation.x + by.x, pose->translation.y + by.y};
        }
        x += box.max.x - box.min.x + 100.0 * tolerance;
    }
    return pairs;
}

}  // namespace

HardPairs::HardPairs(Context& context, Random& random, int count)
    : tolerance(random.scale(1e-3, 1e3)),
      contact_distance(tolerance * random.scale(0.3, 8.0)),
      reach(tolerance * random.scale(0.3, 30.0)) {
    std::vector<Pair> made = degenerate_pairs(context, random, count / 8);
    while (static_cast<int>(made.size()) < count) {
        made.push_back(any_hard_pair(random));
    }
    const double far = random.whole(0, 3) == 0 ? 1e6 * tolerance : 0.0;
    const Vector2 origin{random.between(-far, far), random.between(-far, far)};
    for (Pair& pair : in_a_row(std::move(made), tolerance, origin)) {
        pairs.push_back(std::make_unique<PlacedPair>(context, std::move(pair), Technique::compute));
        const Rectangle box = pairs.back()->b().box();
        const double side = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
        field_tolerances.push_back(std::max(tolerance, side * random.scale(0.02, 0.1)));
    }
}

}  // namespace nearfield::test
