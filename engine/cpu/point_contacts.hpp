#pragma once

#include <engine/cpu/near_samples.hpp>
#include <engine/cpu/transformed_pair.hpp>
#include <engine/narrowphase/boundary.hpp>
#include <engine/narrowphase/located_points.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/plan/plan.hpp>
#include <engine/records/found_contacts.hpp>
#include <engine/simd/transformed_edges.hpp>
#include <nearfield/result.hpp>

namespace nearfield::cpu {

/// Answers contact queries by Technique::cpu, from query to result, for boundaries whose samples
/// are few enough to keep. Plans nothing, and tests only samples of edges that come close to each
/// other. Reuses its memory between batches.
class PointContacts {
public:
    /// Writes a result whose bound is set: its status and, if that is good, the rest.
    void answer(const plan::PlannedQuery& query, simd::TransformedInstances& instances,
                ContactResult& result);

private:
    /// Calls `use(place, resolved point)` for the samples of A's boundary that are contacts, in
    /// order.
    template <class Use>
    void for_each_contact(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                          double contact_distance, const ContactResult& result, const Use& use);
    /// Finds the contacts of both boundaries.
    void find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
              double contact_distance, ContactResult& result);

    NearSamples samples_;
    narrowphase::LocatedPoints located_;  // the samples
    narrowphase::Boundary boundary_;      // of B
    records::FoundContacts found_;
    narrowphase::OverlapTest overlap_test_;
};

}  // namespace nearfield::cpu
