#pragma once

#include <nearfield/nearfield.hpp>

namespace nearfield::test {

/// A batch of every kind of query by every technique, with every option that makes the device do
/// something else; none needs an optional part of the device. `number` tells batches apart.
/// `recordable`: without the queries that take a second submission.
[[nodiscard]] Batch every_query(ShapeHandle a, ShapeHandle b, int number, bool recordable);

}  // namespace nearfield::test
