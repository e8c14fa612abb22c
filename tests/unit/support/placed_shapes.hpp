#pragma once

#include <engine/simd/transformed_edges.hpp>

#include <gtest/gtest.h>
#include <tests/unit/support/shape_samples.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace nearfield::samples {

/// Two transformed shapes, complete.
class PlacedPair {
public:
    PlacedPair(const geometry::Polygon& a, const Pose& pose_a, const geometry::Polygon& b,
               const Pose& pose_b)
        : a_(instances_.place(a, pose_a)), b_(instances_.place(b, pose_b)) {
        instances_.complete(a_);
        instances_.complete(b_);
    }
    [[nodiscard]] const simd::TransformedEdges& a() const { return instances_[a_]; }
    [[nodiscard]] const simd::TransformedEdges& b() const { return instances_[b_]; }

private:
    simd::TransformedInstances instances_;
    std::uint32_t a_;
    std::uint32_t b_;
};

/// Calls `check(edges)` for each shape, complete, as it is and at a pose.
template <class Check>
void for_each_placed(const std::vector<test::NamedRings>& shapes, const Pose& moved,
                     const Check& check) {
    for (const test::NamedRings& shape : shapes) {
        for (const Pose& pose : {Pose{}, moved}) {
            SCOPED_TRACE(shape.name + " moved by " + std::to_string(pose.translation.x));
            const geometry::Polygon polygon = samples::polygon(shape.rings);
            simd::TransformedInstances instances;
            const std::uint32_t index = instances.place(polygon, pose);
            instances.complete(index);
            check(instances[index]);
        }
    }
}

}  // namespace nearfield::samples
