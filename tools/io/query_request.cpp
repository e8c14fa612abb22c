#include <tools/io/json_document.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/values.hpp>
#include <tools/io/world_request.hpp>

#include <cstddef>
#include <string_view>
#include <utility>

namespace nearfield::tools {

Technique technique_of(const QueryRequest& request) noexcept {
    const bool names_a_way_of_drawing =
        (request.type == QueryType::intersection && request.strategy) ||
        (request.type == QueryType::distance_field && request.sign);
    return request.technique.value_or(names_a_way_of_drawing ? Technique::raster
                                                             : Technique::automatic);
}

void add_query(Batch& batch, const QueryRequest& request, const Instance& a, const Instance& b) {
    const Technique technique = technique_of(request);
    switch (request.type) {
        case QueryType::penetration:
            batch.add(PenetrationQuery{a, b, request.tolerance, request.points, !request.records,
                                       technique});
            break;
        case QueryType::intersection:
            batch.add(IntersectionQuery{a, b, request.tolerance, request.kind, !request.records,
                                        request.strategy.value_or(IntersectionStrategy::stencil),
                                        technique});
            break;
        case QueryType::distance_field:
            batch.add(DistanceFieldQuery{a, b, request.tolerance, request.rectangle,
                                         request.sign.value_or(SignEncoding::stencil),
                                         request.gradient.value_or(GradientMethod::analytic),
                                         request.values, request.features, request.gradients,
                                         request.at, technique});
            break;
        case QueryType::contacts:
            batch.add(ContactQuery{a, b, request.tolerance,
                                   request.contact_distance.value_or(request.tolerance),
                                   request.normals, !request.records, technique});
            break;
        case QueryType::closest_point:
            batch.add(ClosestPointQuery{a, b, request.tolerance, technique});
            break;
        case QueryType::separation:
            batch.add(SeparationQuery{a, b, request.tolerance, technique});
            break;
        case QueryType::intersection_test:
            batch.add(IntersectionTestQuery{a, b, technique});
            break;
        case QueryType::containment:
            batch.add(ContainmentQuery{a, b, technique});
            break;
        case QueryType::separation_vector:
            batch.add(SeparationVectorQuery{a, b, request.tolerance, request.max_work, technique});
            break;
        case QueryType::time_of_impact:
            batch.add(TimeOfImpactQuery{a, b, request.end_a.value_or(a.pose),
                                        request.end_b.value_or(b.pose), request.tolerance,
                                        request.time_bound, request.max_steps,
                                        request.contact_distance.value_or(0.0), technique});
            break;
    }
}

namespace {

constexpr CountRange limits{1, 1'000'000'000};

template <class Value, class Target>
QueryMember named(const char* key, Target QueryRequest::*target, const char* help) {
    return {key, "NAME", help,
            [target](QueryRequest& request, const std::string& text, const std::string& option) {
                request.*target = parse_name<Value>(text, option);
            },
            [target](QueryRequest& request, const JsonPlace& place) {
                request.*target = read_name<Value>(place);
            }};
}

/// A number greater than 0.
template <class Target>
QueryMember positive(const char* key, const char* form, Target QueryRequest::*target,
                     const char* help) {
    return {key, form, help,
            [target](QueryRequest& request, const std::string& text, const std::string& option) {
                request.*target = parse_positive(text, option);
            },
            [target](QueryRequest& request, const JsonPlace& place) {
                request.*target = read_above_zero(place);
            }};
}

template <class Target>
QueryMember limit(const char* key, Target QueryRequest::*target, const std::string& help) {
    return {key, "N",
            help + "; " + std::to_string(limits.min) + " to " + std::to_string(limits.max),
            [target](QueryRequest& request, const std::string& text, const std::string& option) {
                request.*target = parse_count(text, option, limits);
            },
            [target](QueryRequest& request, const JsonPlace& place) {
                request.*target = read_count(place);
            }};
}

/// Whether something is part of the answer: on the command line the files say it.
QueryMember part(const char* key, bool QueryRequest::*target) {
    return {key, {}, {}, {}, [target](QueryRequest& request, const JsonPlace& place) {
                request.*target = place.boolean();
            }};
}

void read_points(QueryRequest& request, const JsonPlace& points) {
    for (std::size_t i = 0; i < points.require_array().value().size(); ++i) {
        const std::vector<double> point = numbers(points.element(i), 2, "[x, y] (two numbers)");
        request.at.push_back({point[0], point[1]});
    }
}

std::vector<QueryMember> field_members() {
    return {
        {"rect", "X0,Y0,X1,Y1",
         "Extent of the grid, world units; default the common box of A and B grown by the "
         "tolerance",
         [](QueryRequest& request, const std::string& text, const std::string& option) {
             request.rectangle = parse_rectangle(text, option);
         },
         [](QueryRequest& request, const JsonPlace& place) {
             request.rectangle = read_rectangle(place);
         }},
        named<GradientMethod>(
            "gradient", &QueryRequest::gradient,
            "Method of the gradients: analytic (from the nearest feature), central-differences, or "
            "blended (the whole image on the device, technique raster alone); default analytic"),
        part("values", &QueryRequest::values),
        part("features", &QueryRequest::features),
        part("gradients", &QueryRequest::gradients),
        // An option of the command line for each point.
        {"at", {}, {}, {}, read_points}};
}

}  // namespace

std::vector<QueryMember> answer_members(QueryType type) {
    std::vector<QueryMember> members;
    switch (type) {
        case QueryType::penetration:
            members = {named<PenetrationPoints>(
                "points", &QueryRequest::points,
                "boundary (samples along A's boundary, no gap wider than a grid cell) or vertices "
                "(A's own); default boundary")};
            break;
        case QueryType::intersection:
            members = {
                named<IntersectionKind>("kind", &QueryRequest::kind,
                                        "boundary-boundary, boundary-volume or volume-volume (of A "
                                        "and of B); default volume-volume")};
            break;
        case QueryType::distance_field:
            members = field_members();
            break;
        case QueryType::contacts:
            members = {
                positive("contact_distance", "D", &QueryRequest::contact_distance,
                         "Distance that counts as contact, world units, > 0; default the "
                         "tolerance"),
                named<ContactNormals>("normals", &QueryRequest::normals,
                                      "Source of the normals: analytic (the nearest feature) or "
                                      "gradient (differences of the signed field); default "
                                      "analytic")};
            break;
        case QueryType::time_of_impact:
            members = {
                positive("contact_distance", "D", &QueryRequest::contact_distance,
                         "Distance that counts as touching, world units, > 0; default 0: the "
                         "shapes share a point"),
                positive("time_bound", "T", &QueryRequest::time_bound,
                         "Longest interval of time left open, > 0 and at most 1; the tolerance may "
                         "demand a shorter one; default 1"),
                limit("most_steps", &QueryRequest::max_steps,
                      "Limit of evaluations of the shapes; an answer that needs more says so; "
                      "default 10000")};
            break;
        case QueryType::separation_vector:
            members = {limit("most_work", &QueryRequest::max_work,
                             "Limit of edge tests; lower_bound states what the search left open; "
                             "default 10000000")};
            break;
        case QueryType::closest_point:
        case QueryType::separation:
        case QueryType::intersection_test:
        case QueryType::containment:
            break;
    }
    if (is_sampled(type)) {
        members.push_back(part("records", &QueryRequest::records));
    }
    return members;
}

std::vector<QueryMember> technique_members(QueryType type) {
    std::vector<QueryMember> members{
        named<Technique>("technique", &QueryRequest::technique,
                         is_sampled(type)
                             ? "raster, compute, cpu or automatic; default automatic: cpu, and on "
                               "a GPU compute for large fields"
                             : "cpu or automatic, which are the same here: the CPU alone answers; "
                               "default automatic"),
        named<IntersectionStrategy>(
            "strategy", &QueryRequest::strategy,
            "The buffer that finds the samples: stencil, blend, logic-op or depth; all find the "
            "same; nearfield info says which the device has; default stencil; naming one asks for "
            "the raster")};
    if (type == QueryType::distance_field) {
        members.push_back(named<SignEncoding>(
            "sign", &QueryRequest::sign,
            "The buffer that says what lies inside: stencil, color (set to white) or feature-bit "
            "(the top bit of the feature id); default stencil; naming one asks for the raster"));
    }
    return members;
}

QueryRequest read_query_request(const JsonPlace& place) {
    QueryRequest request;
    const JsonPlace kind = place.member("query");
    request.type = parse_name_or<QueryType>(world_query_type_names(), kind.string(), kind.text());
    if (place.has("reach") && !(place.has("pairs") && request.type == QueryType::separation)) {
        place.member("reach").fail("belongs to the separation of all pairs");
    }
    if (place.has("hits_only") && !place.has("pairs")) {
        place.member("hits_only").fail("belongs to \"pairs\"");
    }
    std::vector<std::string_view> known{"query", "a", "b", "pairs", "tolerance", "hits_only"};
    std::vector<QueryMember> members = technique_members(request.type);
    if (is_sampled(request.type)) {
        known.emplace_back("reach");
    } else {
        std::erase_if(members, [](const QueryMember& any) { return any.key == "strategy"; });
    }
    for (QueryMember& member : answer_members(request.type)) {
        members.push_back(std::move(member));
    }
    for (const QueryMember& member : members) {
        known.push_back(member.key);
    }
    require_known_members(place, known);
    if (!is_exact(request.type) || place.has("tolerance")) {
        request.tolerance = read_above_zero(place.member("tolerance"));
    }
    for (const QueryMember& member : members) {
        if (place.has(member.key)) {
            member.read(request, place.member(member.key));
        }
    }
    if (request.gradient && !request.gradients && request.at.empty()) {
        place.member("gradient").fail("there is no gradient asked for, by gradients or at");
    }
    return request;
}

}  // namespace nearfield::tools
