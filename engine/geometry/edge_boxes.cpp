#include <engine/geometry/edge_boxes.hpp>
#include <engine/geometry/transformed_polygon.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace nearfield::geometry {
namespace {

constexpr std::uint32_t fan_out = EdgeBoxes::fan_out;

std::uint32_t over(std::uint32_t count) {
    return (count + fan_out - 1) / fan_out;
}

/// An oriented box that grows around points.
class GrowingBox {
public:
    /// Along the vector from one point to another.
    GrowingBox(const Vector& from, const Vector& to) {
        const Vector along = to - from;
        const double length = along.norm();
        if (length > 0.0) {
            along_x_ = along.x() / length;
            along_y_ = along.y() / length;
        }
    }

    void add(const Vector& point) { add(point, 0.0, 0.0); }
    /// Adds another box.
    void add(const EdgeBoxes::Group& group, std::uint32_t i) {
        const double along = std::abs(along_x_ * group.along_x[i] + along_y_ * group.along_y[i]);
        const double across = std::abs(along_x_ * group.along_y[i] - along_y_ * group.along_x[i]);
        add({group.x[i], group.y[i]}, along * group.half_along[i] + across * group.half_across[i],
            across * group.half_along[i] + along * group.half_across[i]);
    }
    void write(EdgeBoxes::Group& group, std::uint32_t i) const {
        const double unit[] = {along_x_, along_y_};
        group.set(i, unit, low_along_, high_along_, low_across_, high_across_);
    }

private:
    void add(const Vector& centre, double half_along, double half_across) {
        const double along = along_x_ * centre.x() + along_y_ * centre.y();
        const double across = along_x_ * centre.y() - along_y_ * centre.x();
        low_along_ = std::min(low_along_, along - half_along);
        high_along_ = std::max(high_along_, along + half_along);
        low_across_ = std::min(low_across_, across - half_across);
        high_across_ = std::max(high_across_, across + half_across);
    }

    double along_x_ = 1.0;
    double along_y_ = 0.0;
    double low_along_ = std::numeric_limits<double>::infinity();
    double high_along_ = -std::numeric_limits<double>::infinity();
    double low_across_ = std::numeric_limits<double>::infinity();
    double high_across_ = -std::numeric_limits<double>::infinity();
};

/// A box that holds nothing, in any direction. Its sides are finite, so that their products with
/// zero are zero.
void write_nothing(EdgeBoxes::Group& group, std::uint32_t i) {
    constexpr double nothing = -1e300;
    group.x[i] = group.y[i] = group.along_y[i] = 0.0;
    group.along_x[i] = 1.0;
    group.half_along[i] = group.half_across[i] = nothing;
}

/// Where the chain of edges before an edge leads: its start, or that of the first edge behind the
/// last one.
const Vector& chain_end(const Polygon& polygon, std::uint32_t end) {
    return polygon.vertices()[end < polygon.size() ? end : 0];
}

/// The box of the edges from `first` up to, but not including, `end`.
GrowingBox box_of_run(const Polygon& polygon, std::uint32_t first, std::uint32_t end) {
    const std::span<const Vector> vertices = polygon.vertices();
    GrowingBox box(vertices[first], chain_end(polygon, end));
    for (const Vector& vertex : vertices.subspan(first, end - first)) {
        box.add(vertex);
    }
    if (polygon.ring_count() == 1) {
        box.add(chain_end(polygon, end));
        return box;
    }
    for (std::uint32_t edge = first; edge < end; ++edge) {
        box.add(vertices[polygon.next(edge)]);
    }
    return box;
}

/// Writes the boxes of the lowest level.
void bound_runs(const Polygon& polygon, EdgeBoxes::Group* groups) {
    std::uint32_t run = 0;
    for (std::uint32_t ring = 0; ring < polygon.ring_count(); ++ring) {
        // Those up to the one that holds the last edge, which leads back to the ring's start.
        const std::uint32_t last = (polygon.ring_end(ring) - 1) / fan_out;
        kernels::bound_runs(polygon.vertices().data(), run, std::max(run, last), groups);
        if (run <= last) {
            const std::uint32_t end = std::min(fan_out * (last + 1), polygon.size());
            box_of_run(polygon, fan_out * last, end).write(groups[last / fan_out], last % fan_out);
        }
        run = last + 1;
    }
}

/// Whether eight edges are small against the polygon, judged by some of them.
bool are_small(const Polygon& polygon) {
    constexpr std::uint32_t samples = 32;
    const std::uint32_t runs = polygon.size() / fan_out;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const auto run = static_cast<std::uint32_t>(std::uint64_t{i} * runs / samples);
        Box box;
        for (const Vector& vertex :
             polygon.vertices().subspan(std::size_t{fan_out} * run, fan_out)) {
            box.extend(vertex);
        }
        sum += box.sizes().sum();
    }
    return sum < 0.25 * samples * polygon.radius();
}

}  // namespace

void EdgeBoxes::make(const Polygon& polygon) {
    first_groups_.clear();
    std::uint32_t groups = 0;
    for (std::uint32_t count = over(polygon.size());; count = over(count)) {
        first_groups_.push_back(groups);
        groups += over(count);
        if (count <= fan_out) {
            break;
        }
    }
    groups_.resize(groups);

    bound_runs(polygon, groups_.data());
    std::uint32_t count = over(polygon.size());
    std::uint32_t below = 0;
    std::uint32_t edges = fan_out;  // of a box
    for (std::uint32_t level = 0; level <= top_level(); ++level) {
        for (std::uint32_t number = 0; number < over(count); ++number) {
            Group& group = groups_[first_groups_[level] + number];
            for (std::uint32_t i = 0; i < fan_out; ++i) {
                const std::uint32_t box = fan_out * number + i;
                if (box >= count) {
                    write_nothing(group, i);
                    continue;
                }
                const std::uint32_t first = edges * box;
                const std::uint32_t end =
                    polygon.size() - first < edges ? polygon.size() : first + edges;
                if (level == 0) {
                    continue;
                }
                GrowingBox all(polygon.vertices()[first], chain_end(polygon, end));
                const Group& inner = groups_[first_groups_[level - 1] + box];
                for (std::uint32_t k = 0; k < std::min(below - fan_out * box, fan_out); ++k) {
                    all.add(inner, k);
                }
                all.write(group, i);
            }
        }
        below = count;
        count = over(count);
        edges *= fan_out;
    }
}

double box_allowance(const TransformedPolygon& placed) {
    // Every step of placing a vertex, of finding the boxes and of turning them rounds by at most
    // half an epsilon of these.
    return 64.0 * std::numeric_limits<double>::epsilon() *
           (2.0 * placed.polygon().radius() + placed.translation().lpNorm<Eigen::Infinity>());
}

const EdgeBoxes* KeptEdgeBoxes::find(const Polygon& polygon, BoxSearch search) const {
    State state = state_.load(std::memory_order_acquire);
    std::atomic<bool>& is_asked = is_asked_[static_cast<std::size_t>(search)];
    if (state == State::unknown && is_asked.exchange(true, std::memory_order_relaxed)) {
        const std::lock_guard lock(making_);
        state = state_.load(std::memory_order_relaxed);
        if (state == State::unknown) {
            state = are_small(polygon) ? State::made : State::useless;
            if (state == State::made) {
                boxes_.make(polygon);
            }
            state_.store(state, std::memory_order_release);
        }
    }
    return state == State::made ? &boxes_ : nullptr;
}

void KeptEdgeBoxes::forget() noexcept {
    state_.store(State::unknown, std::memory_order_relaxed);
    for (std::atomic<bool>& is_asked : is_asked_) {
        is_asked.store(false, std::memory_order_relaxed);
    }
}

}  // namespace nearfield::geometry
