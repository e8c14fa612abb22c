#include <engine/plan/simplified_shapes.hpp>

#include <algorithm>

namespace nearfield::plan {
namespace {

// How far back to look: a longer search would cost more than simplifying a small shape again.
constexpr std::size_t remembered = 64;

}  // namespace

const std::vector<geometry::SimplifiedEdge>& SimplifiedShapes::get(const geometry::Polygon& polygon,
                                                                   double deviation,
                                                                   double longest_run) {
    const std::size_t filled = std::min(used_, remembered);
    for (std::size_t i = 0; i < filled; ++i) {
        const Entry& entry = entries_[i];
        if (entry.polygon == &polygon && entry.deviation == deviation &&
            entry.longest_run == longest_run) {
            return entry.edges;
        }
    }
    const std::size_t place = used_++ % remembered;
    if (place >= entries_.size()) {
        entries_.emplace_back();
    }
    Entry& entry = entries_[place];
    entry.polygon = &polygon;
    entry.deviation = deviation;
    entry.longest_run = longest_run;
    entry.edges.clear();
    geometry::simplify(polygon, deviation, longest_run, entry.edges);
    return entry.edges;
}

}  // namespace nearfield::plan
