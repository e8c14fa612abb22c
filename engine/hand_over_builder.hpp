#pragma once

#include <engine/exact/boundary.hpp>
#include <engine/plan/hand_over.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/round.hpp>
#include <engine/sample_hand_over_builder.hpp>
#include <nearfield/result.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace nearfield {

/// Finds what of a batch stays on the device, where the rounds leave it, and what the device has to
/// know to hand it over. Keeps its scratch memory.
class HandOverBuilder {
public:
    /// `results` say which queries are refused.
    void build(const plan::Plan& plan, std::span<const plan::Round> rounds,
               std::span<const AnyResult> results, plan::HandOver& hand_over);

private:
    void find_field_parts(const plan::Plan& plan, std::span<const plan::Round> rounds);
    void add_field(const plan::PlannedQuery& planned, std::uint32_t query,
                   const DistanceFieldResult& result, plan::HandOver& hand_over);
    void add_records(const plan::Plan& plan, std::span<const plan::Round> rounds,
                     std::uint32_t query, plan::HandOver& hand_over);
    void add_runs(const plan::Plan& plan, std::span<const plan::Round> rounds,
                  const plan::PlannedQuery& planned, std::uint32_t flags,
                  plan::HandOver& hand_over);
    [[nodiscard]] std::uint32_t normal_at(const plan::PlannedQuery& planned,
                                          const plan::BoundaryPoint& point);

    SampleHandOverBuilder samples_;
    std::vector<std::pair<std::uint32_t, plan::FieldPartHandOver>> parts_;  // with their query
    std::optional<geometry::PlacedPolygon> b_;                              // of contacts
    exact::Boundary boundary_;  // of that, where it is set
};

}  // namespace nearfield
