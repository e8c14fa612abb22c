#pragma once

#include <nearfield/nearfield.hpp>

#include <tests/oracle/shape_oracle.hpp>
#include <tests/query/pair.hpp>
#include <tests/query/report.hpp>

/// \file
/// How far the answers of two drivers to one query may be apart: what the public headers promise of
/// each, taken together.

namespace nearfield::test {

/// The grids to whose lines two drivers snap vertices (subPixelPrecisionBits).
enum class SubPixelGrids {
    same,   ///< both drivers were given the same plan: cells, tiles and snapped vertices
    apart,  ///< their own: cells of intersections and simplification differ
};

[[nodiscard]] bool same_feature(const Feature& one, const Feature& other);

/// A feature that was named as the nearest one to a point.
struct NamedFeature {
    Feature feature;
    Vector2 nearest;  ///< the place on it
    double distance = 0.0;
    bool unique = true;
};

/// What may be named of a shape, where distances that differ by less than a margin count as equal.
struct Naming {
    const oracle::ShapeOracle& shape;
    double margin = 0.0;
    double rounding = 0.0;

    /// Whether both may be named of the point: one feature, with all that follows from it; or one
    /// of several, and both say so; or places that close on the same wall. Only one may say that
    /// its feature is the only one where the margin, taken a tenth wider, holds another.
    [[nodiscard]] bool allows(const Vector2& point, const NamedFeature& one,
                              const NamedFeature& other) const;

private:
    [[nodiscard]] bool has_rival(const Vector2& point, const NamedFeature& named) const;
    /// How far apart two places on a straight wall can be that are as near.
    [[nodiscard]] double along_wall(double distance) const;
};

/// What both drivers were asked.
struct Asked {
    const PlacedPair& pair;  ///< whose shapes the query is about
    const AnyQuery& query;
    SubPixelGrids grids = SubPixelGrids::same;
};

/// Results of the query, which has to be answered. Each difference beyond what is promised is a
/// test failure.
void check_agreement(const Asked& asked, const AnyResult& one, const AnyResult& other);

// Its parts, a kind of result each.

void check_agreement(Report& report, const Asked& asked, const PenetrationResult& one,
                     const PenetrationResult& other);
void check_agreement(Report& report, const Asked& asked, const ContactResult& one,
                     const ContactResult& other);
void check_agreement(Report& report, const Asked& asked, const DistanceFieldResult& one,
                     const DistanceFieldResult& other);

}  // namespace nearfield::test
