#pragma once

#include <nearfield/fill.hpp>
#include <nearfield/query.hpp>
#include <nearfield/result.hpp>
#include <nearfield/shape.hpp>

#include <optional>
#include <span>
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
    double tolerance = 0.0;  ///< 0 where none is given and none is needed
    Technique technique = Technique::automatic;
    PenetrationPoints points = PenetrationPoints::boundary;         ///< for penetration
    IntersectionKind kind = IntersectionKind::volume_volume;        ///< for intersection
    IntersectionStrategy strategy = IntersectionStrategy::stencil;  ///< for intersection
    bool records = true;  ///< for penetration, intersection and contacts
    /// For contacts (default: the tolerance) and time-of-impact (default: 0).
    std::optional<double> contact_distance;
    ContactNormals normals = ContactNormals::analytic;  ///< for contacts
    // These are for distance-field.
    std::optional<Rectangle> rectangle;
    SignEncoding sign = SignEncoding::stencil;
    GradientMethod gradient = GradientMethod::analytic;
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

/// The names of the command line and of scenes. Parsing throws InputError with a text that says
/// what there is to choose from; `what` says where the name stands ("--kind").
/// `others`: further names that the message lists.
[[nodiscard]] QueryType parse_query_type(const std::string& name, const std::string& what,
                                         std::span<const std::string_view> others = {});
[[nodiscard]] PenetrationPoints parse_points(const std::string& name, const std::string& what);
[[nodiscard]] IntersectionKind parse_kind(const std::string& name, const std::string& what);
[[nodiscard]] ContactNormals parse_normals(const std::string& name, const std::string& what);
[[nodiscard]] IntersectionStrategy parse_strategy(const std::string& name, const std::string& what);
[[nodiscard]] SignEncoding parse_sign(const std::string& name, const std::string& what);
[[nodiscard]] GradientMethod parse_gradient(const std::string& name, const std::string& what);
/// odd-even, nonzero, positive or union
[[nodiscard]] FillRule parse_fill_rule(const std::string& name, const std::string& what);
[[nodiscard]] FieldPicture parse_picture(const std::string& name, const std::string& what);
[[nodiscard]] std::string_view name_of(QueryType type) noexcept;
[[nodiscard]] std::string_view name_of(SignEncoding encoding) noexcept;
[[nodiscard]] std::string_view name_of(GradientMethod method) noexcept;
[[nodiscard]] std::string_view name_of(IntersectionKind kind) noexcept;
[[nodiscard]] std::string_view name_of(IntersectionStrategy strategy) noexcept;
[[nodiscard]] std::string_view name_of(FillRule rule) noexcept;
[[nodiscard]] std::string_view name_of(ImpactState state) noexcept;

[[nodiscard]] Technique parse_technique(const std::string& name, const std::string& what);

/// Adds a request between two instances to a batch. The request must outlive the batch's run. The
/// result has the same index among the results as the query in the batch.
void add_query(Batch& batch, const QueryRequest& request, const Instance& a, const Instance& b);

}  // namespace nearfield::tools
