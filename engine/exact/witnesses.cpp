#include <engine/exact/witnesses.hpp>
#include <engine/geometry/segment.hpp>

#include <algorithm>
#include <cmath>

namespace nearfield::exact {
namespace {

using geometry::Vector;

// So many vertices and so many edges of a shape are looked at; every so many of more.
constexpr std::uint32_t most_of_each = 48;

// Chords between so many vertices, every so many of more, are tried, and so many kept.
constexpr std::uint32_t most_ends = 24;
constexpr std::size_t most_chords = 12;

// Discs shrink until nothing is in them; mostly three times suffice.
constexpr int most_shrinks = 12;

Chord chord_between(const Vector& start, const Vector& end) {
    const Vector along = end - start;
    return {start, end, Vector(-along.y(), along.x()).normalized()};
}

/// Whether what is between two vertices lies inside. False where it touches the boundary.
bool is_inside(const PlacedEdges& edges, std::uint32_t first, std::uint32_t second) {
    const Vector start = edges.start(first);
    const Vector end = edges.start(second);
    const Vector middle = 0.5 * (start + end);
    if (!contains(edges, middle)) {
        return false;
    }
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        const Vector from = edges.start(i);
        const Vector to = edges.end(i);
        const bool at_an_end = i == first || i == second || to == start || to == end;
        if (!at_an_end && geometry::segments_meet(start, end, from, to, edges.rounding)) {
            return false;
        }
    }
    return true;
}

}  // namespace

double crossing_depth(const Chord& a, const Vector& shift_of_a, const Chord& b) {
    const auto depth = [](double start, double end) {
        return (start < 0.0) == (end < 0.0) ? -1.0 : std::min(std::abs(start), std::abs(end));
    };
    const Vector between = a.start + shift_of_a - b.start;
    const double of_a = b.normal.dot(between);
    const double of_b = -a.normal.dot(between);
    return std::min(depth(of_a, of_a + b.normal.dot(a.end - a.start)),
                    depth(of_b, of_b + a.normal.dot(b.end - b.start)));
}

double depth_in(const PlacedEdges& edges, const Vector& point) {
    const double distance = std::sqrt(find_nearest(edges, point).squared);
    return contains(edges, point) ? distance : -distance;
}

void Witnesses::add_largest_disc(const PlacedEdges& edges, std::uint32_t edge) {
    const Vector start = edges.start(edge);
    const Vector end = edges.end(edge);
    const Vector along = end - start;
    const double length = along.norm();
    if (!(length > 0.0)) {
        return;
    }
    const Vector middle = 0.5 * (start + end);
    Vector inward = Vector(-along.y(), along.x()) / length;
    double radius = 0.5 * edges.box.diagonal().norm();
    // The larger the step the surer the side, as long as nothing is in between.
    const double probe = 1e-6 * length;
    const Vector left = middle + probe * inward;
    if (!contains(edges, left)) {
        inward = -inward;
    }
    for (int i = 0; i < most_shrinks; ++i) {
        const Vector centre = middle + radius * inward;
        const NearEdge near = find_nearest(edges, centre);
        if (near.squared >= radius * radius * (1.0 - 1e-9)) {
            break;
        }
        // The disc that touches the edge in its middle and goes through that point.
        const Vector point =
            geometry::nearest_on_segment(centre, edges.start(near.edge), edges.end(near.edge))
                .point -
            middle;
        const double ahead = inward.dot(point);
        if (!(ahead > 0.0)) {
            break;
        }
        radius = std::min(radius, point.squaredNorm() / (2.0 * ahead));
    }
    const Vector centre = middle + radius * inward;
    const double depth = depth_in(edges, centre);
    if (depth > 0.0) {
        all_.push_back({centre, depth});
    }
}

void Witnesses::choose_chords(const PlacedEdges& edges) {
    const auto is_longer = [](const Chord& i, const Chord& j) {
        return (i.end - i.start).squaredNorm() > (j.end - j.start).squaredNorm();
    };
    chords_.clear();
    for (std::uint32_t i = 0; i < edges.count; ++i) {
        chords_.push_back(chord_between(edges.start(i), edges.end(i)));
    }
    const std::uint32_t stride = (edges.count + most_ends - 1) / most_ends;
    for (std::uint32_t i = 0; i < edges.count; i += stride) {
        for (std::uint32_t j = i + stride; j < edges.count; j += stride) {
            if (is_inside(edges, i, j)) {
                chords_.push_back(chord_between(edges.start(i), edges.start(j)));
            }
        }
    }
    const std::size_t kept = std::min(most_chords, chords_.size());
    std::partial_sort(chords_.begin(), chords_.begin() + static_cast<std::ptrdiff_t>(kept),
                      chords_.end(), is_longer);
    chords_.resize(kept);
}

void Witnesses::choose(const PlacedEdges& edges) {
    all_.clear();
    const std::uint32_t stride = (edges.count + most_of_each - 1) / most_of_each;
    for (std::uint32_t i = 0; i < edges.count; i += stride) {
        add_largest_disc(edges, i);
    }
    // The largest first: they say most.
    std::sort(all_.begin(), all_.end(),
              [](const Witness& i, const Witness& j) { return i.radius > j.radius; });
    for (std::uint32_t i = 0; i < edges.count; i += stride) {
        all_.push_back({edges.start(i), 0.0});
    }
    choose_chords(edges);
}

}  // namespace nearfield::exact
