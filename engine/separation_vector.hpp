#pragma once

#include <engine/exact/way_apart.hpp>
#include <engine/placed_pair.hpp>
#include <nearfield/result.hpp>

namespace nearfield {

/// Answers separation vectors, from query to result. Keeps its memory from batch to batch.
class SeparationVector {
public:
    /// Writes a result whose status is good.
    void answer(const plan::PlannedQuery& planned, exact::PlacedInstances& instances,
                SeparationVectorResult& result);

private:
    exact::WayApartFinder finder_;
};

}  // namespace nearfield
