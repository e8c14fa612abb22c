#include <engine/base/interruption.hpp>
#include <engine/solvers/manifold.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

namespace nearfield::solvers {
namespace {

using geometry::Polygon;
using geometry::to_vector;
using geometry::Vector;

/// The cosine of the largest angle between normals of one cluster.
constexpr double widest_turn = std::numbers::sqrt2 / 2.0;

/// Negative inside: the least is the most extreme.
double signed_distance(const ContactPoint& contact) {
    return contact.inside ? -contact.distance : contact.distance;
}

/// The contact's point on A's boundary.
Vector2 point_on_a(const ContactPoint& contact) {
    return contact.on == Side::a ? contact.position : contact.nearest;
}

/// Calls `use(contact)` for the contacts of an interval, in order.
template <class Interval, class Use>
void for_each(std::span<const TransformedContact> contacts, const Interval& interval,
              const Use& use) {
    for (std::size_t i = interval.first; i < interval.end; ++i) {
        use(contacts[i].record);
    }
    for (std::size_t i = interval.wrapped_first; i < interval.wrapped_end; ++i) {
        use(contacts[i].record);
    }
}

/// Finds one end of an interval: the contact farthest along a direction. Distance from B counts
/// twice against it, so that where A turns away from B its corner is the end, and where B turns
/// away, the contact near B's corner; depth counts slightly in its favour.
class EndFinder {
public:
    explicit EndFinder(const Vector& along) : along_(along) {}

    void look_at(const ContactPoint& contact, std::size_t order) {
        const double merit = along_.dot(to_vector(point_on_a(contact))) +
                             (contact.inside ? contact.distance / 8.0 : -2.0 * contact.distance);
        if (merit > merit_) {
            merit_ = merit;
            point_ = point_on_a(contact);
            order_ = order;
        }
    }

    [[nodiscard]] Vector2 point() const { return point_; }
    [[nodiscard]] std::size_t order() const { return order_; }

private:
    Vector along_;
    double merit_ = -std::numeric_limits<double>::infinity();
    Vector2 point_;
    std::size_t order_ = 0;
};

bool is_before(const queries::BoundaryPoint& i, const queries::BoundaryPoint& j) {
    return std::tie(i.edge, i.parameter) < std::tie(j.edge, j.parameter);
}

}  // namespace

bool ManifoldBuilder::continues(std::span<const TransformedContact> contacts,
                                const Interval& interval, const TransformedContact& next,
                                const Vector& normal) const {
    const Vector gap =
        to_vector(next.record.position) - to_vector(contacts[interval.last()].record.position);
    return gap.norm() <= spacing_ &&
           interval.normals.dot(normal) >= widest_turn * interval.normals.norm() * normal.norm();
}

void ManifoldBuilder::find_intervals(const Polygon& polygon,
                                     std::span<const TransformedContact> contacts) {
    intervals_.clear();
    std::size_t ring_start = 0;  // the first interval of the current ring
    std::uint32_t ring = 0;
    SparseCheckpoint<1024> checkpoint;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        checkpoint.step();
        const std::uint32_t ring_of_contact = polygon.ring_of(contacts[i].place.edge);
        if (ring_of_contact != ring) {
            close_ring(contacts, ring_start);
            ring_start = intervals_.size();
            ring = ring_of_contact;
        }
        const Vector normal = to_vector(contacts[i].record.normal);
        if (intervals_.size() > ring_start &&
            continues(contacts, intervals_.back(), contacts[i], normal)) {
            ++intervals_.back().end;
            intervals_.back().normals += normal;
        } else {
            intervals_.push_back({i, i + 1, 0, 0, normal});
        }
    }
    close_ring(contacts, ring_start);
}

void ManifoldBuilder::close_ring(std::span<const TransformedContact> contacts,
                                 std::size_t ring_start) {
    if (intervals_.size() < ring_start + 2) {
        return;
    }
    Interval& front = intervals_[ring_start];
    const Interval& back = intervals_.back();
    if (continues(contacts, back, contacts[front.first], front.normals)) {
        front = {back.first, back.end, front.first, front.end, back.normals + front.normals};
        intervals_.pop_back();
    }
}

void ManifoldBuilder::add_cluster(std::span<const TransformedContact> contacts,
                                  const Interval& interval,
                                  std::vector<ContactCluster>& manifold) const {
    const double length = interval.normals.norm();
    const Vector normal = length > 0.0 ? Vector(interval.normals / length)
                                       : to_vector(contacts[interval.first].record.normal);
    const Vector along(-normal.y(), normal.x());
    EndFinder left(along);
    EndFinder right(-along);
    ContactCluster& cluster = manifold.emplace_back();
    cluster.extreme = contacts[interval.first].record;
    std::size_t order = 0;
    for_each(contacts, interval, [&](const ContactPoint& contact) {
        left.look_at(contact, order);
        right.look_at(contact, order);
        if (signed_distance(contact) < signed_distance(cluster.extreme)) {
            cluster.extreme = contact;
        }
        ++order;
    });
    cluster.first = (left.order() <= right.order() ? left : right).point();
    cluster.last = (left.order() <= right.order() ? right : left).point();
    cluster.normal = geometry::to_public(normal);
    cluster.count = static_cast<std::uint32_t>(interval.count());
}

/// The last interval that begins before a position on A's boundary and the first that begins after
/// it, around the position's ring: the position lies on or near one of them, or on none.
std::span<const std::size_t> ManifoldBuilder::candidates(const Polygon& a,
                                                         std::span<const TransformedContact> of_a,
                                                         const queries::BoundaryPoint& place) {
    const auto begins_before = [&](std::size_t i, const queries::BoundaryPoint& other) {
        return is_before(of_a[intervals_[i].first].place, other);
    };
    const std::uint32_t ring = a.ring_of(place.edge);
    const auto begin =
        std::lower_bound(by_start_.begin(), by_start_.end(),
                         queries::BoundaryPoint{a.ring_begin(ring), 0.0}, begins_before);
    const auto end = std::lower_bound(begin, by_start_.end(),
                                      queries::BoundaryPoint{a.ring_end(ring), 0.0}, begins_before);
    candidate_count_ = 0;
    if (begin != end) {
        const auto next = std::lower_bound(begin, end, place, begins_before);
        candidates_[candidate_count_++] = next == begin ? *(end - 1) : *(next - 1);
        candidates_[candidate_count_++] = next == end ? *begin : *next;
    }
    return {candidates_.data(), candidate_count_};
}

void ManifoldBuilder::join_contacts_of_b(const Polygon& a, std::span<const TransformedContact> of_a,
                                         std::span<const TransformedContact> of_b,
                                         std::span<ContactCluster> clusters) {
    left_over_.clear();
    by_start_.resize(intervals_.size());
    std::iota(by_start_.begin(), by_start_.end(), std::size_t{0});
    std::sort(by_start_.begin(), by_start_.end(), [&](std::size_t i, std::size_t j) {
        return is_before(of_a[intervals_[i].first].place, of_a[intervals_[j].first].place);
    });
    const auto lies_on = [&](const TransformedContact& contact, const Interval& interval) {
        const TransformedContact& first = of_a[interval.first];
        const TransformedContact& last = of_a[interval.last()];
        if (a.ring_of(contact.on_a.edge) != a.ring_of(first.place.edge)) {
            return false;
        }
        const bool after_first = !is_before(contact.on_a, first.place);
        const bool before_last = !is_before(last.place, contact.on_a);
        const bool wraps = is_before(last.place, first.place);
        const Vector nearest = to_vector(contact.record.nearest);
        return (wraps ? after_first || before_last : after_first && before_last) ||
               (nearest - to_vector(first.record.position)).norm() <= spacing_ ||
               (nearest - to_vector(last.record.position)).norm() <= spacing_;
    };
    SparseCheckpoint<256> checkpoint;
    for (const TransformedContact& contact : of_b) {
        checkpoint.step();
        bool found = false;
        for (const std::size_t i : candidates(a, of_a, contact.on_a)) {
            found = lies_on(contact, intervals_[i]);
            if (found) {
                if (signed_distance(contact.record) < signed_distance(clusters[i].extreme)) {
                    clusters[i].extreme = contact.record;
                }
                break;
            }
        }
        if (!found) {
            left_over_.push_back(contact);
        }
    }
}

void ManifoldBuilder::build(const Polygon& a, const Polygon& b,
                            std::span<const TransformedContact> of_a,
                            std::span<const TransformedContact> of_b, double spacing,
                            std::vector<ContactCluster>& manifold) {
    // Rounding may make equally spaced samples slightly farther apart.
    spacing_ = spacing * (1.0 + 1e-6);
    const std::size_t first = manifold.size();
    find_intervals(a, of_a);
    SparseCheckpoint<256> checkpoint;
    for (const Interval& interval : intervals_) {
        checkpoint.step();
        add_cluster(of_a, interval, manifold);
    }
    join_contacts_of_b(a, of_a, of_b, std::span(manifold).subspan(first));
    // A sharp feature of B close to A between two samples of A appears only among B's contacts.
    find_intervals(b, left_over_);
    for (const Interval& interval : intervals_) {
        checkpoint.step();
        add_cluster(left_over_, interval, manifold);
    }
}

}  // namespace nearfield::solvers
