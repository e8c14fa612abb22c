#include <engine/exact/meeting_pairs.hpp>

namespace nearfield::exact {

bool MeetingPairs::pick_near(const PlacedEdges& a, const PlacedEdges& b, double grow) {
    geometry::Box common = a.box.intersection(b.box);
    common.min().array() -= grow;
    common.max().array() += grow;
    of_a_.pick(a, extent_of(common));
    if (of_a_.empty()) {
        return false;
    }
    of_b_.pick(b, extent_of(common));
    return !of_b_.empty();
}

}  // namespace nearfield::exact
