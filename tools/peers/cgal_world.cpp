#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <tools/peers/world_contest.hpp>

#include <algorithm>
#include <cmath>
#include <variant>

namespace nearfield::peers {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Segments = std::vector<Kernel::Segment_3>;
using Primitive = CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 in_plane(const Vector2& point) {
    return {point.x, point.y, 0.0};
}

/// CGAL: one AABB tree over all edges. It is three-dimensional only in this version, so edges lie
/// in the plane z = 0.
class CgalWorld final : public WorldPeer {
public:
    [[nodiscard]] std::string name() const override { return "CGAL"; }
    [[nodiscard]] std::string how(const WorldProblem& problem) const override {
        return problem.segments.empty()
                   ? std::string()
                   : "AABB tree: all edges that a segment intersects, the nearest of them";
    }
    void build(const WorldProblem& problem) override;
    void answer(const WorldProblem& problem, std::vector<double>& answers) override;

private:
    Segments edges_;
    Tree tree_;
    std::vector<Primitive::Id> found_;
};

void CgalWorld::build(const WorldProblem& problem) {
    for (const WorldShape& shape : problem.shapes) {
        for (const Ring& ring : shape.rings) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                edges_.emplace_back(in_plane(at_pose(ring[i], shape.pose)),
                                    in_plane(at_pose(ring[(i + 1) % ring.size()], shape.pose)));
            }
        }
    }
    tree_.rebuild(edges_.begin(), edges_.end());
    tree_.build();
}

/// The parameter at which a segment crosses an edge.
double crossing(const Segment& segment, const Kernel::Segment_3& edge) {
    const double x = segment.to.x - segment.from.x;
    const double y = segment.to.y - segment.from.y;
    const double along_x = edge.target().x() - edge.source().x();
    const double along_y = edge.target().y() - edge.source().y();
    const double to_x = edge.source().x() - segment.from.x;
    const double to_y = edge.source().y() - segment.from.y;
    return (to_x * along_y - to_y * along_x) / (x * along_y - y * along_x);
}

void CgalWorld::answer(const WorldProblem& problem, std::vector<double>& answers) {
    answers.clear();
    for (const Segment& segment : problem.segments) {
        found_.clear();
        tree_.all_intersected_primitives(
            Kernel::Segment_3(in_plane(segment.from), in_plane(segment.to)),
            std::back_inserter(found_));
        double first = 2.0;
        for (const Primitive::Id& id : found_) {
            first = std::min(first, crossing(segment, *id));
        }
        answers.push_back(first);
    }
}

}  // namespace

std::unique_ptr<WorldPeer> make_cgal_world() {
    return std::make_unique<CgalWorld>();
}

}  // namespace nearfield::peers
