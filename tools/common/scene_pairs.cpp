// Which pairs of instances the queries of a scene ask about.

#include <nearfield/portable_math.hpp>

#include <tools/common/library_error.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/query_request.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace nearfield::tools {
namespace {

/// True if swapping A and B does not change the answer: then one order suffices.
bool is_symmetric(QueryType type) {
    return type == QueryType::separation || type == QueryType::intersection_test ||
           type == QueryType::time_of_impact || type == QueryType::separation_vector;
}

/// A box that contains a shape throughout its motion from its pose to its end pose, however its
/// vertices are rounded: shapes that touch but for rounding count as touching.
Rectangle swept_box(const SceneShape& shape, const SceneInstance& instance) {
    const Pose& start = instance.pose;
    const Pose end = instance.end_pose.value_or(start);
    constexpr double none = std::numeric_limits<double>::infinity();
    Rectangle box{{none, none}, {-none, -none}};
    double farthest = 0.0;   // vertex from the origin of the coordinates
    double magnitude = 0.0;  // of where this is
    const auto hold = [&box](Vector2 origin, Vector2 low, Vector2 high) {
        box.min = {std::min(box.min.x, origin.x + low.x), std::min(box.min.y, origin.y + low.y)};
        box.max = {std::max(box.max.x, origin.x + high.x), std::max(box.max.y, origin.y + high.y)};
    };
    for (const Ring& ring : shape.rings) {
        for (const Vector2 vertex : ring) {
            // A rotating shape stays within a circle about the origin of its coordinates.
            const double radius = std::hypot(vertex.x, vertex.y);
            const auto [sine, cosine] = sine_cosine(start.angle);
            const Vector2 arm{cosine * vertex.x - sine * vertex.y,
                              sine * vertex.x + cosine * vertex.y};
            const bool turns = start.angle != end.angle;
            const Vector2 low = turns ? Vector2{-radius, -radius} : arm;
            const Vector2 high = turns ? Vector2{radius, radius} : arm;
            hold(start.translation, low, high);
            hold(end.translation, low, high);
            farthest = std::max(farthest, radius);
        }
    }
    for (const Vector2& origin : {start.translation, end.translation}) {
        magnitude = std::max({magnitude, std::abs(origin.x), std::abs(origin.y)});
    }
    const double rounding = 64.0 * std::numeric_limits<double>::epsilon() * (magnitude + farthest);
    box.min = {box.min.x - rounding, box.min.y - rounding};
    box.max = {box.max.x + rounding, box.max.y + rounding};
    return box;
}

bool come_within(const Rectangle& a, const Rectangle& b, double reach) {
    return a.min.x - b.max.x <= reach && b.min.x - a.max.x <= reach && a.min.y - b.max.y <= reach &&
           b.min.y - a.max.y <= reach;
}

}  // namespace

/// The instances of two groups. Those of both may stand on either side of a pair.
PairSelection SceneRunner::select(const GroupPair& groups) const {
    std::map<std::size_t, unsigned> sides;
    for (const std::size_t instance : groups.first.instances) {
        sides[instance] |= 1U;
    }
    for (const std::size_t instance : groups.second.instances) {
        sides[instance] |= 2U;
    }
    PairSelection selection;
    std::vector<std::size_t> named;
    for (const auto& [instance, side] : sides) {
        named.push_back(instance);
        if (is_usable(instance)) {
            selection.sound.push_back(instance);
            selection.instances.push_back(instances_[instance]);
            selection.sides.push_back(side);
        }
    }
    selection.names_of_bad = names_of_bad(named);
    return selection;
}

/// The query of the pair it names, unless something is wrong with either.
void SceneRunner::add_pair(std::size_t query) {
    const SceneQuery& asked = scene_.queries[query];
    std::string reason;
    for (const std::size_t instance : {asked.a, asked.b}) {
        const std::string& of_instance = instance_problems_[instance];
        const std::string& problem =
            of_instance.empty() ? shape_problems_[scene_.instances[instance].shape] : of_instance;
        if (!problem.empty() && reason.find(problem) == std::string::npos) {
            reason += (reason.empty() ? "" : "; ") + problem;
        }
    }
    if (reason.empty()) {
        add(query, asked.a, asked.b);
    } else {
        refuse({.query = query, .a = asked.a, .b = asked.b, .is_dependent = true}, reason);
    }
}

/// Both orders of a pair, or the one whose first instance is of the first group, unless the groups
/// do not form this pair.
void SceneRunner::add_selected(std::size_t query, const PairSelection& among, InstancePair pair) {
    const unsigned side_a = among.sides[pair.first];
    const unsigned side_b = among.sides[pair.second];
    const bool is_forward = (side_a & 1U) != 0 && (side_b & 2U) != 0;
    const bool is_backward = (side_a & 2U) != 0 && (side_b & 1U) != 0;
    const std::size_t a = among.sound[pair.first];
    const std::size_t b = among.sound[pair.second];
    if (!is_forward && !is_backward) {
        return;
    }
    if (is_symmetric(scene_.queries[query].request.type)) {
        add(query, is_forward ? a : b, is_forward ? b : a);
    } else {
        add(query, a, b);
        add(query, b, a);
    }
}

void SceneRunner::add_moving_pairs(std::size_t query, const PairSelection& among) {
    const double reach = scene_.queries[query].request.contact_distance.value_or(0.0);
    std::vector<Rectangle> boxes;
    for (const std::size_t index : among.sound) {
        const SceneInstance& instance = scene_.instances[index];
        boxes.push_back(swept_box(scene_.shapes[instance.shape], instance));
    }
    for (std::uint32_t a = 0; a < boxes.size(); ++a) {
        for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
            if (come_within(boxes[a], boxes[b], reach)) {
                add_selected(query, among, {a, b});
            }
        }
    }
}

/// Those whose boxes come within the query's reach.
void SceneRunner::add_near_pairs(std::size_t query, const PairSelection& among) {
    const SceneQuery& all = scene_.queries[query];
    const QueryRequest& request = all.request;
    const double reach = request.type == QueryType::contacts
                             ? request.contact_distance.value_or(request.tolerance)
                             : all.reach;
    const auto pairs = context_.find_overlapping_boxes(among.instances, reach);
    if (!pairs.has_value() && bad_ == BadEntries::recorded) {
        refuse({query, Entry::all, Entry::all},
               place_of(query) + ": " + full_message(pairs.error()));
        return;
    }
    require(pairs.error(), file_);
    for (const InstancePair& pair : *pairs) {
        add_selected(query, among, pair);
    }
}

const PairSelection& SceneRunner::selection_of(std::size_t query) const {
    return scene_.queries[query].between ? between_.at(query) : all_;
}

void SceneRunner::add_all_pairs(std::size_t query) {
    const PairSelection& among = selection_of(query);
    if (tables_.contains(query)) {
        add_pending({.query = query, .a = Entry::all, .b = Entry::all, .is_table = true},
                    Technique::compute);
    } else if (scene_.queries[query].request.type == QueryType::time_of_impact) {
        add_moving_pairs(query, among);
    } else {
        add_near_pairs(query, among);
    }
    if (!among.names_of_bad.empty()) {
        refuse({.query = query, .a = Entry::all, .b = Entry::all, .is_dependent = true},
               "without the pairs of instances that cannot be used: " + among.names_of_bad);
    }
}

}  // namespace nearfield::tools
