// How a table of pairs that the device finds is brought up to date.

#include <engine/base/interruption.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/context/call_within.hpp>
#include <engine/context/device_pair_state.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/plan/check_query.hpp>

#include <algorithm>
#include <string>
#include <type_traits>
#include <variant>

namespace nearfield {

void DevicePairTableBase::State::check(const char* call) const {
    if (question_.goal == plan::PairGoal::tests &&
        !(question_.reach >= 0.0 && question_.reach <= largest_coordinate)) {
        refuse(call, "the reach is " + geometry::number(question_.reach) +
                         "; it must be a finite number of at least 0");
    }
    const DeviceTechniques& techniques = context_->techniques();
    const plan::AvailableTechniques available{.device = context_->device() != nullptr,
                                              .raster = techniques.raster,
                                              .compute = techniques.compute};
    const Status status = std::visit(
        [&]<class Query>(Query asked) {
            bool is_asked =
                asked.technique == Technique::compute || asked.technique == Technique::automatic;
            if constexpr (requires { asked.target; }) {
                is_asked = is_asked && asked.target == nullptr;
            }
            if (!is_asked) {
                refuse(call,
                       "the device finds these pairs by Technique::compute, in memory of its own; "
                       "the table's query asks for another technique, or names a target");
            }
            if constexpr (requires { asked.normals; }) {
                if (asked.normals == ContactNormals::gradient) {
                    refuse(call, "the contacts of these pairs have analytic normals");
                }
            }
            asked.technique = Technique::compute;
            if constexpr (std::is_same_v<Query, IntersectionTestQuery>) {
                // Its only number is the technique, which answers no such query of a batch.
                return plan::check_query(
                    PenetrationQuery{.tolerance = 1.0, .technique = asked.technique}, available);
            } else {
                return plan::check_query(asked, available);
            }
        },
        query_);
    if (!status.ok()) {
        throw StatusException({status.code(), std::string(call) + ": " + status.message()});
    }
}

void DevicePairTableBase::State::set_submitted(bool is_submitted) {
    if (is_submitted && !is_submitted_) {
        ++context_->tables_in_flight;
    } else if (!is_submitted && is_submitted_) {
        --context_->tables_in_flight;
    }
    is_submitted_ = is_submitted;
}

void DevicePairTableBase::State::start_anew() {
    rows = 0;
    set_submitted(false);
    frame_.reset();
    decided_.clear();
    dropped_rows_.clear();
    instances_.clear(context_ != nullptr ? &context_->shapes() : nullptr);
    buffers_.reset();
    world_.reset();
}

/// Whether the pair is one that a PairTable asks about: the boxes of the device are larger.
bool DevicePairTableBase::State::boxes_meet(const plan::PairRowData& data) const {
    const auto bounds_of = [this](std::uint32_t number) {
        const PairInstance& entry = instances_[number];
        return localize::bounds_of({*polygon_of(entry.instance.shape), entry.instance.pose});
    };
    // In the same order for both rows of a pair: the sums are rounded.
    return localize::may_meet(bounds_of(std::min(data.a, data.b)),
                              bounds_of(std::max(data.a, data.b)), question_.reach);
}

/// Whether a pair with this answer of the CPU has a row.
bool DevicePairTableBase::State::is_hit(const AnyResult& answer,
                                        const plan::PairRowData& data) const {
    const bool has_answer = std::visit(
        [this](const auto& result) {
            bool is_answer = result.intersects;
            if constexpr (requires { result.count; }) {
                const bool counts_alone = question_.goal == plan::PairGoal::penetrations;
                is_answer = (is_answer && !counts_alone) || result.count > 0;
            } else if constexpr (requires { result.distance; }) {
                is_answer = is_answer || result.distance <= question_.reach;
            }
            return is_answer || !result.status.ok();
        },
        answer);
    return has_answer && boxes_meet(data);
}

/// Whether the instances of a pair share a point, for a table of intersection tests.
bool DevicePairTableBase::State::do_share_a_point(const plan::PairRowData& pair) {
    const auto place = [this](std::uint32_t number) {
        const Instance& instance = instances_[number].instance;
        return edges_.place(*polygon_of(instance.shape), instance.pose);
    };
    edges_.clear();
    return intersection_test_.intersect({place(pair.a), place(pair.b)}, edges_);
}

/// Answers the undecided rows.
void DevicePairTableBase::State::answer_undecided() {
    // Much of what a batch does would be brought into the caches for one test alone.
    if (std::holds_alternative<IntersectionTestQuery>(query_)) {
        for (Decided& one : decided_) {
            checkpoint();
            one.has_row = do_share_a_point(one.pair) && boxes_meet(one.pair);
        }
        return;
    }
    cpu_queries_.clear();
    for (const Decided& one : decided_) {
        cpu_queries_.emplace_back(query_on_cpu(one.pair, false));
    }
    context_->ring().answer(
        cpu_queries_, [this](ShapeHandle shape) { return polygon_of(shape); }, decided_results_);
    checkpoint();  // what was cut must not look whole
    for (std::size_t i = 0; i < decided_.size(); ++i) {
        decided_[i].has_row = is_hit(decided_results_.results[i], decided_[i].pair);
    }
}

/// Answers what single precision could not decide, and drops the rows without points.
void DevicePairTableBase::State::decide() {
    if (buffers_->undecided().empty()) {
        return;
    }
    const Stopwatch start;
    for (const std::uint32_t i : buffers_->undecided()) {
        // Where the row lies in memory of the device, each read of it takes long.
        const plan::PairRowData& row = buffers_->row(i);
        const plan::PairRowData pair{.a = row.a, .b = row.b};
        take_poses(pair);
        decided_.push_back({i, false, pair});
    }
    answer_undecided();
    for (const Decided& one : decided_) {
        if (!one.has_row) {
            dropped_rows_.push_back(one.row);
        }
    }
    rows -= static_cast<std::uint32_t>(dropped_rows_.size());
    timings.decode = start.milliseconds();
}

void DevicePairTableBase::State::start(const char* call, Context::Implementation& with,
                                       const Source& source, VkCommandBuffer commands) {
    const Stopwatch total;
    set_submitted(false);
    frame_.reset();
    lacks_room_ = false;
    const world::Instances& instances = source.instances;
    if (context_ != &with || world_.lock() != source.identity) {
        start_anew();
        context_ = &with;
        world_ = source.identity;
    }
    set_poses(source.poses);
    check(call);
    rows = 0;
    decided_.clear();
    dropped_rows_.clear();
    timings.plan = timings.record = timings.device = timings.decode = 0.0;
    for (PassTime& pass : timings.passes) {
        pass.milliseconds = 0.0;
    }
    render::Renderer& renderer = *context_->renderer();
    const double made = renderer.pipeline_milliseconds();
    if (buffers_ == nullptr || renderer_ != renderer.number()) {
        buffers_ = renderer.make_pair_buffers(question_);
        renderer_ = renderer.number();
        instances_.forget_places();
    }
    const bool is_same = instances_.are_those_of(context_->shapes(), instances);
    are_poses_taken_ = are_poses_taken_ && is_same;
    instances_.update(call, context_->shapes(), instances,
                      poses_ ? std::optional(geometry::to_vector(poses_->origin)) : std::nullopt,
                      buffers_->world());
    filters_ = instances.filters();
    find_poses(call);
    const passes::ExportPairs* const exports =
        question_.resident ? &renderer.export_pairs() : nullptr;
    const double pipelines = renderer.pipeline_milliseconds() - made;
    if (instances_.size() > 1) {
        order_instances(instances);
        if (exports != nullptr) {
            buffers_->outputs().set(*exports, instances_.origin());
        }
        timings.plan = total.milliseconds() - pipelines;
        renderer.note_pairs(question_.kind(), poses_.has_value(), question_.resident);
        const passes::PairSearch& search = renderer.pair_search(question_.kind());
        if (commands == VK_NULL_HANDLE) {
            buffers_->begin(search, instances_.shapes(), context_->memory_limit(), timings);
        } else {
            buffers_->record(commands, search, instances_.shapes(), context_->memory_limit(),
                             timings);
        }
    }
    set_submitted(true);
    timings.total = total.milliseconds() - pipelines;
}

void DevicePairTableBase::State::order_instances(const world::Instances& instances) {
    if (are_poses_taken_ && instances_.is_order_due()) {
        for (std::uint32_t number = 0; number < instances_.size(); ++number) {
            take_pose(number);
        }
    }
    // The host says what the origin of its poses is.
    instances_.order(instances, !poses_, buffers_->world());
}

void DevicePairTableBase::State::finish() {
    const Stopwatch total;
    if (instances_.size() > 1) {
        if (frame_) {
            buffers_->collect(timings);
        } else {
            buffers_->finish(timings);
        }
        require_usable_poses();
        rows = buffers_->row_count();
        decide();
    }
    set_submitted(false);
    timings.total += total.milliseconds();
}

void DevicePairTableBase::State::require_collected(const char* call) const {
    if (frame_) {
        require_complete_frame(call);
    } else if (is_submitted_) {
        throw StatusException(
            {StatusCode::not_ready,
             std::string(call) + ": the table was submitted, and has not been collected since"});
    }
}

void DevicePairTableBase::State::update(Context::Implementation& with, const Source& source) {
    require_collected("update");
    run_or_start_anew(with, [&] {
        start("update", with, source);
        finish();
    });
}

void DevicePairTableBase::State::submit(Context::Implementation& with, const Source& source) {
    require_collected("submit");
    run_or_start_anew(with, [&] { start("submit", with, source); });
}

void DevicePairTableBase::State::collect() {
    if (frame_) {
        require_complete_frame("collect");
        collect_recorded();
        return;
    }
    if (!is_submitted_) {
        throw StatusException({StatusCode::not_ready, "collect: the table was not submitted"});
    }
    run_or_start_anew(*context_, [&] { finish(); });
}

void World::Implementation::update(DevicePairTableBase& table, const DevicePoses* poses) {
    table.state_->update(*context_, {{identity_, instances_}, poses});
}

void World::Implementation::submit(DevicePairTableBase& table, const DevicePoses* poses) {
    table.state_->submit(*context_, {{identity_, instances_}, poses});
}

Status World::update(DevicePairTableBase& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table, nullptr); });
}

Status World::submit(DevicePairTableBase& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->submit(table, nullptr); });
}

Status World::update(DevicePairTableBase& table, const DevicePoses& poses, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table, &poses); });
}

Status World::submit(DevicePairTableBase& table, const DevicePoses& poses, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->submit(table, &poses); });
}

Status DevicePairTableBase::collect(const Limits& limits) {
    return catch_within(limits, [&] { state_->collect(); });
}

}  // namespace nearfield
