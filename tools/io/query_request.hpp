#pragma once

#include <nearfield/fill.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>

#include <tools/io/json_document.hpp>
#include <tools/io/names.hpp>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::tools {

enum class QueryType {
    penetration,
    intersection,
    distance_field,
    contacts,
    closest_point,
    separation,
    intersection_test,
    time_of_impact,
    separation_vector,
    containment
};

/// The contents of a distance field's picture.
enum class FieldPicture { field, voronoi, gradient };

/// The options of one query from the command line or a scene: everything except its two shapes.
struct QueryRequest {
    QueryType type = QueryType::penetration;
    double tolerance = 0.0;              ///< 0 where none is given and none is needed
    std::optional<Technique> technique;  ///< see technique_of()
    PenetrationPoints points = PenetrationPoints::boundary;   ///< for penetration
    IntersectionKind kind = IntersectionKind::volume_volume;  ///< for intersection
    std::optional<IntersectionStrategy> strategy;             ///< for intersection
    bool records = true;  ///< for penetration, intersection and contacts
    /// For contacts (default: the tolerance) and time-of-impact (default: 0).
    std::optional<double> contact_distance;
    ContactNormals normals = ContactNormals::analytic;  ///< for contacts
    // These are for distance-field.
    std::optional<Rectangle> rectangle;
    std::optional<SignEncoding> sign;
    std::optional<GradientMethod> gradient;
    bool values = true;
    bool features = false;
    bool gradients = false;
    std::vector<Vector2> at;
    FieldPicture picture = FieldPicture::field;
    // These are for time-of-impact.
    std::optional<Pose> end_a;  ///< default: A stands still
    std::optional<Pose> end_b;
    double time_bound = 1.0;
    std::uint32_t max_steps = TimeOfImpactQuery().max_steps;
    std::uint64_t max_work = SeparationVectorQuery().max_work;  ///< for separation-vector
};

/// True for a query that the device may answer by sampling on a grid.
[[nodiscard]] constexpr bool is_sampled(QueryType type) {
    return type != QueryType::intersection_test && type != QueryType::time_of_impact &&
           type != QueryType::separation_vector && type != QueryType::containment;
}

/// True for a query that has a tolerance. Without, one given serves for curves alone.
[[nodiscard]] constexpr bool has_tolerance(QueryType type) {
    return type != QueryType::intersection_test && type != QueryType::containment;
}

/// True of a query whose answer does not depend on the tolerance, which need not be given.
[[nodiscard]] constexpr bool is_exact(QueryType type) {
    return !has_tolerance(type) || type == QueryType::separation ||
           type == QueryType::closest_point;
}

template <>
inline constexpr auto names<QueryType> = std::to_array<NamedValue<QueryType>>({
    {"penetration", QueryType::penetration},
    {"intersection", QueryType::intersection},
    {"distance-field", QueryType::distance_field},
    {"contacts", QueryType::contacts},
    {"closest-point", QueryType::closest_point},
    {"separation", QueryType::separation},
    {"intersection-test", QueryType::intersection_test},
    {"time-of-impact", QueryType::time_of_impact},
    {"separation-vector", QueryType::separation_vector},
    {"containment", QueryType::containment},
});
template <>
inline constexpr auto names<Technique> = std::to_array<NamedValue<Technique>>({
    {"automatic", Technique::automatic},
    {"raster", Technique::raster},
    {"compute", Technique::compute},
    {"cpu", Technique::cpu},
});
template <>
inline constexpr auto names<PenetrationPoints> = std::to_array<NamedValue<PenetrationPoints>>({
    {"boundary", PenetrationPoints::boundary},
    {"vertices", PenetrationPoints::vertices},
});
template <>
inline constexpr auto names<IntersectionKind> = std::to_array<NamedValue<IntersectionKind>>({
    {"boundary-boundary", IntersectionKind::boundary_boundary},
    {"boundary-volume", IntersectionKind::boundary_volume},
    {"volume-volume", IntersectionKind::volume_volume},
});
template <>
inline constexpr auto names<ContactNormals> = std::to_array<NamedValue<ContactNormals>>({
    {"analytic", ContactNormals::analytic},
    {"gradient", ContactNormals::gradient},
});
template <>
inline constexpr auto names<IntersectionStrategy> =
    std::to_array<NamedValue<IntersectionStrategy>>({
        {"stencil", IntersectionStrategy::stencil},
        {"blend", IntersectionStrategy::blend},
        {"logic-op", IntersectionStrategy::logic_op},
        {"depth", IntersectionStrategy::depth},
    });
template <>
inline constexpr auto names<SignEncoding> = std::to_array<NamedValue<SignEncoding>>({
    {"stencil", SignEncoding::stencil},
    {"color", SignEncoding::color},
    {"feature-bit", SignEncoding::feature_bit},
});
template <>
inline constexpr auto names<GradientMethod> = std::to_array<NamedValue<GradientMethod>>({
    {"analytic", GradientMethod::analytic},
    {"central-differences", GradientMethod::central_differences},
    {"blended", GradientMethod::blended},
});
template <>
inline constexpr auto names<FillRule> = std::to_array<NamedValue<FillRule>>({
    {"odd-even", FillRule::odd_even},
    {"nonzero", FillRule::nonzero},
    {"positive", FillRule::positive},
    {"union", FillRule::union_of_parts},
});
template <>
inline constexpr auto names<FieldPicture> = std::to_array<NamedValue<FieldPicture>>({
    {"field", FieldPicture::field},
    {"voronoi", FieldPicture::voronoi},
    {"gradient", FieldPicture::gradient},
});
template <>
inline constexpr auto names<ImpactState> = std::to_array<NamedValue<ImpactState>>({
    {"separated", ImpactState::separated},
    {"hit", ImpactState::hit},
    {"intersecting-at-start", ImpactState::intersecting_at_start},
    {"bound-not-reached", ImpactState::bound_not_reached},
});

/// The technique that is asked for; raster where none is, but a way of drawing.
[[nodiscard]] Technique technique_of(const QueryRequest& request) noexcept;

/// Adds a request between two instances to a batch. The request must outlive the batch's run. The
/// result has the same index among the results as the query in the batch.
void add_query(Batch& batch, const QueryRequest& request, const Instance& a, const Instance& b);

/// A member of a query besides its shapes and its tolerance: how scenes and the command line name
/// it, and how each sets it. Both throw InputError.
struct QueryMember {
    std::string key;   ///< in a scene; the option of the command line has dashes
    std::string form;  ///< of its value, in the help
    std::string help;
    /// Sets it from the text of an option; empty if only scenes have the member.
    std::function<void(QueryRequest&, const std::string& text, const std::string& option)> parse;
    std::function<void(QueryRequest&, const JsonPlace&)> read;
};

/// What the answer of a kind holds, in the order of the help.
[[nodiscard]] std::vector<QueryMember> answer_members(QueryType type);
/// How it is found. Scenes have `strategy` only in the kinds that are sampled.
[[nodiscard]] std::vector<QueryMember> technique_members(QueryType type);

/// Reads what a query of a scene between instances asks for: everything but its instances. Throws
/// InputError with the place, UnknownMember for a member that queries of its kind do not have.
[[nodiscard]] QueryRequest read_query_request(const JsonPlace& place);

}  // namespace nearfield::tools
