#include <engine/base/interruption.hpp>
#include <engine/narrowphase/located_points.hpp>

namespace nearfield::narrowphase {
namespace {

using geometry::Vector;

/// Determines which points lie inside a polygon, for points in order along a line.
class SidesOfPoints {
public:
    /// Points nearer to the boundary than `touching` are not inside.
    SidesOfPoints(const simd::TransformedEdges& edges, double touching, RayParities& parities)
        : edges_(edges), touching_(touching), parities_(parities) {
        if (!is_small(edges)) {
            parities.begin(edges.tree());
        }
    }

    /// `distance`: from the boundary. Odd: inside.
    [[nodiscard]] RayParities::Ticket ask(const Vector& point, double distance) {
        if (distance <= touching_) {
            return RayParities::even;
        }
        // If two points are closer to each other than the sum of their distances to the boundary,
        // no boundary lies between them.
        const double clear = distance + distance_ - touching_;
        if (distance_ == 0.0 || (point - point_).squaredNorm() >= clear * clear) {
            inside_ = is_small(edges_) ? RayParities::known(contains(edges_, point))
                                       : parities_.ask(point.x(), point.y());
        }
        point_ = point;
        distance_ = distance;
        return inside_;
    }

private:
    const simd::TransformedEdges& edges_;
    double touching_;
    RayParities& parities_;
    Vector point_ = Vector::Zero();  // the last one that did not touch
    double distance_ = 0.0;          // 0: none
    RayParities::Ticket inside_ = RayParities::even;
};

}  // namespace

void LocatedPoints::find(const simd::PointArrays& points, const simd::TransformedEdges& edges,
                         const Distances& distances) {
    nearest_.find(points, edges, distances.margin);
    const simd::NearestArrays& nearest = nearest_.arrays();
    SidesOfPoints sides(edges, distances.touching, parities_);
    SparseCheckpoint<64> checkpoint;
    sides_.resize(std::max<std::size_t>(sides_.size(), points.count));
    for (std::size_t i = 0; i < points.count; ++i) {
        checkpoint.step();
        if (nearest.distance[i] <= distances.reach) {
            sides_[i] = sides.ask({points.x[i], points.y[i]}, nearest.distance[i]);
        }
    }
    parities_.answer();
}

}  // namespace nearfield::narrowphase
