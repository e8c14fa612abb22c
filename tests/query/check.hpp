#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/query/pair.hpp>
#include <tests/query/report.hpp>

/// \file Properties that a result must have for any shapes: the guarantees of the public headers,
/// checked against the oracle. Each function reports its violations as one test failure.

namespace nearfield::test {

/// Checks status, tolerance, bound, cell and the grids of regions.
void check_summary(Report& report, const ResultSummary& result, double tolerance);

/// The same if cells may be as large as `cell`.
void check_summary(Report& report, const ResultSummary& result, double tolerance, double cell);

/// The same for a search that ends with an exact computation, whose cells may have any size; also
/// checks `intersects`.
void check_search_summary(Report& report, const ResultSummary& result, const PlacedPair& pair);

/// The same, and `intersects`.
void check_summary(Report& report, const ResultSummary& result, const PlacedPair& pair);

/// Records must be exact, in order and complete; the deepest one must be correct.
void check_penetration(const PlacedPair& pair, PenetrationPoints points,
                       const PenetrationResult& result);

/// Samples must be complete and within the bound of both shapes; the area must be correct.
void check_intersection(const PlacedPair& pair, IntersectionKind kind,
                        const IntersectionResult& result);

/// Values must be within the bound, at every cell or, in a large field, at `max_cells` of them.
void check_field(const oracle::ShapeOracle& b, double tolerance, const DistanceFieldResult& result,
                 std::size_t max_cells = 20000);

/// The distance and both points must be exact, the rendered samples near enough, and the flag set
/// where required.
void check_separation(const PlacedPair& pair, const SeparationResult& result);

/// A closest point must equal the separation's point of A.
void check_same(const SeparationResult& separation, const ClosestPointResult& closest);

/// Records must be exact and complete on both boundaries, normals must point out of B, and the
/// manifold must represent all of them.
void check_contacts(const PlacedPair& pair, double contact_distance, const ContactResult& result);

}  // namespace nearfield::test
