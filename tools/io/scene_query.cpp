#include <tools/io/json_members.hpp>
#include <tools/io/scene_query.hpp>
#include <tools/io/world_request.hpp>

#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

namespace nearfield::tools {
namespace {

void read_field_request(const JsonPlace& place, QueryRequest& request) {
    if (place.has("rect")) {
        request.rectangle = read_rectangle(place.member("rect"));
    }
    if (place.has("sign")) {
        request.sign = parse_member(place, "sign", parse_sign);
    }
    for (const auto& [key, asked] : {std::pair{"values", &QueryRequest::values},
                                     std::pair{"features", &QueryRequest::features},
                                     std::pair{"gradients", &QueryRequest::gradients}}) {
        if (place.has(key)) {
            request.*asked = place.member(key).boolean();
        }
    }
    if (place.has("at")) {
        const JsonPlace points = place.member("at");
        for (std::size_t i = 0; i < points.require_array().value().size(); ++i) {
            const std::vector<double> point = numbers(points.element(i), 2, "[x, y] (two numbers)");
            request.at.push_back({point[0], point[1]});
        }
    }
    if (place.has("gradient")) {
        request.gradient = parse_member(place, "gradient", parse_gradient);
        if (!request.gradients && request.at.empty()) {
            place.member("gradient").fail("there is no gradient asked for, by gradients or at");
        }
    }
}

void read_motion_request(const JsonPlace& place, QueryRequest& request) {
    if (place.has("time_bound")) {
        request.time_bound = read_above_zero(place.member("time_bound"));
    }
    if (place.has("most_steps")) {
        request.max_steps = read_count(place.member("most_steps"));
    }
}

/// The members that a query of a type may have.
std::vector<std::string_view> members_of(QueryType type) {
    std::vector<std::string_view> members{"query",     "a",         "b",        "pairs",
                                          "tolerance", "technique", "hits_only"};
    const auto add = [&members](std::initializer_list<std::string_view> more) {
        members.insert(members.end(), more);
    };
    if (is_sampled(type)) {
        add({"reach", "strategy", "records"});
    }
    switch (type) {
        case QueryType::penetration:
            add({"points"});
            break;
        case QueryType::intersection:
            add({"kind"});
            break;
        case QueryType::distance_field:
            add({"rect", "sign", "gradient", "gradients", "features", "values", "at"});
            break;
        case QueryType::contacts:
            add({"contact_distance", "normals"});
            break;
        case QueryType::time_of_impact:
            add({"contact_distance", "time_bound", "most_steps"});
            break;
        case QueryType::closest_point:
        case QueryType::separation:
        case QueryType::intersection_test:
        case QueryType::containment:
            break;
        case QueryType::separation_vector:
            add({"most_work"});
            break;
    }
    return members;
}

/// Reads the members that several types of query share.
void read_shared_members(const JsonPlace& place, QueryRequest& request) {
    if (!is_exact(request.type) || place.has("tolerance")) {
        request.tolerance = read_above_zero(place.member("tolerance"));
    }
    if (place.has("strategy")) {
        request.strategy = parse_member(place, "strategy", parse_strategy);
    }
    const bool names_a_way_of_drawing =
        (request.type == QueryType::intersection && place.has("strategy")) ||
        (request.type == QueryType::distance_field && place.has("sign"));
    if (place.has("technique")) {
        request.technique = parse_member(place, "technique", parse_technique);
    } else if (names_a_way_of_drawing) {
        request.technique = Technique::raster;
    }
    if (place.has("contact_distance")) {
        request.contact_distance = read_above_zero(place.member("contact_distance"));
    }
    if (place.has("records")) {
        request.records = place.member("records").boolean();
    }
}

}  // namespace

QueryRequest read_query_request(const JsonPlace& place) {
    QueryRequest request;
    request.type = parse_query_type(place.member("query").string(), place.member("query").text(),
                                    world_query_type_names());
    if (place.has("reach") && !(place.has("pairs") && request.type == QueryType::separation)) {
        place.member("reach").fail("belongs to the separation of all pairs");
    }
    if (place.has("hits_only") && !place.has("pairs")) {
        place.member("hits_only").fail("belongs to \"pairs\"");
    }
    require_known_members(place, members_of(request.type));
    read_shared_members(place, request);
    if (place.has("points")) {
        request.points = parse_member(place, "points", parse_points);
    }
    if (place.has("kind")) {
        request.kind = parse_member(place, "kind", parse_kind);
    }
    if (place.has("normals")) {
        request.normals = parse_member(place, "normals", parse_normals);
    }
    if (request.type == QueryType::distance_field) {
        read_field_request(place, request);
    }
    if (request.type == QueryType::time_of_impact) {
        read_motion_request(place, request);
    }
    if (place.has("most_work")) {
        request.max_work = read_count(place.member("most_work"));
    }
    return request;
}

}  // namespace nearfield::tools
