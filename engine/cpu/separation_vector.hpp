#pragma once

#include <engine/cpu/transformed_pair.hpp>
#include <engine/mtv/separating_translation.hpp>
#include <nearfield/result.hpp>

namespace nearfield::cpu {

/// Answers separation-vector queries, from query to result. Reuses its memory between batches.
class SeparationVector {
public:
    /// Writes a result whose status is good.
    void answer(const plan::PlannedQuery& planned, simd::TransformedInstances& instances,
                SeparationVectorResult& result);

private:
    mtv::SeparatingTranslationFinder finder_;
};

}  // namespace nearfield::cpu
