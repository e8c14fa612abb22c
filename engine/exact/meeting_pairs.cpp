#include <engine/exact/meeting_pairs.hpp>

namespace nearfield::exact {

bool MeetingPairs::pick_near(const PlacedEdges& a, const PlacedEdges& b, double grow) {
    const Extent common = extent_of(geometry::grown(a.box.intersection(b.box), grow));
    of_a_.pick(a, common);
    if (of_a_.empty()) {
        return false;
    }
    of_b_.pick(b, common);
    return !of_b_.empty();
}

}  // namespace nearfield::exact
