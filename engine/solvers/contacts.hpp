#pragma once

#include <engine/narrowphase/boundary.hpp>
#include <engine/narrowphase/located_points.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/solvers/found_contacts.hpp>
#include <engine/solvers/gradient_normals.hpp>
#include <engine/solvers/near_samples.hpp>
#include <engine/solvers/workspace.hpp>
#include <nearfield/result.hpp>

namespace nearfield::solvers {

/// Answers contact queries. Tests only samples of edges that come close to each other. Reuses its
/// memory between batches.
class ContactSolver {
public:
    void answer(const queries::CheckedQuery& query, Workspace& workspace, ContactResult& result);

private:
    /// Throws StatusException (too_large) if there are more samples than can be numbered.
    void require_numbers(const queries::CheckedQuery& query, const simd::TransformedEdges& a,
                         const simd::TransformedEdges& b, queries::QueryMemory& memory);
    /// Calls `use(place, resolved point)` for the samples of A's boundary that are contacts, in
    /// order. Throws StatusException (too_large) if the batch has no memory for those found.
    template <class Use>
    void for_each_contact(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
                          double contact_distance, queries::QueryMemory& memory,
                          const ContactResult& result, const Use& use);
    /// Finds the contacts of both boundaries.
    void find(const simd::TransformedEdges& a, const simd::TransformedEdges& b,
              double contact_distance, queries::QueryMemory& memory, ContactResult& result);

    NearSamples samples_;
    narrowphase::LocatedPoints located_;  // the samples
    narrowphase::Boundary boundary_;      // of B
    FoundContacts found_;
    narrowphase::OverlapTest overlap_test_;
    GradientNormals normals_;
};

}  // namespace nearfield::solvers
