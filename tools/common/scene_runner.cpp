#include <nearfield/portable_math.hpp>

#include <tools/common/library.hpp>
#include <tools/common/scene_runner.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/query_request.hpp>
#include <tools/io/shape_rings.hpp>
#include <tools/io/world_request.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace nearfield::tools {

std::optional<Technique> parse_technique_option(const std::optional<std::string>& name) {
    return name ? std::optional(parse_name<Technique>(*name, "--technique")) : std::nullopt;
}

void set_technique(Scene& scene, std::optional<Technique> technique) {
    for (SceneQuery& query : scene.queries) {
        query.request.technique = technique ? technique : query.request.technique;
        if (query.world) {
            query.world->technique = technique.value_or(query.world->technique);
        }
    }
}

namespace {

/// A message of the library without the name of a query or an instance that stood alone: its place
/// in the scene is said instead.
std::string without_prefix(const std::string& message, std::string_view prefix) {
    return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

/// In place of a result: an error.
AnyResult refusal(const Status& status) {
    PenetrationResult result;
    result.status = status;
    return result;
}

}  // namespace

SceneRunner::SceneRunner(const Scene& scene, std::string file, Context& context, BadEntries bad)
    : scene_(scene), file_(std::move(file)), context_(context), bad_(bad) {
    add_shapes();
    add_instances();
    bool has_world_queries = false;
    for (std::size_t query = 0; query < scene_.queries.size(); ++query) {
        const SceneQuery& asked = scene_.queries[query];
        if (asked.problem.empty() && asked.between) {
            between_.emplace(query, select(*asked.between));
        }
        has_world_queries |= asked.problem.empty() && asked.world;
        if (asked.problem.empty() && is_for_device_pairs(asked)) {
            tables_.try_emplace(query, asked.request, context_, selection_of(query));
        }
    }
    if (has_world_queries) {
        worlds_.emplace(scene_, context_, shapes_, instances_, all_.sound);
    }
}

void SceneRunner::add_shapes() {
    for (const SceneShape& shape : scene_.shapes) {
        shapes_.emplace_back();
        shape_problems_.push_back(shape.problem);
        if (!shape.problem.empty()) {
            continue;
        }
        const Expected<ShapeHandle> handle = add_shape(context_, shape.rings, shape.deviation);
        if (handle.has_value()) {
            shapes_.back() = *handle;
        } else if (bad_ == BadEntries::recorded) {
            shape_problems_.back() = place_of(shape) + ": " + full_message(handle.error());
        } else {
            require(handle.error(), place_of(shape));
        }
    }
}

void SceneRunner::add_instances() {
    for (std::size_t index = 0; index < scene_.instances.size(); ++index) {
        const SceneInstance& instance = scene_.instances[index];
        // An instance with a problem may have no shape.
        const bool is_sound = instance.problem.empty();
        instances_.push_back(is_sound ? Instance{shapes_[instance.shape], instance.pose}
                                      : Instance{});
        std::string problem = instance.problem;
        if (problem.empty() && shape_problems_[instance.shape].empty() &&
            bad_ == BadEntries::recorded) {
            // The library says which poses can be used.
            const auto pairs = context_.find_overlapping_boxes({&instances_.back(), 1}, 0.0);
            if (!pairs.has_value()) {
                problem = file_ + ": instances." + instance.name + ": " +
                          without_prefix(full_message(pairs.error()),
                                         "find_overlapping_boxes: instance 0: ");
            }
        }
        instance_problems_.push_back(std::move(problem));
        if (is_usable(index)) {
            all_.sound.push_back(index);
            all_.instances.push_back(instances_.back());
        }
    }
    all_.sides.assign(all_.sound.size(), 3U);
    all_.names_of_bad = names_of_bad(all_instances());
}

SceneRunner::~SceneRunner() {
    for (const ShapeHandle shape : shapes_) {
        static_cast<void>(context_.remove_shape(shape));  // fails only for an unknown shape
    }
}

double SceneRunner::run_frame(FrameInput input) {
    if (input == FrameInput::poses) {
        move_instances();
    }
    const auto start = std::chrono::steady_clock::now();
    if (input == FrameInput::all) {
        update_shapes();
    }
    if (input != FrameInput::nothing) {
        add_queries();
    }
    require(context_.run(batch_, results_), file_);
    answer_pending({});
    const auto end = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(end - start).count();
}

void SceneRunner::run_what_fits(const Limits& limits) {
    update_shapes();
    add_queries();
    const Status status = context_.run(batch_, results_, limits);
    if (status.code() == StatusCode::too_large) {
        answer_one_by_one(limits);
    } else {
        require(status, file_);
    }
    answer_pending(limits);
}

void SceneRunner::update_shapes() {
    for (std::size_t index = 0; index < shapes_.size(); ++index) {
        const SceneShape& shape = scene_.shapes[index];
        if (shape_problems_[index].empty()) {
            require(context_.update_shape(shapes_[index], shape.rings, shape.deviation),
                    place_of(shape));
        }
    }
}

void SceneRunner::move_instances() {
    is_moved_ = !is_moved_;
    const auto pose_of = [this](std::size_t index) {
        Pose pose = scene_.instances[index].pose;
        const double towards_zero = pose.translation.x > 0.0
                                        ? -std::numeric_limits<double>::infinity()
                                        : std::numeric_limits<double>::infinity();
        if (is_moved_) {
            pose.translation.x = std::nextafter(pose.translation.x, towards_zero);
        }
        return pose;
    };
    const auto move = [&](PairSelection& selection) {
        for (std::size_t i = 0; i < selection.sound.size(); ++i) {
            selection.instances[i].pose = pose_of(selection.sound[i]);
        }
    };
    for (std::size_t index = 0; index < instances_.size(); ++index) {
        instances_[index].pose = pose_of(index);
    }
    move(all_);
    for (auto& [query, selection] : between_) {
        move(selection);
    }
}

void SceneRunner::add_queries() {
    batch_.clear();
    entries_.clear();
    outside_batch_.clear();
    for (std::size_t query = 0; query < scene_.queries.size(); ++query) {
        const SceneQuery& asked = scene_.queries[query];
        if (!asked.problem.empty()) {
            refuse({query, Entry::all, Entry::all}, asked.problem);
        } else if (asked.world) {
            add_world_query(query);
        } else if (asked.all_pairs) {
            add_all_pairs(query);
        } else {
            add_pair(query);
        }
    }
}

/// Results as the batch would have had them; a query that is too large by itself has that status.
void SceneRunner::answer_one_by_one(const Limits& limits) {
    Results all;
    for (const Entry& entry : entries_) {
        if (!is_of_batch(entry)) {
            continue;
        }
        Batch batch;
        Results one;
        batch.time_queries(batch_.times_queries());
        add_to(batch, entry);
        const Status status = context_.run(batch, one, limits);
        if (status.code() == StatusCode::too_large) {
            all.results.push_back(
                refusal({status.code(), without_prefix(full_message(status), "query 0 with ")}));
            all.timings.queries.resize(batch_.times_queries() ? all.results.size() : 0);
            continue;
        }
        require(status, place_of(entry.query));
        all.results.push_back(std::move(one.results.front()));
        add_timings(one.timings, all.timings);
    }
    results_ = std::move(all);
}

void SceneRunner::add_to(Batch& batch, const Entry& entry) const {
    const QueryRequest& request = scene_.queries[entry.query].request;
    const SceneInstance& a = scene_.instances[entry.a];
    const SceneInstance& b = scene_.instances[entry.b];
    const bool is_moving = request.type == QueryType::time_of_impact;
    const bool lacks_tolerance = request.tolerance == 0.0 && has_tolerance(request.type);
    if (!is_moving && !lacks_tolerance) {
        add_query(batch, request, instances_[entry.a], instances_[entry.b]);
        return;
    }
    // Neither has places of a field, which would have to outlive the batch's run.
    QueryRequest completed = request;
    if (is_moving) {
        completed.end_a = a.end_pose;
        completed.end_b = b.end_pose;
    }
    if (lacks_tolerance) {
        const SceneShape& shape_a = scene_.shapes[a.shape];
        const SceneShape& shape_b = scene_.shapes[b.shape];
        completed.tolerance =
            usual_tolerance({shape_a.rings, shape_a.deviation, a.pose.translation},
                            {shape_b.rings, shape_b.deviation, b.pose.translation});
    }
    add_query(batch, completed, instances_[entry.a], instances_[entry.b]);
}

void SceneRunner::add(std::size_t query, std::size_t a, std::size_t b) {
    entries_.push_back({query, a, b, batch_.queries().size()});
    add_to(batch_, entries_.back());
}

void SceneRunner::refuse(Entry entry, const std::string& reason) {
    entry.result = outside_batch_.size();
    entry.is_refused = true;
    outside_batch_.push_back(refusal({StatusCode::invalid_query, reason}));
    entries_.push_back(entry);
}

void SceneRunner::add_pending(Entry entry, Technique technique) {
    entry.result = outside_batch_.size();
    IntersectionTestResult pending;
    pending.technique = technique;
    outside_batch_.emplace_back(std::move(pending));
    entries_.push_back(entry);
}

void SceneRunner::add_world_query(std::size_t query) {
    const WorldRequest& request = *scene_.queries[query].world;
    const Entry nobody{.query = query, .a = Entry::all, .b = Entry::all};
    if (const std::string problem = technique_problem(request); !problem.empty()) {
        refuse(nobody, place_of(query) + ": " + problem);
        return;
    }
    if (request.shape && !shape_problems_[*request.shape].empty()) {
        Entry entry = nobody;
        entry.is_dependent = true;
        refuse(entry, shape_problems_[*request.shape]);
        return;
    }
    Entry entry = nobody;
    entry.is_world = true;
    add_pending(entry, answering_technique(request));
    std::vector<std::size_t> considered =
        request.against ? request.against->instances : all_instances();
    if (request.except) {
        std::erase(considered, *request.except);
    }
    if (const std::string names = names_of_bad(considered); !names.empty()) {
        entry = nobody;
        entry.is_dependent = true;
        refuse(entry, "without the instances that cannot be used: " + names);
    }
}

void SceneRunner::answer_pending(const Limits& limits) {
    if (!worlds_ && tables_.empty()) {
        return;
    }
    const auto start = std::chrono::steady_clock::now();
    Timings& timings = results_.timings;
    const double before = timings.total;
    for (const Entry& entry : entries_) {
        if (!entry.is_world && !entry.is_table) {
            continue;
        }
        const Status status =
            entry.is_world ? worlds_->answer(entry.query, limits, timings)
                           : tables_.at(entry.query)
                                 .answer(selection_of(entry.query).instances, limits, timings);
        std::visit([&status](auto& result) { result.status = status; },
                   outside_batch_[entry.result]);
    }
    const auto end = std::chrono::steady_clock::now();
    timings.total = before + std::chrono::duration<double, std::milli>(end - start).count();
}

bool SceneRunner::is_usable(std::size_t instance) const {
    return instance_problems_[instance].empty() &&
           shape_problems_[scene_.instances[instance].shape].empty();
}

std::vector<std::size_t> SceneRunner::all_instances() const {
    std::vector<std::size_t> instances(scene_.instances.size());
    std::iota(instances.begin(), instances.end(), std::size_t{0});
    return instances;
}

std::string SceneRunner::names_of_bad(const std::vector<std::size_t>& instances) const {
    std::string names;
    for (const std::size_t index : instances) {
        if (is_usable(index)) {
            continue;
        }
        const SceneInstance& instance = scene_.instances[index];
        names += (names.empty() ? "" : ", ") + instance.name;
        if (instance_problems_[index].empty()) {
            names += " (shapes." + scene_.shapes[instance.shape].name + ")";
        }
    }
    return names;
}

std::string SceneRunner::place_of(const SceneShape& shape) const {
    return file_ + ": shapes." + shape.name;
}

std::string SceneRunner::place_of(std::size_t query) const {
    return file_ + ": queries[" + std::to_string(query) + "]";
}

}  // namespace nearfield::tools

// Which pairs of instances the queries of a scene ask about.

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

// What a SceneRunner tells of its last frame.

namespace nearfield::tools {

std::size_t SceneRunner::pair_count() const {
    std::size_t count = batch_.queries().size();
    for (const auto& [query, table] : tables_) {
        count += table.pair_count();
    }
    return count;
}

std::size_t SceneRunner::world_input_count() const {
    std::size_t count = 0;
    for (const Entry& entry : entries_) {
        count += entry.is_world ? scene_.queries[entry.query].world->size() : 0;
    }
    return count;
}

/// Calls `action(entry, status)` for each entry, and for each row of a table that is an error.
template <class Action>
void SceneRunner::for_each_status(const Action& action) const {
    for (const Entry& entry : entries_) {
        action(entry, summary_of(result_of(entry)).status);
        if (!entry.is_table) {
            continue;
        }
        for (const DevicePairRunner::Row& row : tables_.at(entry.query).rows()) {
            const Status& status = summary_of(row.result).status;
            if (!status.ok()) {
                action(entry, status);
            }
        }
    }
}

void SceneRunner::require_results() const {
    for_each_status([this](const Entry& entry, const Status& status) {
        require(status, place_of(entry.query));
    });
}

std::vector<Status> SceneRunner::problems() const {
    std::vector<Status> problems;
    for (const SceneGroup& group : scene_.groups) {
        if (!group.problem.empty()) {
            problems.emplace_back(StatusCode::invalid_query, group.problem);
        }
    }
    for (const std::vector<std::string>* const of : {&shape_problems_, &instance_problems_}) {
        for (const std::string& problem : *of) {
            if (!problem.empty()) {
                problems.emplace_back(StatusCode::invalid_shape, problem);
            }
        }
    }
    for_each_status([&](const Entry& entry, const Status& status) {
        if (entry.is_refused && !entry.is_dependent) {
            problems.push_back(status);
        } else if (!entry.is_refused && !status.ok() && status.code() != StatusCode::cancelled) {
            problems.emplace_back(status.code(), place_of(entry.query) + ": " + status.text());
        }
    });
    return problems;
}

std::size_t SceneRunner::dependent_count() const {
    return static_cast<std::size_t>(std::count_if(
        entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.is_dependent; }));
}

std::size_t SceneRunner::cancelled_count() const {
    return static_cast<std::size_t>(
        std::count_if(entries_.begin(), entries_.end(), [this](const Entry& entry) {
            return summary_of(result_of(entry)).status.code() == StatusCode::cancelled;
        }));
}

const AnyResult& SceneRunner::result_of(const Entry& entry) const {
    return is_of_batch(entry) ? results_.results[entry.result] : outside_batch_[entry.result];
}

const QueryTime* SceneRunner::time_of(const Entry& entry) const {
    const bool is_timed = batch_.times_queries() && is_of_batch(entry);
    return is_timed ? &results_.timings.queries[entry.result] : nullptr;
}

SceneAnswer SceneRunner::answer_of(const Entry& entry) const {
    const SceneQuery& query = scene_.queries[entry.query];
    const AnyResult& result = result_of(entry);
    const bool is_answered_world = entry.is_world && summary_of(result).status.ok();
    const bool has_pair = entry.a != Entry::all;
    return {query.request,
            has_pair ? scene_.instances[entry.a].name : query.name_a,
            has_pair ? scene_.instances[entry.b].name : query.name_b,
            result,
            query.kind,
            is_answered_world ? &worlds_->answer_of(entry.query) : nullptr,
            time_of(entry)};
}

std::vector<SceneAnswer> SceneRunner::answers() const {
    std::vector<SceneAnswer> answers;
    const auto append = [&](const SceneQuery& query, const SceneAnswer& answer) {
        // Boxes within reach of each other may hold shapes that are not.
        const auto* const separation = std::get_if<SeparationResult>(&answer.result);
        const bool is_far = separation != nullptr && separation->distance > query.reach;
        const bool is_left_out =
            query.hits_only && summary_of(answer.result).status.ok() && !is_hit(answer.result);
        if (!(query.all_pairs && is_far) && !is_left_out) {
            answers.push_back(answer);
        }
    };
    for (const Entry& entry : entries_) {
        const SceneQuery& query = scene_.queries[entry.query];
        if (!entry.is_table || !summary_of(result_of(entry)).status.ok()) {
            append(query, answer_of(entry));
            continue;
        }
        for (const DevicePairRunner::Row& row : tables_.at(entry.query).rows()) {
            append(query, {query.request, scene_.instances[row.a].name,
                           scene_.instances[row.b].name, row.result, query.kind});
        }
    }
    return answers;
}

std::string_view SceneRunner::technique() const {
    std::optional<Technique> first;
    for (const Entry& entry : entries_) {
        const ResultSummary& summary = summary_of(result_of(entry));
        if (!summary.status.ok()) {
            continue;
        }
        if (first && *first != summary.technique) {
            return "mixed";
        }
        first = summary.technique;
    }
    return first ? to_string(*first) : "none";
}

}  // namespace nearfield::tools
