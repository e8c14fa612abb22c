#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/exact/meeting.hpp>
#include <engine/exact/nearest_points.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/found_contacts.hpp>
#include <engine/near_samples.hpp>
#include <engine/placed_pair.hpp>
#include <engine/plan/plan.hpp>
#include <nearfield/result.hpp>

namespace nearfield {

/// Contacts by Technique::cpu of boundaries whose samples are not too many to keep, from query to
/// result: nothing is planned, and no samples are looked at but those of edges that come close to
/// each other. Keeps its memory from batch to batch.
class PointContacts {
public:
    /// Writes a result that says its bound already: its status, and if that is good the rest.
    void answer(const plan::PlannedQuery& query, exact::PlacedInstances& instances,
                ContactResult& result);

private:
    /// Calls `use(place, resolved point)` for the samples of A's boundary that are contacts, in
    /// order.
    template <class Use>
    void for_each_contact(const exact::PlacedEdges& a, const exact::PlacedEdges& b,
                          double contact_distance, const ContactResult& result, const Use& use);
    /// Of both boundaries.
    void find(const exact::PlacedEdges& a, const exact::PlacedEdges& b, double contact_distance,
              ContactResult& result);

    NearSamples samples_;
    exact::NearestPoints nearest_;  // to them
    exact::Boundary boundary_;      // of B
    FoundContacts found_;
    exact::MeetingFinder meeting_;
};

}  // namespace nearfield
