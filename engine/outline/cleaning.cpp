#include <engine/base/catch_to_status.hpp>
#include <engine/geometry/number.hpp>
#include <engine/geometry/ring_check.hpp>
#include <engine/geometry/vector.hpp>
#include <engine/outline/exact_kernels.hpp>
#include <nearfield/fill.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace nearfield {
namespace {

using geometry::to_vector;
using geometry::Vector;

/// An upper bound on the least height of a triangle. No point of it is farther than that from the
/// two sides that meet at b.
double least_height(const Vector2& a, const Vector2& b, const Vector2& c) {
    if (outline::exact::orientation(a, b, c) == 0) {
        return 0.0;
    }
    const Vector ab = to_vector(b) - to_vector(a);
    const Vector ac = to_vector(c) - to_vector(a);
    const Vector bc = to_vector(c) - to_vector(b);
    const double longest = std::max({ab.norm(), ac.norm(), bc.norm()});
    const double left = ab.x() * (ac.y() / longest);
    const double right = ab.y() * (ac.x() / longest);
    return std::abs(left - right) + 0x1p-50 * (std::abs(left) + std::abs(right));
}

/// Drops vertices of one ring: replaces the two edges at a vertex by one where the triangle
/// between them is thin. Every edge knows how far it may be from the original ring, and so is
/// every point that the ring has passed; both stay within the width.
class VertexCleaner {
public:
    VertexCleaner(std::span<const Vector2> vertices, double width, CleanedRings& counts)
        : vertices_(vertices),
          width_(width),
          counts_(counts),
          next_(vertices.size()),
          previous_(vertices.size()),
          error_(vertices.size()),
          waits_(vertices.size(), true) {
        const std::size_t size = vertices.size();
        for (std::size_t i = 0; i < size; ++i) {
            next_[i] = i + 1 == size ? 0 : i + 1;
            previous_[i] = i == 0 ? size - 1 : i - 1;
            waiting_.push_back(size - 1 - i);
        }
        count_ = size;
    }

    /// The vertices that remain; fewer than three if the ring encloses nothing wider.
    Ring run() {
        while (!waiting_.empty() && count_ >= 3) {
            const std::size_t vertex = waiting_.back();
            waiting_.pop_back();
            waits_[vertex] = false;
            examine(vertex);
        }
        Ring ring;
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            if (previous_[i] != dropped) {
                ring.push_back(vertices_[i]);
            }
        }
        return ring;
    }

    /// How far points that changed sides may be from the original ring.
    [[nodiscard]] double deviation() const { return deviation_; }

private:
    static constexpr std::size_t dropped = SIZE_MAX;

    void examine(std::size_t vertex) {
        if (previous_[vertex] == dropped) {
            return;
        }
        const std::size_t before = previous_[vertex];
        const std::size_t after = next_[vertex];
        const Vector2& a = vertices_[before];
        const Vector2& b = vertices_[vertex];
        const Vector2& c = vertices_[after];
        const double error = least_height(a, b, c) + std::max(error_[before], error_[vertex]);
        if (error > width_) {
            return;
        }
        ++count_of(a, b, c);
        deviation_ = std::max(deviation_, error);
        error_[before] = error;
        next_[before] = after;
        previous_[after] = before;
        previous_[vertex] = dropped;
        --count_;
        wait(after);
        wait(before);
    }

    std::size_t& count_of(const Vector2& a, const Vector2& b, const Vector2& c) {
        if (a == b || b == c) {
            return counts_.repeated;
        }
        const double ahead = (to_vector(b) - to_vector(a)).dot(to_vector(c) - to_vector(b));
        return ahead > 0.0 ? counts_.collinear : counts_.spikes;
    }

    void wait(std::size_t vertex) {
        if (!waits_[vertex]) {
            waits_[vertex] = true;
            waiting_.push_back(vertex);
        }
    }

    std::span<const Vector2> vertices_;
    double width_;
    CleanedRings& counts_;
    std::vector<std::size_t> next_;
    std::vector<std::size_t> previous_;  // dropped: no longer in the ring
    std::vector<double> error_;          // of the edge from each vertex to the next
    std::vector<bool> waits_;
    std::vector<std::size_t> waiting_;  // to be examined, the last one first
    std::size_t count_ = 0;
    double deviation_ = 0.0;
};

class RingCleaner {
public:
    explicit RingCleaner(const Cleaning& cleaning) : cleaning_(cleaning) {}

    void add(std::size_t index, const Ring& ring) {
        const std::span<const Vector2> vertices = geometry::open_ring(ring);
        if (!geometry::has_three_different(vertices)) {
            drop(index, ring, 0.0, 0.0);
            return;
        }
        const double least = geometry::smallest_width(geometry::largest_coordinate_of({&ring, 1}));
        width_ = std::max(cleaning_.width, least);
        const double width = geometry::strip_width(vertices);
        if (width <= width_) {
            drop(index, ring, width, 0.5 * width);
        } else if (!cleaning_.vertices) {
            result_.rings.push_back(ring);
        } else {
            clean_vertices(index, ring, vertices, width);
        }
    }

    CleanedRings result() { return std::move(result_); }

private:
    void clean_vertices(std::size_t index, const Ring& ring, std::span<const Vector2> vertices,
                        double width) {
        CleanedRings counts;
        VertexCleaner cleaner(vertices, width_, counts);
        Ring cleaned = cleaner.run();
        const double width_left = geometry::strip_width(cleaned);
        if (!geometry::has_three_different(cleaned) || width_left <= width_) {
            drop(index, ring, width, cleaner.deviation() + 0.5 * width_left);
            return;
        }
        result_.repeated += counts.repeated;
        result_.collinear += counts.collinear;
        result_.spikes += counts.spikes;
        result_.deviation = std::max(result_.deviation, cleaner.deviation());
        result_.rings.push_back(std::move(cleaned));
    }

    /// `deviation`: the largest distance from the ring of a point inside it.
    void drop(std::size_t index, const Ring& ring, double width, double deviation) {
        result_.dropped.push_back({index, ring.empty() ? Vector2{} : ring.front(), width});
        result_.deviation = std::max(result_.deviation, deviation);
    }

    const Cleaning& cleaning_;
    double width_ = 0.0;  // of the ring that is being cleaned
    CleanedRings result_;
};

CleanedRings cleaned(std::span<const Ring> rings, const Cleaning& cleaning) {
    if (!(cleaning.width >= 0.0 && cleaning.width <= largest_coordinate)) {
        geometry::refuse_shape("the width is " + geometry::number(cleaning.width) +
                               "; it must be a number of at least 0 and at most " +
                               geometry::number(largest_coordinate));
    }
    geometry::require_usable(rings);
    RingCleaner cleaner(cleaning);
    for (std::size_t index = 0; index < rings.size(); ++index) {
        cleaner.add(index, rings[index]);
    }
    return cleaner.result();
}

}  // namespace

Expected<CleanedRings> clean(std::span<const Ring> rings, const Cleaning& cleaning) {
    return catch_to_expected([&] { return cleaned(rings, cleaning); });
}

}  // namespace nearfield
