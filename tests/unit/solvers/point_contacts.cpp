#include <engine/geometry/segment.hpp>
#include <engine/queries/error_budget.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/solvers/contacts.hpp>

#include <gtest/gtest.h>
#include <shaders/layout.h>
#include <tests/unit/solvers/test_workspace.hpp>
#include <tests/unit/support/boundary_samples.hpp>
#include <tests/unit/support/shape_samples.hpp>

#include <cmath>

namespace nearfield {
namespace {

using geometry::Polygon;
using geometry::Vector;

/// The contacts of one boundary by brute force over samples and edges.
std::vector<ContactPoint> contacts_of(const simd::TransformedEdges& a,
                                      const simd::TransformedEdges& b, const ContactQuery& query,
                                      double cell, Side side) {
    std::vector<ContactPoint> contacts;
    for (const queries::BoundaryPoint& sample : samples::of_boundary(a, cell)) {
        const Vector point = queries::position(a.placed, sample);
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t i = 0; i < b.count; ++i) {
            least = std::min(
                least, geometry::nearest_on_segment(point, b.start(i), b.end(i)).squared_distance);
        }
        ContactPoint contact;
        contact.position = geometry::to_public(point);
        contact.distance = std::sqrt(least);
        contact.on = side;
        contact.inside = contact.distance > a.rounding + b.rounding && contains(b, point);
        if (contact.distance <= query.contact_distance) {
            contacts.push_back(contact);
        }
    }
    return contacts;
}

TEST(PointContacts, AreAllSamplesOfBothBoundariesThatAreNear) {
    samples::Random random(211);
    const std::vector<samples::NamedRings> shapes = samples::assorted_shapes(random);
    solvers::ContactSolver contacts;
    solvers::TestWorkspace workspace;
    simd::TransformedInstances& instances = workspace.instances;
    std::size_t count = 0;
    std::size_t inside = 0;
    for (const samples::NamedRings& one : shapes) {
        for (const samples::NamedRings& other : shapes) {
            const Polygon a = samples::polygon(one.rings);
            const Polygon b = samples::polygon(other.rings);
            for (const double contact_distance : {1e-12, 0.03, 2.0}) {
                SCOPED_TRACE(one.name + ", " + other.name + ", " +
                             std::to_string(contact_distance));
                ContactQuery query;
                query.a.pose = {{random.between(-1.5, 1.5), random.between(-1.5, 1.5)}, 0.4};
                query.b.pose = random.below(4) == 0 ? query.a.pose : Pose{};
                query.tolerance = 0.02;
                query.contact_distance = contact_distance;
                const AnyQuery asked = query;
                queries::CheckedQuery checked;
                checked.query = &asked;
                checked.a = &a;
                checked.b = &b;
                checked.pose_a = query.a.pose;
                checked.pose_b = query.b.pose;
                checked.budget = queries::contact_budget(query.tolerance, {});
                ContactResult result;
                result.tolerance = query.tolerance;
                result.cell = checked.budget.cell;
                instances.clear();
                contacts.answer(checked, workspace, result);
                ASSERT_TRUE(result.status.ok()) << result.status.text();

                const queries::PlacedPair pair = queries::place_pair(checked, instances);
                complete(pair, instances);
                const simd::TransformedEdges& transformed_a = instances[pair.a];
                const simd::TransformedEdges& transformed_b = instances[pair.b];
                std::vector<ContactPoint> all =
                    contacts_of(transformed_a, transformed_b, query, result.cell, Side::a);
                const std::vector<ContactPoint> of_b =
                    contacts_of(transformed_b, transformed_a, query, result.cell, Side::b);
                all.insert(all.end(), of_b.begin(), of_b.end());
                EXPECT_EQ(result.count, all.size());
                ASSERT_EQ(result.points.size(), all.size());
                for (std::size_t i = 0; i < all.size(); ++i) {
                    const ContactPoint& record = result.points[i];
                    EXPECT_EQ(record.position, all[i].position);
                    EXPECT_NEAR(record.distance, all[i].distance, 1e-14);
                    EXPECT_EQ(record.on, all[i].on);
                    const bool touches =
                        all[i].distance <= shaders::touching_depth * query.tolerance;
                    EXPECT_EQ(record.inside, all[i].inside && !touches) << record.distance;
                    inside += record.inside ? 1 : 0;
                }
                count += all.size();
            }
        }
    }
    EXPECT_GT(count, 50000U);
    EXPECT_GT(inside, 5000U);
}

}  // namespace
}  // namespace nearfield
