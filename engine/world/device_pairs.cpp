// How pairs that the device finds are brought up to date.

#include <engine/base/catch_to_status.hpp>
#include <engine/base/interruption.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/device_input/check_target.hpp>
#include <engine/device_input/pair_search.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/placed_pair.hpp>
#include <engine/world/checks.hpp>
#include <engine/world/device_pairs.hpp>
#include <nearfield/portable_math.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <variant>

namespace nearfield {

DevicePairs::DevicePairs(const AnyQuery& query, const PairTableOptions& options, Timings& timings)
    : query_(query),
      options_(options),
      timings_(timings),
      question_(device_input::pair_question(query, options.reach)),
      reserve_(options.reserve) {}

DevicePairs::~DevicePairs() {
    if (context_ != nullptr) {
        report_open_frame();
        set_submitted(false);
        instances_.clear(&context_->shapes());
    }
}

PairsOnDevice DevicePairs::on_device() const {
    if (buffers_ == nullptr || instances_.size() < 2) {
        throw StatusException({StatusCode::not_ready,
                               "on_device: no pairs were searched; the table was not submitted, or "
                               "there were fewer than two instances"});
    }
    return buffers_->outputs().pairs();
}

std::uint32_t DevicePairs::candidates() const {
    const bool has_searched = buffers_ != nullptr && instances_.size() > 1 && !is_submitted_;
    return has_searched ? buffers_->candidates() : 0;
}

void DevicePairs::check(const char* call) const {
    std::visit(
        [&]<class Query>(Query asked) {
            asked.technique = Technique::compute;
            if constexpr (std::is_same_v<Query, IntersectionTestQuery>) {
                require_answered_by_compute(call, *context_);
            } else {
                require_answered(call, asked, *context_);
            }
        },
        query_);
}

void DevicePairs::set_submitted(bool is_submitted) {
    if (is_submitted && !is_submitted_) {
        ++context_->tables_in_flight;
    } else if (!is_submitted && is_submitted_) {
        --context_->tables_in_flight;
    }
    is_submitted_ = is_submitted;
}

void DevicePairs::start_anew() {
    rows_ = 0;
    set_submitted(false);
    frame_.reset();
    decided_.clear();
    dropped_rows_.clear();
    instances_.clear(context_ != nullptr ? &context_->shapes() : nullptr);
    buffers_.reset();
    world_.reset();
}

/// Whether the pair is one that a PairTable asks about: the boxes of the device are larger.
bool DevicePairs::boxes_meet(const shaders::PairRowData& data) const {
    const auto bounds_of = [this](std::uint32_t number) {
        const PairInstance& entry = instances_[number];
        return geometry::bounds_of({*polygon_of(entry.instance.shape), entry.instance.pose});
    };
    // In the same order for both rows of a pair: the sums are rounded.
    return geometry::may_meet(bounds_of(std::min(data.a, data.b)),
                              bounds_of(std::max(data.a, data.b)), question_.reach);
}

/// Whether a pair with this answer of the CPU has a row.
bool DevicePairs::is_hit(const AnyResult& answer, const shaders::PairRowData& data) const {
    const bool has_answer = std::visit(
        [this](const auto& result) {
            return !result.status.ok() || nearfield::is_hit(result, question_.reach);
        },
        answer);
    return has_answer && boxes_meet(data);
}

/// Whether the instances of a pair share a point, for a table of intersection tests.
bool DevicePairs::do_share_a_point(const shaders::PairRowData& pair) {
    const Instance& a = instances_[pair.a].instance;
    const Instance& b = instances_[pair.b].instance;
    edges_.clear();
    return queries::intersect({polygon_of(a.shape), polygon_of(b.shape), a.pose, b.pose}, edges_,
                              overlap_test_);
}

/// Answers the undecided rows.
void DevicePairs::answer_undecided() {
    // Much of what a batch does would be brought into the caches for one test alone.
    if (std::holds_alternative<IntersectionTestQuery>(query_)) {
        for (Decided& one : decided_) {
            checkpoint();
            one.has_row = do_share_a_point(one.pair) && boxes_meet(one.pair);
        }
        return;
    }
    decided_results_.resize(std::max(decided_results_.size(), decided_.size()));
    ask_cpu(
        decided_.size(), false,
        [this](std::size_t i) -> const shaders::PairRowData& { return decided_[i].pair; },
        [this](std::size_t i, const AnyResult& result) {
            decided_results_[i] = result;
            decided_[i].has_row = is_hit(result, decided_[i].pair);
        });
}

/// Answers what single precision could not decide, and drops the rows without points.
void DevicePairs::decide() {
    if (buffers_->undecided().empty()) {
        return;
    }
    const Stopwatch start;
    for (const std::uint32_t i : buffers_->undecided()) {
        // Where the row lies in memory of the device, each read of it takes long.
        const shaders::PairRowData& row = buffers_->row(i);
        const shaders::PairRowData pair{.a = row.a, .b = row.b};
        take_poses(pair);
        decided_.push_back({i, false, pair});
    }
    answer_undecided();
    for (const Decided& one : decided_) {
        if (!one.has_row) {
            dropped_rows_.push_back(one.row);
        }
    }
    rows_ -= static_cast<std::uint32_t>(dropped_rows_.size());
    timings_.decode = start.milliseconds();
}

void DevicePairs::start(const char* call, const WorldView& world, const PairTableInput& input,
                        const Recording* recording) {
    const Stopwatch total;
    set_submitted(false);
    frame_.reset();
    lacks_room_ = false;
    const world::Instances& instances = world.instances;
    if (context_.get() != &world.context || world_.lock() != world.identity) {
        start_anew();
        context_ = world.context.shared_from_this();
        world_ = world.identity;
    }
    set_poses(input.poses);
    check(call);
    if (input.target != nullptr) {
        check_target(call, *input.target);
    }
    rows_ = 0;
    decided_.clear();
    dropped_rows_.clear();
    clear_parts(timings_);
    render::Renderer& renderer = *context_->renderer();
    const double made = renderer.pipeline_milliseconds();
    if (buffers_ == nullptr || renderer_ != renderer.number()) {
        buffers_ = renderer.make_pair_buffers(question_, reserve_);
        renderer_ = renderer.number();
        instances_.forget_places();
    }
    const std::uint64_t content = instances_.content();
    instances_.update(call, context_->shapes(), instances,
                      poses_ ? std::optional(geometry::to_vector(poses_->origin)) : std::nullopt,
                      buffers_->world());
    are_poses_taken_ = are_poses_taken_ && content == instances_.content();
    find_poses(call);
    const passes::ExportPairs* const exports =
        question_.on_device ? &renderer.export_pairs() : nullptr;
    const double pipelines = renderer.pipeline_milliseconds() - made;
    if (instances_.size() > 1) {
        order_instances(instances);
        if (exports != nullptr) {
            buffers_->outputs().set(*exports, instances_.origin(), input.target);
        }
        timings_.plan = total.milliseconds() - pipelines;
        renderer.note_pairs(question_.kind(), poses_.has_value(), question_.on_device);
        if (recording == nullptr) {
            buffers_->begin(instances_.shapes(), context_->memory_limit(), timings_);
        } else {
            buffers_->record(recording->commands, instances_.shapes(), context_->memory_limit(),
                             options_.headroom, timings_);
        }
    }
    set_submitted(true);
    if (recording != nullptr) {
        frame_ = recording->frame;
    }
    timings_.total = total.milliseconds() - pipelines;
}

void DevicePairs::order_instances(const world::Instances& instances) {
    if (are_poses_taken_ && instances_.is_order_due()) {
        for (std::uint32_t number = 0; number < instances_.size(); ++number) {
            take_pose(number);
        }
    }
    // The host says what the origin of its poses is.
    instances_.order(instances, !poses_, buffers_->world());
}

void DevicePairs::finish() {
    const Stopwatch total;
    if (instances_.size() > 1) {
        if (frame_) {
            buffers_->collect(timings_);
        } else {
            buffers_->finish(timings_);
        }
        require_usable_poses();
        rows_ = buffers_->row_count();
        decide();
    }
    set_submitted(false);
    timings_.total += total.milliseconds();
}

void DevicePairs::require_collected(const char* call) const {
    require_complete_frame(call);
    if (is_submitted_ && !frame_) {
        throw StatusException(
            {StatusCode::not_ready,
             std::string(call) + ": the table was submitted, and has not been collected since"});
    }
}

/// All instances are written anew where poses come from elsewhere than before.
void DevicePairs::set_poses(const DevicePoses* poses) {
    const bool is_same_source =
        poses == nullptr ? !poses_.has_value() : poses_ && poses->origin == poses_->origin;
    if (!is_same_source) {
        instances_.forget_places();
    }
    poses_ = poses == nullptr ? std::nullopt : std::optional(*poses);
}

void DevicePairs::find_poses(const char* call) {
    if (!poses_) {
        buffers_->poses().clear();
        return;
    }
    const VkPhysicalDeviceLimits& limits = context_->device()->limits();
    const Status status = device_input::check_poses(*poses_, instances_.end_index(),
                                                    limits.minStorageBufferOffsetAlignment,
                                                    limits.maxStorageBufferRange);
    if (!status.ok()) {
        refuse(call, status.message());
    }
    if (instances_.size() > 1) {
        const double farthest = question_.resolved > 0.0
                                    ? question_.resolved / queries::smallest_tolerance(1.0)
                                    : std::numeric_limits<float>::max();
        buffers_->poses().set(context_->renderer()->pair_poses(), *poses_, instances_.end_index(),
                              farthest);
    }
}

void DevicePairs::check_target(const char* call, const PairTarget& target) const {
    const Status status = device_input::check_pair_target(
        target, context_->device()->limits().minStorageBufferOffsetAlignment);
    if (!status.ok()) {
        refuse(call, status.message());
    }
}

void DevicePairs::require_room_of_target() {
    if (buffers_ == nullptr || instances_.size() < 2) {
        return;
    }
    lacks_room_ = true;
    buffers_->require_room_of_target();
    lacks_room_ = false;
}

void DevicePairs::require_usable_poses() {
    if (!poses_) {
        return;
    }
    if (const auto number = buffers_->poses().unusable()) {
        const auto [x, y, cosine, sine] = buffers_->poses().pose(*number);
        refuse("poses", "that of the instance with index " +
                            std::to_string(instances_.index(*number)) + " is (" +
                            geometry::number(x) + ", " + geometry::number(y) + ") with cosine " +
                            geometry::number(cosine) + " and sine " + geometry::number(sine) +
                            "; positions must be finite and, with their origin, at most " +
                            geometry::number(largest_coordinate) +
                            " in magnitude, and the square of the length of (cosine, sine) must "
                            "differ from 1 by at most 1/64");
    }
    if (!are_poses_taken_) {
        are_poses_taken_ = true;
        instances_.order_soon();  // until now they were ordered by the poses of the world
    }
}

void DevicePairs::take_pose(std::uint32_t number) {
    const auto [x, y, cosine, sine] = buffers_->poses().pose(number);
    const double length = std::hypot(cosine, sine);
    instances_.take_pose(number,
                         {.translation = {poses_->origin.x + x, poses_->origin.y + y},
                          .angle = arc_tangent(sine, cosine)},
                         {sine / length, cosine / length});
}

double DevicePairs::rounding_of(const PairInstance& entry) const {
    const geometry::Polygon& polygon = *polygon_of(entry.instance.shape);
    const double magnitude = instances_.origin().lpNorm<1>() + entry.place.lpNorm<1>() +
                             polygon.radius() + polygon.centre().lpNorm<1>();
    return device_input::rounding_of_host_pose(polygon, magnitude);
}

void DevicePairs::take_poses(const shaders::PairRowData& pair) {
    if (poses_) {
        take_pose(pair.a);
        take_pose(pair.b);
    }
}

shaders::PairRowData DevicePairs::pair_of(std::uint32_t device_row) {
    const shaders::PairRowData data = buffers_->row(device_row);
    take_poses(data);
    return data;
}

void DevicePairs::require_complete_frame(const char* call) const {
    if (frame_ && !context_->is_complete(*frame_)) {
        throw StatusException(
            {StatusCode::not_ready,
             std::string(call) + ": the table was recorded for frame " + std::to_string(*frame_) +
                 ", which is not complete: Context::frame_completed() says when it is"});
    }
}

/// The device would use what goes with the table.
void DevicePairs::report_open_frame() const noexcept {
    if (frame_ && !context_->is_complete(*frame_)) {
        context_->device()->log(LogLevel::error, [&] {
            return "a PairTable is destroyed while what was recorded of it for frame " +
                   std::to_string(*frame_) +
                   " may still run; the device has to finish it, or never begin, and "
                   "Context::frame_completed() says so";
        });
    }
}

bool DevicePairs::is_ready() const {
    if (frame_) {
        return context_->is_complete(*frame_);
    }
    return is_submitted_ && (buffers_ == nullptr || buffers_->is_done());
}

PairTableCounts DevicePairs::found() const noexcept {
    PairTableCounts found;
    if (buffers_ != nullptr) {
        // A device that is lost has found nothing.
        static_cast<void>(catch_to_status([&] { found = buffers_->found(); }));
    }
    return found;
}

/// What is made anew has room for twice what was found last.
void DevicePairs::trim() noexcept {
    if (buffers_ == nullptr || (frame_ ? !context_->is_complete(*frame_) : is_submitted_)) {
        return;
    }
    const PairTableCounts found = this->found();
    const auto twice = [](std::uint32_t reserved, std::uint32_t count) {
        return std::max(reserved, count < UINT32_MAX / 2 ? 2 * count : 0);
    };
    for (std::uint32_t PairTableCounts::*const number :
         {&PairTableCounts::pairs, &PairTableCounts::points, &PairTableCounts::rows,
          &PairTableCounts::edge_groups, &PairTableCounts::edges,
          &PairTableCounts::tested_points}) {
        reserve_.*number = twice(options_.reserve.*number, found.*number);
    }
    buffers_.reset();
    instances_.forget_places();
    set_submitted(false);
    frame_.reset();
    rows_ = 0;
    decided_.clear();
    dropped_rows_.clear();
}

void DevicePairs::collect_recorded() {
    if (!is_submitted_) {  // collected before
        timings_.plan = timings_.record = timings_.total = 0.0;
    }
    rows_ = 0;
    decided_.clear();
    dropped_rows_.clear();
    timings_.decode = 0.0;
    for (PassTime& pass : timings_.passes) {
        pass.milliseconds = 0.0;
    }
    const Status status = context_->unless_lost([&] { finish(); });
    if (!status.ok()) {
        rows_ = 0;
        decided_.clear();
        if (buffers_ != nullptr) {
            buffers_->forget_counts();
        }
        set_submitted(false);
        lacks_room_ = status.code() == StatusCode::overflow;
        throw StatusException(status);
    }
    require_room_of_target();
}

bool DevicePairs::is_recorded(const WorldView& world) const {
    const render::Renderer* const renderer = world.context.renderer();
    return frame_ && !lacks_room_ && context_.get() == &world.context &&
           world_.lock() == world.identity &&
           instances_.are_those_of(world.context.shapes(), world.instances) &&
           renderer_ == renderer->number();
}

}  // namespace nearfield
