#pragma once

#include <tests/query/counted_context.hpp>

#include <vector>

namespace nearfield::test {

/// Batches in flight that the library submits.
class Frames : public CountedContext {
protected:
    /// One of each kind of query; `number` tells batches apart.
    [[nodiscard]] Batch batch(int number) const;

    std::vector<Vector2> field_points_{{0.1, 0.2}, {-0.3, 0.4}};
};

}  // namespace nearfield::test
