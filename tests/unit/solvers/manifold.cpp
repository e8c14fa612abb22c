#include <engine/solvers/manifold.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace nearfield::solvers {
namespace {

using geometry::Polygon;
using geometry::Vector;

constexpr double spacing = 0.1;

TransformedContact contact_at(const Vector& point, double angle,
                              const queries::BoundaryPoint& place, double distance = 0.01) {
    ContactPoint record;
    record.position = geometry::to_public(point);
    record.normal = {std::cos(angle), std::sin(angle)};
    record.distance = distance;
    record.nearest = {point.x() - distance * record.normal.x,
                      point.y() - distance * record.normal.y};
    return {record, place, place};
}

Polygon long_bar() {
    return samples::polygon(test::rectangle({0.0, 0.0}, {100.0, 1.0}));
}

/// Contacts along the lower edge of the bar, with normals upwards.
std::vector<TransformedContact> along_the_bar(double from, double to) {
    std::vector<TransformedContact> contacts;
    const int count = static_cast<int>(std::lround((to - from) / spacing));
    for (int i = 0; i <= count; ++i) {
        const double x = from + i * spacing;
        contacts.push_back(contact_at({x, 0.0}, std::numbers::pi / 2.0, {0, x / 100.0}));
    }
    return contacts;
}

std::vector<ContactCluster> clusters_of(const Polygon& a,
                                        const std::vector<TransformedContact>& of_a) {
    std::vector<ContactCluster> manifold;
    ManifoldBuilder().build(a, a, of_a, {}, spacing, manifold);
    std::uint32_t count = 0;
    for (const ContactCluster& cluster : manifold) {
        count += cluster.count;
    }
    EXPECT_EQ(count, of_a.size()) << "every contact of A is in one cluster";
    return manifold;
}

TEST(Manifold, OneStretchAlongAWallIsOneCluster) {
    const Polygon bar = long_bar();
    const std::vector<ContactCluster> manifold = clusters_of(bar, along_the_bar(3.0, 60.0));
    ASSERT_EQ(manifold.size(), 1U);
    EXPECT_EQ(manifold[0].first, (Vector2{3.0, 0.0}));
    EXPECT_NEAR(manifold[0].last.x, 60.0, 1e-9);
    EXPECT_NEAR(manifold[0].normal.y, 1.0, 1e-12);
}

TEST(Manifold, AGapWiderThanTheSpacingDividesAndNothingElse) {
    const Polygon bar = long_bar();
    std::vector<TransformedContact> contacts = along_the_bar(3.0, 7.0);
    const std::vector<TransformedContact> rest = along_the_bar(7.2, 9.0);
    contacts.insert(contacts.end(), rest.begin(), rest.end());
    const std::vector<ContactCluster> manifold = clusters_of(bar, contacts);
    ASSERT_EQ(manifold.size(), 2U);
    EXPECT_NEAR(manifold[0].last.x, 7.0, 1e-9);
    EXPECT_NEAR(manifold[1].first.x, 7.2, 1e-9);
    EXPECT_EQ(manifold[0].count, 41U);
    EXPECT_EQ(manifold[1].count, 19U);
}

/// Contacts around a circle, with normals that turn along it.
std::vector<TransformedContact> around(const Polygon& circle, std::uint32_t count) {
    std::vector<TransformedContact> contacts;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        const Vector point = circle.centre() + circle.vertices()[i];
        contacts.push_back(contact_at(point, angle, {i, 0.0}));
    }
    return contacts;
}

TEST(Manifold, RoundACircleAClusterTurnsByARightAngleAndNoMore) {
    constexpr std::uint32_t count = 360;
    Ring ring;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        ring.push_back({5.0 * std::cos(angle), 5.0 * std::sin(angle)});
    }
    const Polygon circle = samples::polygon({ring});
    const std::vector<ContactCluster> manifold = clusters_of(circle, around(circle, count));
    // Right angles but for a contact or two each.
    EXPECT_GE(manifold.size(), 4U);
    EXPECT_LE(manifold.size(), 5U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(manifold[i].count, 90.0, 2.0);
        // The mean of the normals is in the middle, as far from either end.
        const Vector2& normal = manifold[i].normal;
        const auto turn = [&](const Vector2& end) {
            return std::acos((end.x * normal.x + end.y * normal.y) / 5.0) * 180.0 /
                   std::numbers::pi;
        };
        EXPECT_NEAR(turn(manifold[i].first), 45.0, 1.5);
        EXPECT_NEAR(turn(manifold[i].last), 45.0, 1.5);
    }
}

TEST(Manifold, AStretchOverTheStartOfTheRingIsOneCluster) {
    // The lower left corner of the bar is the first vertex; its sides turn by less than 45 degrees.
    const Polygon kite = samples::polygon({{{0, 0}, {10, -3}, {20, 5}, {-10, 5}, {-10, -3}}});
    std::vector<TransformedContact> contacts;
    const double up = std::numbers::pi / 2.0;
    for (int i = 0; i < 20; ++i) {
        const double part = 0.009 * i;
        contacts.push_back(contact_at({10.0 * part, -3.0 * part}, up + 0.3, {0, part}));
    }
    for (int i = 19; i >= 1; --i) {
        const double part = 1.0 - 0.009 * i;
        contacts.push_back(
            contact_at({-10.0 * (1.0 - part), -3.0 * (1.0 - part)}, up - 0.3, {4, part}));
    }
    const std::vector<ContactCluster> manifold = clusters_of(kite, contacts);
    ASSERT_EQ(manifold.size(), 1U);
    EXPECT_EQ(manifold[0].count, 39U);
    EXPECT_NEAR(manifold[0].first.x, -10.0 * 0.009 * 19, 1e-9);
    EXPECT_NEAR(manifold[0].last.x, 10.0 * 0.009 * 19, 1e-9);
    EXPECT_NEAR(manifold[0].normal.y, 1.0, 1e-2);
}

TEST(Manifold, TheExtremeIsTheDeepestOrTheClosest) {
    const Polygon bar = long_bar();
    std::vector<TransformedContact> contacts = along_the_bar(3.0, 7.0);
    contacts[11].record.distance = 0.005;
    EXPECT_EQ(clusters_of(bar, contacts)[0].extreme.position, contacts[11].record.position);
    contacts[20].record.inside = true;
    contacts[20].record.distance = 0.001;
    contacts[30].record.inside = true;
    contacts[30].record.distance = 0.02;
    EXPECT_EQ(clusters_of(bar, contacts)[0].extreme.position, contacts[30].record.position);
}

TEST(Manifold, ContactsOfBJoinTheClusterTheyFaceOrMakeTheirOwn) {
    const Polygon a = long_bar();
    const Polygon b = samples::polygon(test::rectangle({0.0, -2.0}, {100.0, -1.0}));
    const std::vector<TransformedContact> of_a = along_the_bar(3.0, 7.0);
    const auto of_b_at = [](double x, double distance) {
        TransformedContact contact =
            contact_at({x, -distance}, std::numbers::pi / 2.0, {2, 1.0 - x / 100.0}, distance);
        contact.record.on = Side::b;
        contact.record.nearest = {x, 0.0};
        contact.on_a = {0, x / 100.0};
        return contact;
    };
    const std::vector<TransformedContact> of_b{of_b_at(50.0, 0.03), of_b_at(5.02, 0.002)};
    std::vector<ContactCluster> manifold;
    ManifoldBuilder().build(a, b, of_a, of_b, spacing, manifold);
    ASSERT_EQ(manifold.size(), 2U);
    EXPECT_EQ(manifold[0].count, of_a.size());
    EXPECT_EQ(manifold[0].extreme.on, Side::b);
    EXPECT_EQ(manifold[0].extreme.distance, 0.002);
    EXPECT_EQ(manifold[1].count, 1U);
    EXPECT_EQ(manifold[1].extreme.distance, 0.03);
    // Points of A's boundary, whoever's the contacts are.
    EXPECT_EQ(manifold[1].first, (Vector2{50.0, 0.0}));
}

}  // namespace
}  // namespace nearfield::solvers
