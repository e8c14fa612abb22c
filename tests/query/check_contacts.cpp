#include <tests/oracle/boundary.hpp>
#include <tests/oracle/plane.hpp>
#include <tests/query/check.hpp>
#include <tests/query/check_nearest.hpp>
#include <tests/query/point_index.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::test {
namespace {

using oracle::ShapeOracle;

double signed_distance(const ContactPoint& contact) {
    return contact.inside ? -contact.distance : contact.distance;
}

/// The point of B's boundary whose normal a contact reports.
Vector2 place_on_b(const ContactPoint& contact) {
    return contact.on == Side::a ? contact.nearest : contact.position;
}

/// The signed distance to B must grow along the normal. Skipped if another part of B's boundary, or
/// a corner beside the normal, is within reach of the steps.
void check_normal(Report& report, const PlacedPair& pair, const ContactPoint& contact) {
    report.require(std::abs(oracle::length(contact.normal) - 1.0) < 1e-9, "a normal's length is ",
                   oracle::length(contact.normal));
    const double step = std::max(1e-4 * pair.tolerance(), 1e4 * pair.rounding());
    const Vector2 from = place_on_b(contact);
    if (pair.b().edges_within(from, 3.0 * step).size() > 1) {
        return;
    }
    const Vector2 ahead = oracle::plus(from, oracle::times(contact.normal, step));
    const Vector2 behind = oracle::minus(from, oracle::times(contact.normal, step));
    const double growth = pair.b().signed_distance(ahead) - pair.b().signed_distance(behind);
    report.require(growth > 1.99 * step, "the normal ", contact.normal.x, ", ", contact.normal.y,
                   " at ", from.x, ", ", from.y, " does not lead out of B: ", growth / step);
}

void check_record(Report& report, const PlacedPair& pair, double contact_distance,
                  const ContactPoint& contact) {
    const bool on_a = contact.on == Side::a;
    const ShapeOracle& own = on_a ? pair.a() : pair.b();
    const ShapeOracle& other = on_a ? pair.b() : pair.a();
    const double allowed = allowed_rounding(pair);
    check_nearest(
        report, {own, other, pair.tolerance(), allowed},
        {contact.position, contact.distance, contact.nearest, contact.feature, contact.unique});
    report.require(contact.distance <= contact_distance, "a contact is ", contact.distance,
                   " away");
    const double outside = other.signed_distance(contact.position);
    report.require(contact.inside ? outside <= allowed : outside >= -1e-3 * pair.tolerance(),
                   "a contact at signed distance ", outside, " is said to be ",
                   contact.inside ? "inside" : "outside");
    check_normal(report, pair, contact);
}

/// Every boundary point clearly within the contact distance must have a record of its own boundary
/// nearby.
void check_complete(Report& report, const PlacedPair& pair, double contact_distance,
                    const ContactResult& result) {
    constexpr std::size_t max_samples = 2000;
    for (const Side side : {Side::a, Side::b}) {
        const ShapeOracle& own = side == Side::a ? pair.a() : pair.b();
        const ShapeOracle& other = side == Side::a ? pair.b() : pair.a();
        PointIndex records(result.error_bound + allowed_rounding(pair));
        for (const ContactPoint& contact : result.points) {
            if (contact.on == side) {
                records.add(contact.position);
            }
        }
        for (const Vector2& p : oracle::sample_boundary(own, pair.tolerance() / 2, max_samples)) {
            const double distance = other.nearest(p).distance;
            report.require(distance > contact_distance - result.error_bound || records.has_near(p),
                           "no contact within the bound of ", p.x, ", ", p.y, ", which is ",
                           distance, " away from the other boundary");
        }
    }
}

void check_manifold(Report& report, const PlacedPair& pair, double contact_distance,
                    const ContactResult& result) {
    const double allowed = allowed_rounding(pair);
    std::size_t of_a = 0;
    for (const ContactPoint& contact : result.points) {
        of_a += contact.on == Side::a ? 1U : 0U;
    }
    std::size_t in_clusters = 0;
    double max_extreme = contact_distance;
    for (const ContactCluster& cluster : result.manifold) {
        in_clusters += cluster.count;
        max_extreme = std::min(max_extreme, signed_distance(cluster.extreme));
        for (const Vector2& end : {cluster.first, cluster.last}) {
            report.require(pair.a().nearest(end).distance <= allowed, "an end is off A");
            report.require(pair.b().nearest(end).distance <= contact_distance + allowed,
                           "an end is no contact");
        }
        report.require(std::abs(oracle::length(cluster.normal) - 1.0) < 1e-9,
                       "a mean normal's length is ", oracle::length(cluster.normal));
        report.require(std::any_of(result.points.begin(), result.points.end(),
                                   [&](const ContactPoint& contact) {
                                       return contact.position == cluster.extreme.position &&
                                              contact.distance == cluster.extreme.distance;
                                   }),
                       "the extreme of a stretch is none of the records");
    }
    report.require(in_clusters >= of_a && in_clusters <= result.points.size(), in_clusters,
                   " contacts in stretches, ", of_a, " of A, ", result.points.size(), " in all");
    double truth = contact_distance;
    for (const ContactPoint& contact : result.points) {
        truth = std::min(truth, signed_distance(contact));
    }
    report.require(max_extreme == truth, "the most extreme contact is ", truth,
                   ", that of the manifold ", max_extreme);
}

}  // namespace

void check_contacts(const PlacedPair& pair, double contact_distance, const ContactResult& result) {
    Report report("contacts");
    check_summary(report, result, pair);
    if (!result.status.ok()) {
        return;
    }
    report.require(result.count == result.points.size(), "count ", result.count, ", ",
                   result.points.size(), " records");
    for (const ContactPoint& contact : result.points) {
        check_record(report, pair, contact_distance, contact);
    }
    report.require(
        std::is_sorted(result.points.begin(), result.points.end(),
                       [](const ContactPoint& i, const ContactPoint& j) { return i.on < j.on; }),
        "contacts of B before contacts of A");
    check_complete(report, pair, contact_distance, result);
    check_manifold(report, pair, contact_distance, result);
}

}  // namespace nearfield::test
