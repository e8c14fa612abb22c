// What questions about a world that the device answers have in common.

#include <engine/base/status_exception.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/context/device_query_state.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/pair_question.hpp>
#include <engine/plan/search_shapes.hpp>

#include <string>

namespace nearfield {

DeviceQueryBase::DeviceQueryBase(std::unique_ptr<State> state) noexcept
    : state_(std::move(state)) {}
DeviceQueryBase::~DeviceQueryBase() = default;
DeviceQueryBase::DeviceQueryBase(DeviceQueryBase&&) noexcept = default;
DeviceQueryBase& DeviceQueryBase::operator=(DeviceQueryBase&&) noexcept = default;

std::uint32_t DeviceQueryBase::size() const noexcept {
    return state_->count;
}

std::uint32_t DeviceQueryBase::left_to_cpu() const noexcept {
    return state_->left_to_cpu;
}

bool DeviceQueryBase::is_ready() const noexcept {
    return state_->is_ready();
}

const Timings& DeviceQueryBase::timings() const noexcept {
    return state_->timings;
}

DeviceQueryBase::State::State(plan::WorldQuestion question)
    : question_(question),
      query_(IntersectionTestQuery{}),
      pair_question_(plan::pair_question(query_, 0.0)) {}

DeviceQueryBase::State::~State() {
    if (context_ != nullptr) {
        set_submitted(false);
        instances_.clear(&context_->shapes());
    }
}

bool DeviceQueryBase::State::is_ready() const {
    return is_submitted_ && (buffers_ == nullptr || buffers_->is_done());
}

void DeviceQueryBase::State::set_submitted(bool is_submitted) {
    if (is_submitted != is_submitted_) {
        context_->tables_in_flight += is_submitted ? 1U : UINT32_MAX;
        is_submitted_ = is_submitted;
    }
}

/// What was submitted is lost, and all that is known of the world.
void DeviceQueryBase::State::forget() {
    count = left_to_cpu = 0;
    buffers_.reset();
    if (context_ != nullptr) {
        set_submitted(false);
        instances_.clear(&context_->shapes());
    }
    for_cpu_.reset();
    world_.reset();
}

void DeviceQueryBase::State::require_collected(const char* call) const {
    if (is_submitted_) {
        throw StatusException(
            {StatusCode::not_ready,
             std::string(call) + ": what was submitted has not been collected since"});
    }
}

void DeviceQueryBase::State::require_submitted(const char* call) const {
    if (!is_submitted_) {
        throw StatusException({StatusCode::not_ready, std::string(call) +
                                                          ": nothing was submitted, or it was "
                                                          "collected before"});
    }
}

void DeviceQueryBase::State::check(const char* call) const {
    const DeviceTechniques& techniques = context_->techniques();
    const Status status =
        plan::check_query(PenetrationQuery{.tolerance = 1.0, .technique = Technique::compute},
                          {.device = context_->device() != nullptr,
                           .raster = techniques.raster,
                           .compute = techniques.compute});
    if (!status.ok()) {
        throw StatusException({status.code(), std::string(call) + ": " + status.message()});
    }
}

void DeviceQueryBase::State::start(const char* call, Context::Implementation& with,
                                   const WorldOnDevice& world, const WorldFilter& filter,
                                   std::size_t questions) {
    if (context_ != &with || world_.lock() != world.identity) {
        forget();
        context_ = &with;
        world_ = world.identity;
        jobs_.emplace(with.jobs());
    }
    check(call);
    if (questions > UINT32_MAX) {
        throw StatusException({StatusCode::too_large, std::string(call) + ": there are " +
                                                          std::to_string(questions) +
                                                          ", more than 32 bits can count"});
    }
    left_to_cpu = 0;
    timings.plan = timings.record = timings.device = timings.decode = 0.0;
    for (PassTime& pass : timings.passes) {
        pass.milliseconds = 0.0;
    }
    render::Renderer& renderer = *context_->renderer();
    const double made = renderer.pipeline_milliseconds();
    if (buffers_ == nullptr || renderer_ != renderer.number()) {
        buffers_ = renderer.make_world_query_buffers(question_);
        renderer_ = renderer.number();
        instances_.forget_places();
    }
    making_pipelines_ = renderer.pipeline_milliseconds() - made;
    if (!instances_.are_those_of(with.shapes(), world.instances)) {
        for_cpu_.reset();
        instances_.update(call, with.shapes(), world.instances, {}, buffers_->world());
        placed_.reset(instances_.size());
    } else {
        instances_.update(call, with.shapes(), world.instances, {}, buffers_->world());
    }
    count = static_cast<std::uint32_t>(questions);
    filter_ = filter;
    ignored_ = plan::no_instance;
    for (std::uint32_t i = 0; filter.ignored != InstanceHandle{} && i < instances_.size(); ++i) {
        ignored_ = instances_[i].handle == filter.ignored ? i : ignored_;
    }
    if (instances_.size() > 0) {
        instances_.order(world.instances, true, buffers_->world());
    }
}

void DeviceQueryBase::State::begin(const Stopwatch& total, plan::WorldQueryPush& push) {
    timings.plan = total.milliseconds() - making_pipelines_;
    render::Renderer& renderer = *context_->renderer();
    renderer.note_world_queries(question_);
    push.category = filter_.category;
    push.mask = filter_.mask;
    push.ignored = ignored_;
    push.magnitude = plan::rounded_up(2.0 * instances_.origin().lpNorm<1>());
    buffers_->begin(renderer.world_queries(question_), instances_.shapes(), push, timings);
}

void DeviceQueryBase::State::wait() {
    if (instances_.size() > 0 && count > 0) {
        buffers_->finish(timings);
    }
}

void DeviceQueryBase::State::clear_left() {
    left_of_jobs_.resize(jobs_->count());
    for (std::vector<std::uint32_t>& left : left_of_jobs_) {
        left.clear();
    }
}

void DeviceQueryBase::State::gather_left() {
    left_.clear();
    for (const std::vector<std::uint32_t>& left : left_of_jobs_) {
        left_.insert(left_.end(), left.begin(), left.end());
    }
    left_to_cpu = static_cast<std::uint32_t>(left_.size());
}

const world::Instances& DeviceQueryBase::State::instances_for_cpu() {
    const bool is_new = !for_cpu_;
    if (is_new) {
        for_cpu_.emplace();
        moves_for_cpu_.assign(instances_.size(), 0);
    }
    for (std::uint32_t i = 0; i < instances_.size(); ++i) {
        const DeviceInstances::Entry& entry = instances_[i];
        if (is_new) {
            static_cast<void>(for_cpu_->add({.shape = entry.instance.shape,
                                             .pose = entry.instance.pose,
                                             .category = entry.category,
                                             .mask = entry.mask}));
        } else if (moves_for_cpu_[i] != instances_.moves(i)) {
            const InstanceHandle handle = for_cpu_->handle(i);
            for_cpu_->move({&handle, 1}, {&entry.instance.pose, 1});
            for_cpu_->set_filter(i, entry.category, entry.mask);
        }
        moves_for_cpu_[i] = instances_.moves(i);
    }
    const auto find = [](void* of, ShapeHandle shape) {
        return static_cast<const DeviceInstances*>(of)->polygon_of(shape);
    };
    for_cpu_->prepare({find, &instances_}, instances_.shapes_revision());
    return *for_cpu_;
}

WorldFilter DeviceQueryBase::State::filter_for_cpu() const {
    WorldFilter filter = filter_;
    filter.ignored = ignored_ == plan::no_instance ? InstanceHandle{} : for_cpu_->handle(ignored_);
    return filter;
}

}  // namespace nearfield
