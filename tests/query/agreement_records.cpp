#include "agreement.hpp"

#include <tests/query/all_numbers.hpp>
#include <tests/query/match.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nearfield::test {
namespace {

NamedFeature named(const PenetratingPoint& record) {
    return {record.feature, record.nearest, record.depth, record.unique};
}

NamedFeature named(const ContactPoint& record) {
    return {record.feature, record.nearest, record.distance, record.unique};
}

/// Checks the features of both results against those allowed.
class NamedPairs {
public:
    NamedPairs(Report& report, const Naming& naming) : report_(&report), naming_(naming) {}

    void add(const Vector2& point, const NamedFeature& one, const NamedFeature& other) {
        ++count_;
        otherwise_ += std::abs(one.distance - other.distance) <= naming_.rounding &&
                              one.unique == other.unique
                          ? 0U
                          : 1U;
        report_->require(naming_.allows(point, one, other), "at ", point.x, ", ", point.y,
                         " feature ", one.feature.index, " is ", one.distance,
                         one.unique ? "" : " (not unique)", " away and ", other.feature.index, " ",
                         other.distance, other.unique ? "" : " (not unique)");
    }
    void require_most_equal() const {
        report_->require(otherwise_ <= 1 + count_ / 20, otherwise_, " of ", count_,
                         " records do not say the same");
    }

private:
    Report* report_;
    Naming naming_;
    std::size_t count_ = 0;
    std::size_t otherwise_ = 0;
};

std::vector<ContactPoint> of_side(const ContactResult& result, Side side) {
    std::vector<ContactPoint> records;
    std::copy_if(result.points.begin(), result.points.end(), std::back_inserter(records),
                 [side](const ContactPoint& record) { return record.on == side; });
    return records;
}

/// If all contacts are equal, the manifolds must be equal.
void check_manifolds(Report& report, ContactResult one, ContactResult other) {
    const auto numbers = [](const ContactResult& result) {
        Results results;
        results.results.emplace_back(result);
        return all_numbers(results);
    };
    const auto first = numbers(one);
    const auto second = numbers(other);
    one.manifold.clear();
    other.manifold.clear();
    report.require(numbers(one) != numbers(other) || first == second,
                   "manifolds of the same contacts differ");
}

}  // namespace

void check_agreement(Report& report, const Asked& asked, const PenetrationResult& one,
                     const PenetrationResult& other) {
    const double touching = asked.pair.tolerance() / 1000;
    NamedPairs pairs(report, {asked.pair.b(), touching, asked.pair.rounding()});
    match(
        one.points, other.points,
        [&](const PenetratingPoint& i, const PenetratingPoint& j) {
            pairs.add(i.position, named(i), named(j));
            report.require(!same_feature(i.feature, j.feature) || i.direction == j.direction,
                           "directions differ at ", i.position.x, ", ", i.position.y);
        },
        [&](const PenetratingPoint& alone) {
            report.require(alone.depth <= touching, "only one has a record at ", alone.position.x,
                           ", ", alone.position.y, ", depth ", alone.depth);
        });
    if (asked.mostly_equal) {
        pairs.require_most_equal();
    }
    const auto deepest = [](const PenetrationResult& result) {
        return result.count > 0 ? result.deepest.depth : 0.0;
    };
    report.require(std::abs(deepest(one) - deepest(other)) <= touching, "the deepest are ",
                   deepest(one), " and ", deepest(other));
}

/// Gradient normals follow fields that may differ by their bounds, and a contact without a gradient
/// is not unique. For such contacts neither is compared.
void check_agreement(Report& report, const Asked& asked, const ContactResult& one,
                     const ContactResult& other) {
    const auto& query = std::get<ContactQuery>(asked.query);
    const bool analytic = query.normals == ContactNormals::analytic;
    const double margin = asked.pair.tolerance() / 1000;
    for (const Side side : {Side::a, Side::b}) {
        const oracle::ShapeOracle& other_shape = side == Side::a ? asked.pair.b() : asked.pair.a();
        NamedPairs pairs(report, {other_shape, margin, asked.pair.rounding()});
        match(
            of_side(one, side), of_side(other, side),
            [&](ContactPoint i, const ContactPoint& j) {
                if (!analytic) {
                    i.unique = j.unique;
                }
                pairs.add(i.position, named(i), named(j));
                report.require(i.inside == j.inside || i.distance <= margin, "only one says that ",
                               i.position.x, ", ", i.position.y, " is inside; it is ", i.distance);
                report.require(!analytic || !same_feature(i.feature, j.feature) ||
                                   i.inside != j.inside || i.normal == j.normal,
                               "normals differ at ", i.position.x, ", ", i.position.y, ", ",
                               i.distance, " away: ", i.normal.x, ", ", i.normal.y, " and ",
                               j.normal.x, ", ", j.normal.y);
            },
            [&](const ContactPoint& alone) {
                report.require(alone.distance >= query.contact_distance - margin,
                               "only one has a contact at ", alone.position.x, ", ",
                               alone.position.y, ", distance ", alone.distance);
            });
        if (asked.mostly_equal) {
            pairs.require_most_equal();
        }
    }
    check_manifolds(report, one, other);
}

}  // namespace nearfield::test
