#pragma once

#include <nearfield/nearfield.hpp>

namespace nearfield::test {

/// A batch with every kind of query by every technique, with every option that changes the device's
/// work; none needs an optional part of the device. `number` distinguishes batches.
[[nodiscard]] Batch every_query(ShapeHandle a, ShapeHandle b, int number);

/// The queries of a batch whose results can stay on the device, with results that do.
[[nodiscard]] Batch resident_queries(const Batch& every);

}  // namespace nearfield::test
