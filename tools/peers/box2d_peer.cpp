#include <box2d/box2d.h>
#include <tools/peers/peer.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace nearfield::peers {
namespace {

/// Twice the area of a triangle: above 0 if it is counter-clockwise.
double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool holds(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& point) {
    return turn(a, b, point) >= 0.0 && turn(b, c, point) >= 0.0 && turn(c, a, point) >= 0.0;
}

/// True if the triangle at a vertex of a counter-clockwise ring lies in its interior.
bool is_ear(const Ring& ring, std::size_t at) {
    const std::size_t n = ring.size();
    const Vector2& before = ring[(at + n - 1) % n];
    const Vector2& tip = ring[at];
    const Vector2& after = ring[(at + 1) % n];
    return turn(before, tip, after) > 0.0 &&
           std::none_of(ring.begin(), ring.end(), [&](const Vector2& other) {
               return other != before && other != tip && other != after &&
                      holds(before, tip, after, other);
           });
}

/// All counter-clockwise.
std::vector<Ring> triangles_of(Ring rest) {
    double area = 0.0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        area += turn({}, rest[i], rest[(i + 1) % rest.size()]);
    }
    if (area < 0.0) {
        std::reverse(rest.begin(), rest.end());
    }
    std::vector<Ring> triangles;
    while (rest.size() > 3) {
        const std::size_t n = rest.size();
        std::size_t ear = 0;
        while (ear < n && !is_ear(rest, ear)) {
            ++ear;
        }
        if (ear == n) {
            throw std::runtime_error("a ring that crosses itself has no triangles");
        }
        triangles.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back(std::move(rest));
    return triangles;
}

bool is_convex(const Ring& ring) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (turn(ring[i], ring[(i + 1) % n], ring[(i + 2) % n]) < 0.0) {
            return false;
        }
    }
    return true;
}

/// Two counter-clockwise rings without the edge that they share; nothing if they share none.
std::optional<Ring> joined(const Ring& a, const Ring& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const auto other = std::find(b.begin(), b.end(), a[(i + 1) % a.size()]);
        const auto at = static_cast<std::size_t>(other - b.begin());
        if (other == b.end() || b[(at + 1) % b.size()] != a[i]) {
            continue;
        }
        Ring ring;
        for (std::size_t k = 0; k < a.size(); ++k) {
            ring.push_back(a[(i + 1 + k) % a.size()]);
        }
        for (std::size_t k = 2; k < b.size(); ++k) {
            ring.push_back(b[(at + k) % b.size()]);
        }
        return ring;
    }
    return std::nullopt;
}

/// Joins a piece with one of the later ones, which disappears; false if none fits.
bool join_one(std::vector<Ring>& pieces, std::size_t first) {
    for (std::size_t second = first + 1; second < pieces.size(); ++second) {
        std::optional<Ring> piece = joined(pieces[first], pieces[second]);
        if (piece && piece->size() <= b2_maxPolygonVertices && is_convex(*piece)) {
            pieces[first] = *std::move(piece);
            pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(second));
            return true;
        }
    }
    return false;
}

/// Convex polygons of as many vertices as Box2D takes, which together fill a ring: its triangles,
/// joined as far as they remain convex; all counter-clockwise. Throws std::runtime_error if the
/// ring crosses itself.
std::vector<Ring> convex_pieces(const Ring& ring) {
    std::vector<Ring> pieces = triangles_of(ring);
    for (std::size_t first = 0; first < pieces.size(); ++first) {
        while (join_one(pieces, first)) {
        }
    }
    return pieces;
}

double mean_edge_length(std::span<const PlacedShape> shapes) {
    double sum = 0.0;
    double count = 0.0;
    for (const PlacedShape& shape : shapes) {
        for (const Ring& ring : shape.rings) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vector2& next = ring[(i + 1) % ring.size()];
                sum += std::hypot(next.x - ring[i].x, next.y - ring[i].y);
            }
            count += static_cast<double>(ring.size());
        }
    }
    return sum / count;
}

/// Whether a convex piece of the item meets a fixture.
class HitTest final : public b2QueryCallback {
public:
    bool ReportFixture(b2Fixture* fixture) override {
        is_hit = b2TestOverlap(fixture->GetShape(), 0, piece, 0, fixture->GetBody()->GetTransform(),
                               pose);
        return !is_hit;
    }

    const b2PolygonShape* piece = nullptr;
    b2Transform pose;
    bool is_hit = false;
};

/// The first fixture along a segment.
class FirstHit final : public b2RayCastCallback {
public:
    float ReportFixture(b2Fixture* /*fixture*/, const b2Vec2& /*point*/, const b2Vec2& /*normal*/,
                        float fraction) override {
        first = static_cast<double>(fraction);
        return fraction;
    }

    double first = 2.0;
};

/// Box2D: a b2World of static bodies. Poses are tested by convex pieces, rays against edges. It has
/// no query for the distance to a world, or for the nearest body.
class Box2d final : public Peer {
public:
    Box2d()
        : Peer("Box2D",
               {{Task::pose_hits,
                 "b2World::QueryAABB, b2TestOverlap of convex pieces without skin, in float"},
                {Task::first_hits, "b2World::RayCast at edges, in float"}}) {}
    /// Box2D computes in float: a few units of the last place of coordinates up to 64, in the units
    /// of the problem.
    [[nodiscard]] double rounding() const override { return 5e-5; }
    void build(const Problem& problem, std::span<const PlacedShape> shapes) override;
    void ask_world(const Problem& problem, std::vector<double>& numbers) override;

private:
    /// In Box2D's units: its boxes have a margin of 0.1, so edges should be about 1 long.
    [[nodiscard]] b2Vec2 scaled(const Vector2& point) const {
        return {static_cast<float>(scale_ * point.x), static_cast<float>(scale_ * point.y)};
    }
    [[nodiscard]] std::vector<b2PolygonShape> polygons_of(const Ring& ring) const;
    [[nodiscard]] bool is_hit(const Pose& pose) const;

    double scale_ = 1.0;
    b2World world_{{0.0F, 0.0F}};
    std::vector<b2PolygonShape> item_;
};

/// Convex polygons without Box2D's skin, within which it takes shapes as touching.
std::vector<b2PolygonShape> Box2d::polygons_of(const Ring& ring) const {
    std::vector<b2PolygonShape> polygons;
    for (const Ring& piece : convex_pieces(ring)) {
        std::vector<b2Vec2> vertices;
        for (const Vector2& vertex : piece) {
            vertices.push_back(scaled(vertex));
        }
        b2PolygonShape& polygon = polygons.emplace_back();
        polygon.Set(vertices.data(), static_cast<int32>(vertices.size()));
        polygon.m_radius = 0.0F;
    }
    return polygons;
}

void Box2d::build(const Problem& problem, std::span<const PlacedShape> shapes) {
    scale_ = 1.0 / mean_edge_length(shapes);
    for (const PlacedShape& shape : shapes) {
        const b2BodyDef definition;
        b2Body& body = *world_.CreateBody(&definition);
        for (const Ring& ring : shape.rings) {
            if (problem.task == Task::pose_hits) {
                for (const b2PolygonShape& polygon : polygons_of(ring)) {
                    body.CreateFixture(&polygon, 0.0F);
                }
                continue;
            }
            for (std::size_t i = 0; i < ring.size(); ++i) {
                b2EdgeShape edge;
                edge.SetTwoSided(scaled(ring[i]), scaled(ring[(i + 1) % ring.size()]));
                body.CreateFixture(&edge, 0.0F);
            }
        }
    }
    for (const Ring& ring : problem.item()) {
        item_ = polygons_of(ring);
    }
}

bool Box2d::is_hit(const Pose& pose) const {
    HitTest test;
    test.pose.Set(scaled(pose.translation), static_cast<float>(pose.angle));
    for (const b2PolygonShape& piece : item_) {
        b2AABB box;
        piece.ComputeAABB(&box, test.pose, 0);
        test.piece = &piece;
        world_.QueryAABB(&test, box);
        if (test.is_hit) {
            return true;
        }
    }
    return false;
}

void Box2d::ask_world(const Problem& problem, std::vector<double>& numbers) {
    for (const Pose& pose : problem.request().poses) {
        numbers.push_back(is_hit(pose) ? 1.0 : 0.0);
    }
    for (const Segment& segment : problem.request().segments) {
        FirstHit hit;
        world_.RayCast(&hit, scaled(segment.from), scaled(segment.to));
        numbers.push_back(hit.first);
    }
}

}  // namespace

std::unique_ptr<Peer> make_box2d_peer() {
    return std::make_unique<Box2d>();
}

}  // namespace nearfield::peers
