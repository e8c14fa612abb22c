#include <embedded/austria_50m.hpp>
#include <embedded/cuba_50m.hpp>
#include <embedded/iceland_10m.hpp>
#include <embedded/ireland_10m.hpp>
#include <embedded/sri_lanka_10m.hpp>
#include <embedded/sweden_50m.hpp>
#include <tools/io/geojson.hpp>
#include <tools/simulation/countries.hpp>
#include <tools/simulation/mass_properties.hpp>
#include <tools/simulation/plane.hpp>

#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string>

namespace nearfield::simulation {
namespace {

using simulation::cross;
using simulation::operator-;
using simulation::operator*;

bool edges_cross(Vector2 a, Vector2 b, Vector2 c, Vector2 d) {
    return cross(b - a, c - a) * cross(b - a, d - a) <= 0.0 &&
           cross(d - c, a - c) * cross(d - c, b - c) <= 0.0;
}

/// True if the edge that replaces a vertex crosses an edge other than its two neighbours.
bool crosses_without(const Ring& ring, std::size_t vertex) {
    const std::size_t n = ring.size();
    const std::size_t before = (vertex + n - 1) % n;
    const std::size_t after = (vertex + 1) % n;
    for (std::size_t step = 1; step + 3 < n; ++step) {
        const std::size_t from = (after + step) % n;
        const std::size_t to = (from + 1) % n;
        if (to != before && edges_cross(ring[before], ring[after], ring[from], ring[to])) {
            return true;
        }
    }
    return false;
}

/// The vertex with the smallest triangle among those that are not needed.
std::size_t min_vertex(const Ring& ring, const std::vector<bool>& needed) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t chosen = 0;
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vector2 before = ring[i == 0 ? n - 1 : i - 1];
        const Vector2 after = ring[i + 1 == n ? 0 : i + 1];
        const double area = std::abs(cross(ring[i] - before, after - before));
        if (area < least && !needed[i]) {
            least = area;
            chosen = i;
        }
    }
    return chosen;
}

Ring country(const std::string& text, std::size_t vertices, double area) {
    Ring ring = tools::parse_geojson(text, "country").front();
    if (ring.front() == ring.back()) {
        ring.pop_back();
    }
    ring = thinned(std::move(ring), vertices);
    const MassProperties plate = simulation::mass_properties(std::span(&ring, 1));
    for (Vector2& vertex : ring) {
        vertex = std::sqrt(area / plate.area) * (vertex - plate.centroid);
    }
    return ring;
}

}  // namespace

Ring thinned(Ring ring, std::size_t count) {
    std::vector<bool> needed(ring.size(), false);
    while (ring.size() > count) {
        const std::size_t chosen = min_vertex(ring, needed);
        if (crosses_without(ring, chosen)) {
            needed[chosen] = true;
            continue;
        }
        const auto place = static_cast<std::ptrdiff_t>(chosen);
        ring.erase(ring.begin() + place);
        needed.erase(needed.begin() + place);
    }
    return ring;
}

std::vector<Ring> countries(double area) {
    return {country(embedded::iceland_10m, 120, area),   country(embedded::ireland_10m, 120, area),
            country(embedded::austria_50m, 120, area),   country(embedded::sweden_50m, 120, area),
            country(embedded::sri_lanka_10m, 119, area), country(embedded::cuba_50m, 120, area)};
}

}  // namespace nearfield::simulation
