#include <box2d/box2d.h>
#include <tools/peers/convex_pieces.hpp>
#include <tools/peers/world_contest.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace nearfield::peers {
namespace {

double mean_edge_length(const std::vector<WorldShape>& shapes) {
    double sum = 0.0;
    double count = 0.0;
    for (const WorldShape& shape : shapes) {
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
class Box2dWorld final : public WorldPeer {
public:
    [[nodiscard]] std::string name() const override { return "Box2D"; }
    [[nodiscard]] std::string how(const WorldProblem& problem) const override;
    /// Box2D computes in float: a few units of the last place of coordinates up to 64, in the units
    /// of the problem.
    [[nodiscard]] double rounding() const override { return 5e-5; }
    void build(const WorldProblem& problem) override;
    void answer(const WorldProblem& problem, std::vector<double>& answers) override;

private:
    /// In Box2D's units: its boxes have a margin of 0.1, so edges should be about 1 long.
    [[nodiscard]] b2Vec2 scaled(const Vector2& point) const {
        return {static_cast<float>(scale_ * point.x), static_cast<float>(scale_ * point.y)};
    }
    [[nodiscard]] b2PolygonShape polygon_of(const Ring& ring) const;
    [[nodiscard]] bool is_hit(const Pose& pose) const;

    double scale_ = 1.0;
    b2World world_{{0.0F, 0.0F}};
    std::vector<b2PolygonShape> item_;
};

std::string Box2dWorld::how(const WorldProblem& problem) const {
    if (!problem.segments.empty()) {
        return "b2World::RayCast at edges, in float";
    }
    const auto has_no_holes = [](const WorldShape& shape) { return shape.rings.size() == 1; };
    if (!problem.poses.empty() && !problem.asks_distances && problem.item.size() == 1 &&
        std::all_of(problem.shapes.begin(), problem.shapes.end(), has_no_holes)) {
        return "b2World::QueryAABB, b2TestOverlap of convex pieces without skin, in float";
    }
    return {};
}

/// A convex polygon without Box2D's skin, within which it takes shapes as touching.
b2PolygonShape Box2dWorld::polygon_of(const Ring& ring) const {
    std::vector<b2Vec2> vertices;
    for (const Vector2& vertex : ring) {
        vertices.push_back(scaled(vertex));
    }
    b2PolygonShape polygon;
    polygon.Set(vertices.data(), static_cast<int32>(vertices.size()));
    polygon.m_radius = 0.0F;
    return polygon;
}

void Box2dWorld::build(const WorldProblem& problem) {
    scale_ = 1.0 / mean_edge_length(problem.shapes);
    for (const WorldShape& shape : problem.shapes) {
        b2BodyDef definition;
        definition.position = scaled(shape.pose.translation);
        definition.angle = static_cast<float>(shape.pose.angle);
        b2Body& body = *world_.CreateBody(&definition);
        for (const Ring& ring : shape.rings) {
            if (problem.segments.empty()) {
                for (const Ring& piece : convex_pieces(ring, b2_maxPolygonVertices)) {
                    const b2PolygonShape polygon = polygon_of(piece);
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
    for (const Ring& ring : problem.item) {
        for (const Ring& piece : convex_pieces(ring, b2_maxPolygonVertices)) {
            item_.push_back(polygon_of(piece));
        }
    }
}

bool Box2dWorld::is_hit(const Pose& pose) const {
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

void Box2dWorld::answer(const WorldProblem& problem, std::vector<double>& answers) {
    answers.clear();
    for (const Pose& pose : problem.poses) {
        answers.push_back(is_hit(pose) ? 1.0 : 0.0);
    }
    for (const Segment& segment : problem.segments) {
        FirstHit hit;
        world_.RayCast(&hit, scaled(segment.from), scaled(segment.to));
        answers.push_back(hit.first);
    }
}

}  // namespace

std::unique_ptr<WorldPeer> make_box2d_world() {
    return std::make_unique<Box2dWorld>();
}

}  // namespace nearfield::peers
