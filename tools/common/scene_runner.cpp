#include <tools/common/add_shape.hpp>
#include <tools/common/add_timings.hpp>
#include <tools/common/library_error.hpp>
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
