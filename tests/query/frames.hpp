#pragma once

#include <tests/query/counted_context.hpp>

#include <vector>

namespace nearfield::test {

/// Tests with batches in flight that the library submits.
class Frames : public CountedContext {
protected:
    /// One query of each kind; `number` distinguishes batches.
    [[nodiscard]] Batch batch(int number) const;

    std::vector<Vector2> field_points_{{0.1, 0.2}, {-0.3, 0.4}};
};

}  // namespace nearfield::test
