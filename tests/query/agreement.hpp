#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/oracle/shape_oracle.hpp>
#include <tests/query/pair.hpp>
#include <tests/query/report.hpp>

/// \file The maximum difference between the answers of two drivers, or two techniques, to one
/// query, from the guarantees in the public headers.

namespace nearfield::test {

/// The sub-pixel grids to which two drivers snap vertices (subPixelPrecisionBits).
enum class SubPixelGrids {
    same,   ///< both drivers have the same plan: cells, tiles and snapped vertices
    apart,  ///< different plans: cells of intersections and simplification differ
};

[[nodiscard]] bool same_feature(const Feature& one, const Feature& other);

/// A feature reported as the nearest one to a point.
struct NamedFeature {
    Feature feature;
    Vector2 nearest;  ///< the nearest point on it
    double distance = 0.0;
    bool unique = true;
};

/// The features of a shape that may be reported as nearest, if distances that differ by less than a
/// margin count as equal.
struct Naming {
    const oracle::ShapeOracle& shape;
    double margin = 0.0;
    double rounding = 0.0;

    /// True if both may be reported for the point: the same feature, with everything that follows
    /// from it; or one of several, with both flagged as not unique; or nearby points on the same
    /// wall. Only one may claim to be unique, if another feature is within the margin enlarged by a
    /// tenth.
    [[nodiscard]] bool allows(const Vector2& point, const NamedFeature& one,
                              const NamedFeature& other) const;

private:
    [[nodiscard]] bool has_rival(const Vector2& point, const NamedFeature& named) const;
    /// The maximum distance of two points on a straight wall that are about equally near.
    [[nodiscard]] double along_wall(double distance) const;
};

/// The query for both drivers.
struct Asked {
    const PlacedPair& pair;  ///< the pair of shapes in the query
    const AnyQuery& query;
    SubPixelGrids grids = SubPixelGrids::same;
    /// Most records must be equal, up to rounding. False for shapes with many features that are
    /// almost equally near.
    bool mostly_equal = true;
};

/// Compares results of the query, which must be answered. Each difference beyond the guarantees is
/// a test failure.
void check_agreement(const Asked& asked, const AnyResult& one, const AnyResult& other);

/// Another answer with the technique and the regions of the one that was found, for a comparison of
/// two techniques.
[[nodiscard]] AnyResult by_technique_of(const AnyResult& found, AnyResult other);

// One function per kind of result.

void check_agreement(Report& report, const Asked& asked, const PenetrationResult& one,
                     const PenetrationResult& other);
void check_agreement(Report& report, const Asked& asked, const ContactResult& one,
                     const ContactResult& other);
void check_agreement(Report& report, const Asked& asked, const DistanceFieldResult& one,
                     const DistanceFieldResult& other);
void check_agreement(Report& report, const Asked& asked, const IntersectionResult& one,
                     const IntersectionResult& other);
void check_agreement(Report& report, const Asked& asked, const ClosestPointResult& one,
                     const ClosestPointResult& other);
void check_agreement(Report& report, const Asked& asked, const SeparationResult& one,
                     const SeparationResult& other);

}  // namespace nearfield::test
