#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/query/pair.hpp>
#include <tests/query/report.hpp>

/// \file
/// The laws that a result has to obey whatever the shapes: what the public headers promise, held
/// against the oracle. Each reports its violations as one test failure.

namespace nearfield::test {

/// Status, tolerance, bound, cell and the grids of regions.
void check_summary(Report& report, const ResultSummary& result, double tolerance);

/// The same where cells may be as large as `cell`.
void check_summary(Report& report, const ResultSummary& result, double tolerance, double cell);

/// As above for a search that is finished exactly, whose cells may be of any size; and
/// `intersects`.
void check_search_summary(Report& report, const ResultSummary& result, const PlacedPair& pair);

/// As above, and `intersects`.
void check_summary(Report& report, const ResultSummary& result, const PlacedPair& pair);

/// Records exact, in order and complete; the deepest right.
void check_penetration(const PlacedPair& pair, PenetrationPoints points,
                       const PenetrationResult& result);

/// Samples within the bound of both, and complete; the area right.
void check_intersection(const PlacedPair& pair, IntersectionKind kind,
                        const IntersectionResult& result);

/// Values within the bound, at every cell or, in a large field, at `most_cells` of them.
void check_field(const oracle::ShapeOracle& b, double tolerance, const DistanceFieldResult& result,
                 std::size_t most_cells = 20000);

/// The distance and both points exact, the rendered samples near enough, the flag where it must be.
void check_separation(const PlacedPair& pair, const SeparationResult& result);

/// A closest point is the separation's point of A.
void check_same(const SeparationResult& separation, const ClosestPointResult& closest);

/// Records exact and complete on both boundaries, normals pointing out of B, and a manifold that
/// stands for all of them.
void check_contacts(const PlacedPair& pair, double contact_distance, const ContactResult& result);

}  // namespace nearfield::test
