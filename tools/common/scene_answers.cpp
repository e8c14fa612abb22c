// What a SceneRunner tells of its last frame.

#include <tools/common/library_error.hpp>
#include <tools/common/scene_runner.hpp>

#include <algorithm>
#include <cstddef>

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
