// What a SceneRunner tells of its last frame.

#include <tools/common/library_error.hpp>
#include <tools/common/scene_runner.hpp>

#include <algorithm>
#include <cstddef>

namespace nearfield::tools {

std::size_t SceneRunner::world_input_count() const {
    std::size_t count = 0;
    for (const Entry& entry : entries_) {
        count += entry.is_world ? scene_.queries[entry.query].world->size() : 0;
    }
    return count;
}

void SceneRunner::require_results() const {
    for (const Entry& entry : entries_) {
        require(summary_of(result_of(entry)).status, place_of(entry.query));
    }
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
    for (const Entry& entry : entries_) {
        const Status& status = summary_of(result_of(entry)).status;
        if (entry.is_refused && !entry.is_dependent) {
            problems.push_back(status);
        } else if (!entry.is_refused && !status.ok() && !is_cancelled(entry)) {
            problems.emplace_back(status.code(), place_of(entry.query) + ": " + status.text());
        }
    }
    return problems;
}

std::size_t SceneRunner::dependent_count() const {
    return static_cast<std::size_t>(std::count_if(
        entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.is_dependent; }));
}

bool SceneRunner::is_cancelled(const Entry& entry) const {
    return summary_of(result_of(entry)).status.code() == StatusCode::cancelled;
}

std::size_t SceneRunner::cancelled_count() const {
    return static_cast<std::size_t>(
        std::count_if(entries_.begin(), entries_.end(),
                      [this](const Entry& entry) { return is_cancelled(entry); }));
}

const AnyResult& SceneRunner::result_of(const Entry& entry) const {
    return entry.is_refused || entry.is_world ? outside_batch_[entry.result]
                                              : results_.results[entry.result];
}

const QueryTime* SceneRunner::time_of(const Entry& entry) const {
    const bool is_timed = batch_.times_queries() && !entry.is_refused && !entry.is_world;
    return is_timed ? &results_.timings.queries[entry.result] : nullptr;
}

std::vector<SceneAnswer> SceneRunner::answers() const {
    std::vector<SceneAnswer> answers;
    for (const Entry& entry : entries_) {
        const SceneQuery& query = scene_.queries[entry.query];
        const AnyResult& result = result_of(entry);
        // Boxes within reach of each other may hold shapes that are not.
        const auto* const separation = std::get_if<SeparationResult>(&result);
        if (query.all_pairs && separation != nullptr && separation->distance > query.reach) {
            continue;
        }
        if (query.hits_only && summary_of(result).status.ok() && !is_hit(result)) {
            continue;
        }
        const bool is_answered_world = entry.is_world && summary_of(result).status.ok();
        const bool has_pair = entry.a != Entry::all;
        answers.push_back(
            {query.request, has_pair ? scene_.instances[entry.a].name : query.name_a,
             has_pair ? scene_.instances[entry.b].name : query.name_b, result, query.kind,
             is_answered_world ? &worlds_->answer_of(entry.query) : nullptr, time_of(entry)});
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
