#pragma once

#include <engine/base/function_ref.hpp>
#include <engine/narrowphase/crossings.hpp>
#include <engine/narrowphase/ray_parities.hpp>
#include <engine/queries/edge_sampler.hpp>
#include <engine/simd/point_list.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nearfield::solvers {

/// Finds the samples of a polygon's boundary that lie inside another polygon, in lists of bounded
/// length. Finds the crossings
/// of the boundaries first: parity propagates between two crossings, so one sample decides for all
/// of them, and parts outside are not sampled. Reuses its memory between pairs.
class InsideSamples {
public:
    /// Finds the samples in order along A's rings, consecutive ones at most `spacing` apart along
    /// the boundary (see queries::sample_chains). Replaces `inside` by those found last: each time
    /// that it has as many as are located at once, `use()` is called and it starts over.
    /// Precondition: unless both polygons are small, both are complete. Unspecified for samples on
    /// B's boundary. `reversed`: the previous call had the same polygons in the opposite order.
    void find(const simd::TransformedEdges& a, const simd::TransformedEdges& b, bool reversed,
              double spacing, simd::PointList& inside, FunctionRef<void()> use);

    /// Upper bound on the number of samples that find() examines, inside or not. A double, since it
    /// may be huge. The same precondition.
    [[nodiscard]] double max_samples(const simd::TransformedEdges& a,
                                     const simd::TransformedEdges& b, double spacing);

private:
    using Ticket = narrowphase::RayParities::Ticket;
    using Part = std::int64_t;  // of an edge; there may be more than 32 bits count
    static constexpr Ticket is_outside = narrowphase::RayParities::even;
    static constexpr Ticket is_inside = narrowphase::RayParities::odd;

    /// Samples that were added before it is known whether they are inside.
    struct Doubtful {
        std::uint32_t first;
        std::uint32_t end;
        Ticket side;
    };

    /// Appends the inside samples of an edge that is divided into `parts`.
    void follow(std::uint32_t edge, double parts, std::span<const narrowphase::Crossing> crossings);
    /// Appends the samples of parts `part`, ..., end - 1, which lie on one side.
    void add_interval(std::uint32_t edge, double parts, Part part, Part end);
    /// The same for parts that do not lie on one side.
    void add_one_by_one(std::uint32_t edge, double parts, Part part, Part end);
    /// The end of the parts from `part` on for which the list has space, which is then reserved.
    [[nodiscard]] Part end_of_space(Part part, Part end);
    [[nodiscard]] Ticket side_of(const geometry::Vector& point);
    /// Adds a sample, unless it is known to be outside. Precondition: space is reserved.
    void add(const geometry::Vector& point, Ticket side);
    /// Decides which samples are inside, and removes the others.
    void decide();
    /// Hands a full list over.
    void hand_over();

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    simd::PointList* inside_ = nullptr;
    std::size_t at_once_ = 0;                   // of a full list
    const FunctionRef<void()>* use_ = nullptr;  // what the caller does with a full list
    std::optional<Ticket> side_;  // of B, at the current position on A's boundary; or unknown
    narrowphase::RayParities sides_;
    std::vector<Doubtful> doubtful_;
    narrowphase::CrossingFinder crossings_;
    std::vector<std::uint32_t> near_;  // edges of A
};

}  // namespace nearfield::solvers
