#include <tools/io/input_error.hpp>
#include <tools/io/query_request.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace nearfield::tools {
namespace {

template <class Value>
using Named = std::pair<std::string_view, Value>;

constexpr std::array<Named<QueryType>, 10> query_types{{
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
}};
constexpr std::array<Named<Technique>, 4> techniques{{
    {"automatic", Technique::automatic},
    {"raster", Technique::raster},
    {"compute", Technique::compute},
    {"cpu", Technique::cpu},
}};
constexpr std::array<Named<PenetrationPoints>, 2> points_names{{
    {"boundary", PenetrationPoints::boundary},
    {"vertices", PenetrationPoints::vertices},
}};
constexpr std::array<Named<IntersectionKind>, 3> kinds{{
    {"boundary-boundary", IntersectionKind::boundary_boundary},
    {"boundary-volume", IntersectionKind::boundary_volume},
    {"volume-volume", IntersectionKind::volume_volume},
}};
constexpr std::array<Named<ContactNormals>, 2> normals_names{{
    {"analytic", ContactNormals::analytic},
    {"gradient", ContactNormals::gradient},
}};

constexpr std::array<Named<IntersectionStrategy>, intersection_strategies> strategies{{
    {"stencil", IntersectionStrategy::stencil},
    {"blend", IntersectionStrategy::blend},
    {"logic-op", IntersectionStrategy::logic_op},
    {"depth", IntersectionStrategy::depth},
}};

constexpr std::array<Named<SignEncoding>, 3> encodings{{
    {"stencil", SignEncoding::stencil},
    {"color", SignEncoding::color},
    {"feature-bit", SignEncoding::feature_bit},
}};
constexpr std::array<Named<GradientMethod>, 3> gradient_methods{{
    {"analytic", GradientMethod::analytic},
    {"central-differences", GradientMethod::central_differences},
    {"blended", GradientMethod::blended},
}};
constexpr std::array<Named<FillRule>, 4> fill_rules{{
    {"odd-even", FillRule::odd_even},
    {"nonzero", FillRule::nonzero},
    {"positive", FillRule::positive},
    {"union", FillRule::union_of_parts},
}};
constexpr std::array<Named<FieldPicture>, 3> pictures{{
    {"field", FieldPicture::field},
    {"voronoi", FieldPicture::voronoi},
    {"gradient", FieldPicture::gradient},
}};

constexpr std::array<Named<ImpactState>, 4> states{{
    {"separated", ImpactState::separated},
    {"hit", ImpactState::hit},
    {"intersecting-at-start", ImpactState::intersecting_at_start},
    {"bound-not-reached", ImpactState::bound_not_reached},
}};

template <class Value>
Value parse_name(std::span<const Named<Value>> table, const std::string& name,
                 const std::string& what, std::span<const std::string_view> others = {}) {
    std::string choices;
    for (const auto& [text, value] : table) {
        if (text == name) {
            return value;
        }
        choices += (choices.empty() ? "" : ", ") + std::string(text);
    }
    for (const std::string_view other : others) {
        choices += ", " + std::string(other);
    }
    throw InputError(what + ": \"" + name + "\" is none of " + choices);
}

template <class Value>
std::string_view find_name(std::span<const Named<Value>> table, Value value) noexcept {
    return std::find_if(table.begin(), table.end(),
                        [value](const Named<Value>& entry) { return entry.second == value; })
        ->first;
}

}  // namespace

QueryType parse_query_type(const std::string& name, const std::string& what,
                           std::span<const std::string_view> others) {
    return parse_name<QueryType>(query_types, name, what, others);
}

PenetrationPoints parse_points(const std::string& name, const std::string& what) {
    return parse_name<PenetrationPoints>(points_names, name, what);
}

IntersectionKind parse_kind(const std::string& name, const std::string& what) {
    return parse_name<IntersectionKind>(kinds, name, what);
}

ContactNormals parse_normals(const std::string& name, const std::string& what) {
    return parse_name<ContactNormals>(normals_names, name, what);
}

IntersectionStrategy parse_strategy(const std::string& name, const std::string& what) {
    return parse_name<IntersectionStrategy>(strategies, name, what);
}

SignEncoding parse_sign(const std::string& name, const std::string& what) {
    return parse_name<SignEncoding>(encodings, name, what);
}

FillRule parse_fill_rule(const std::string& name, const std::string& what) {
    return parse_name<FillRule>(fill_rules, name, what);
}

GradientMethod parse_gradient(const std::string& name, const std::string& what) {
    return parse_name<GradientMethod>(gradient_methods, name, what);
}

FieldPicture parse_picture(const std::string& name, const std::string& what) {
    return parse_name<FieldPicture>(pictures, name, what);
}

std::string_view name_of(SignEncoding encoding) noexcept {
    return find_name<SignEncoding>(encodings, encoding);
}

std::string_view name_of(GradientMethod method) noexcept {
    return find_name<GradientMethod>(gradient_methods, method);
}

std::string_view name_of(QueryType type) noexcept {
    return find_name<QueryType>(query_types, type);
}

std::string_view name_of(IntersectionKind kind) noexcept {
    return find_name<IntersectionKind>(kinds, kind);
}

std::string_view name_of(IntersectionStrategy strategy) noexcept {
    return find_name<IntersectionStrategy>(strategies, strategy);
}

std::string_view name_of(FillRule rule) noexcept {
    return find_name<FillRule>(fill_rules, rule);
}

std::string_view name_of(ImpactState state) noexcept {
    return find_name<ImpactState>(states, state);
}

Technique parse_technique(const std::string& name, const std::string& what) {
    return parse_name<Technique>(techniques, name, what);
}

void add_query(Batch& batch, const QueryRequest& request, const Instance& a, const Instance& b) {
    switch (request.type) {
        case QueryType::penetration:
            batch.add(PenetrationQuery{a, b, request.tolerance, request.points, !request.records,
                                       request.technique});
            break;
        case QueryType::intersection:
            batch.add(IntersectionQuery{a, b, request.tolerance, request.kind, !request.records,
                                        request.strategy, request.technique});
            break;
        case QueryType::distance_field:
            batch.add(DistanceFieldQuery{a, b, request.tolerance, request.rectangle, request.sign,
                                         request.gradient, request.values, request.features,
                                         request.gradients, request.at, request.technique});
            break;
        case QueryType::contacts:
            batch.add(ContactQuery{a, b, request.tolerance,
                                   request.contact_distance.value_or(request.tolerance),
                                   request.normals, !request.records, request.technique});
            break;
        case QueryType::closest_point:
            batch.add(ClosestPointQuery{a, b, request.tolerance, request.technique});
            break;
        case QueryType::separation:
            batch.add(SeparationQuery{a, b, request.tolerance, request.technique});
            break;
        case QueryType::intersection_test:
            batch.add(IntersectionTestQuery{a, b, request.technique});
            break;
        case QueryType::containment:
            batch.add(ContainmentQuery{a, b, request.technique});
            break;
        case QueryType::separation_vector:
            batch.add(SeparationVectorQuery{a, b, request.tolerance, request.max_work,
                                            request.technique});
            break;
        case QueryType::time_of_impact:
            batch.add(TimeOfImpactQuery{a, b, request.end_a.value_or(a.pose),
                                        request.end_b.value_or(b.pose), request.tolerance,
                                        request.time_bound, request.max_steps,
                                        request.contact_distance.value_or(0.0), request.technique});
            break;
    }
}

}  // namespace nearfield::tools
