// What requests of all kinds have in common.

#include <engine/device_input/pair_question.hpp>
#include <engine/device_input/search_shapes.hpp>
#include <engine/world/requests.hpp>

#include <string>

namespace nearfield {
namespace {

/// Questions from which on Technique::automatic asks a hardware device. On an H100, 1,000 questions
/// about 42,000 instances that stand take 0.8 to 1.6 times as long as on the CPU, and 30,000 a
/// tenth to a third (docs/measurements/gpu.md).
constexpr std::size_t paying_questions = 4096;

}  // namespace

WorldRequest::WorldRequest() noexcept = default;
WorldRequest::~WorldRequest() = default;
WorldRequest::WorldRequest(WorldRequest&&) noexcept = default;
WorldRequest& WorldRequest::operator=(WorldRequest&&) noexcept = default;

std::uint32_t WorldRequest::size() const noexcept {
    return state_ == nullptr ? 0 : state_->count;
}

std::uint32_t WorldRequest::left_to_cpu() const noexcept {
    return state_ == nullptr ? 0 : state_->left_to_cpu;
}

bool WorldRequest::is_ready() const noexcept {
    return state_ != nullptr && state_->is_ready();
}

const Timings& WorldRequest::timings() const noexcept {
    static const Timings none;
    return state_ == nullptr ? none : state_->timings;
}

WorldRequest::State::State(device_input::WorldQuestion kind)
    : question(kind),
      query_(IntersectionTestQuery{}),
      pair_question_(device_input::pair_question(query_, 0.0)) {}

WorldRequest::State::~State() {
    if (context_ != nullptr) {
        set_pending_on_device(false);
        instances_.clear(&context_->shapes());
    }
}

bool WorldRequest::State::is_ready() const {
    return is_answered_ || (is_pending_on_device_ && (buffers_ == nullptr || buffers_->is_done()));
}

void WorldRequest::State::set_pending_on_device(bool is_pending) {
    if (is_pending != is_pending_on_device_) {
        context_->tables_in_flight += is_pending ? 1U : UINT32_MAX;
        is_pending_on_device_ = is_pending;
    }
}

void WorldRequest::State::forget() {
    count = left_to_cpu = 0;
    buffers_.reset();
    if (context_ != nullptr) {
        set_pending_on_device(false);
        instances_.clear(&context_->shapes());
    }
    for_cpu_.reset();
    world_.reset();
}

void WorldRequest::State::require_collected(const char* call) const {
    if (is_pending_on_device_ || is_answered_) {
        throw StatusException(
            {StatusCode::not_ready,
             std::string(call) + ": what was submitted has not been collected since"});
    }
}

void WorldRequest::State::refuse_uncollected(const char* call) {
    throw StatusException(
        {StatusCode::not_ready,
         std::string(call) + ": nothing of this kind was submitted, or it was collected before"});
}

void WorldRequest::State::require_countable(const char* call, std::size_t questions) {
    if (questions > UINT32_MAX) {
        throw StatusException({StatusCode::too_large, std::string(call) + ": there are " +
                                                          std::to_string(questions) +
                                                          ", more than 32 bits can count"});
    }
}

bool WorldRequest::State::pays_on_device(const World::State& world, std::size_t questions) {
    const gpu::Device* const device = world.context->device();
    return device != nullptr && !device->is_software() && world.context->techniques().compute &&
           questions >= paying_questions;
}

void WorldRequest::State::start(const char* call, const WorldView& world, const WorldFilter& filter,
                                std::size_t questions) {
    Context::Implementation& with = world.context;
    if (context_.get() != &with || world_.lock() != world.identity) {
        forget();
        context_ = with.shared_from_this();
        world_ = world.identity;
        jobs_.emplace(with.jobs());
    }
    require_answered_by_compute(call, with);
    require_countable(call, questions);
    left_to_cpu = 0;
    clear_parts(timings);
    render::Renderer& renderer = *context_->renderer();
    const double made = renderer.pipeline_milliseconds();
    if (buffers_ == nullptr || renderer_ != renderer.number()) {
        buffers_ = renderer.make_world_query_buffers(question);
        renderer_ = renderer.number();
        instances_.forget_places();
    }
    making_pipelines_ = renderer.pipeline_milliseconds() - made;
    const std::uint64_t content = instances_.content();
    instances_.update(call, with.shapes(), world.instances, {}, buffers_->world());
    if (content != instances_.content()) {
        for_cpu_.reset();
        placed_.reset(instances_.size());
    }
    count = static_cast<std::uint32_t>(questions);
    filter_ = filter;
    ignored_ = shaders::no_instance;
    for (std::uint32_t i = 0; filter.ignored != InstanceHandle{} && i < instances_.size(); ++i) {
        ignored_ = instances_[i].handle == filter.ignored ? i : ignored_;
    }
    if (instances_.size() > 0) {
        instances_.order(world.instances, true, buffers_->world());
    }
}

void WorldRequest::State::begin(const Stopwatch& total, shaders::WorldQueryPush& push) {
    timings.plan = total.milliseconds() - making_pipelines_;
    render::Renderer& renderer = *context_->renderer();
    renderer.note_world_queries(question);
    push.category = filter_.category;
    push.mask = filter_.mask;
    push.ignored = ignored_;
    push.magnitude = device_input::rounded_up(2.0 * instances_.origin().lpNorm<1>());
    buffers_->begin(instances_.shapes(), push, timings);
}

void WorldRequest::State::clear_left() {
    left_of_jobs_.resize(jobs_->count());
    for (std::vector<std::uint32_t>& left : left_of_jobs_) {
        left.clear();
    }
}

void WorldRequest::State::gather_left() {
    left_.clear();
    for (const std::vector<std::uint32_t>& left : left_of_jobs_) {
        left_.insert(left_.end(), left.begin(), left.end());
    }
    left_to_cpu = static_cast<std::uint32_t>(left_.size());
}

const world::Instances& WorldRequest::State::instances_for_cpu() {
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
    for_cpu_->prepare([this](ShapeHandle shape) { return instances_.polygon_of(shape); }, 0);
    return *for_cpu_;
}

WorldFilter WorldRequest::State::filter_for_cpu() const {
    WorldFilter filter = filter_;
    filter.ignored =
        ignored_ == shaders::no_instance ? InstanceHandle{} : for_cpu_->handle(ignored_);
    return filter;
}

}  // namespace nearfield
