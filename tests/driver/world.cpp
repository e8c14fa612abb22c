#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/query/all_numbers.hpp>
#include <tests/support/allocations.hpp>

namespace nearfield::test {
namespace {

constexpr double first_cells = 4.0;
constexpr double larger_cells = 20.0;

const std::vector<Ring> rings_a{{{0, 0}, {3, 0}, {3, 2}, {2, 1}, {1, 2}, {0, 2}}};
const std::vector<Ring> rings_b{{{0, 0}, {2, 0.2}, {2.5, 1.5}, {1, 2.5}, {-0.5, 1}}};
const std::vector<Vector2> field_points{{1.1, 1.2}, {1.6, 1.4}};

// The first queries of a batch for the device.
constexpr QueryHandle<PenetrationQuery> resident_penetration{0};
constexpr QueryHandle<ContactQuery> resident_contacts{1};
constexpr QueryHandle<DistanceFieldQuery> resident_field{2};
constexpr QueryHandle<IntersectionQuery> samples_on_device{3};

/// Work of the host itself.
template <class Make>
Batch unwatched(const Make& make) {
    const test_support::UnwatchedAllocations here;
    return make();
}

std::vector<const void*> handles_of(const FieldOnDevice& field) {
    return {field.signed_distance.image, field.signed_distance.view, field.feature.image,
            field.feature.view, field.header.buffer};
}

template <class Resident>
std::vector<const void*> handles_of(const Resident& resident) {
    return {resident.buffer, resident.header.buffer};
}

/// The first error among the queries of a batch.
Status first_error(const Results& results) {
    for (const AnyResult& any : results.results) {
        Status status = std::visit([](const auto& result) { return result.status; }, any);
        if (!status.ok()) {
            return status;
        }
    }
    return {};
}

}  // namespace

Status World::take(Step step) {
    const SemaphoreWait for_first{before_};
    const SemaphoreSignal by_first{after_};
    const SemaphoreWait for_none{after_};
    const SemaphoreSignal by_none{before_};
    switch (step) {
        case Step::create:
            return create();
        case Step::add_shapes:
            return add_shapes();
        case Step::submit_first:
            return submit_for_device(first_cells,
                                     {.waits = {&for_first, 1}, .signals = {&by_first, 1}});
        case Step::submit_larger:
        case Step::submit_last:
            return submit_for_device(larger_cells, {});
        case Step::submit_without_work:
            return submit(unwatched([&] { return batch(first_cells, Technique::cpu); }),
                          {.waits = {&for_none, 1}, .signals = {&by_none, 1}});
        case Step::record:
        case Step::record_in_vain:
        case Step::record_last:
            return record();
        case Step::collect_first:
        case Step::collect_larger:
        case Step::collect_without_work:
            return collect();
        case Step::collect_recorded:
            return collect_recorded(true);
        case Step::collect_unexecuted:
            return collect_recorded(false);
        case Step::destroy:
            leave();
            return {};
    }
    return {};
}

World::~World() {
    leave();
}

bool World::starts_a_batch(Step step) {
    switch (step) {
        case Step::submit_first:
        case Step::submit_larger:
        case Step::record:
        case Step::record_in_vain:
        case Step::submit_without_work:
        case Step::submit_last:
        case Step::record_last:
            return true;
        default:
            return false;
    }
}

void World::leave() {
    if (context_) {
        context_->frame_completed(UINT64_MAX);  // nothing was submitted, and nothing will be
        context_.reset();
    }
}

void World::take_all_before(Step step) {
    for (const Step earlier : steps) {
        if (earlier == step) {
            return;
        }
        const Status status = take(earlier);
        ASSERT_TRUE(status.ok()) << to_string(earlier) << ": " << status.text();
    }
}

Status World::create() {
    HostDevice host = driver_.host();
    host.memory = memory_;
    Settings settings;
    settings.timestamps = true;
    Expected<Context> made = Context::create(host, settings);
    if (made.has_value()) {
        context_.emplace(std::move(*made));
    }
    return made.error();
}

Status World::add_shapes() {
    const Expected<ShapeHandle> a = context_->add_shape(rings_a);
    if (!a) {
        return a.error();
    }
    const Expected<ShapeHandle> b = context_->add_shape(rings_b);
    if (!b) {
        return b.error();
    }
    a_ = *a;
    b_ = *b;
    return {};
}

Status World::submit(const Batch& queries, const Submission& submission) {
    const Expected<Ticket> ticket = context_->submit(queries, submission);
    if (!ticket) {
        return ticket.error();
    }
    ticket_ = *ticket;
    return {};
}

Status World::submit_for_device(double cells, const Submission& submission) {
    Status status = submit(unwatched([&] { return batch(cells); }), submission);
    return status.ok() ? look_at_residents() : status;
}

Status World::record() {
    const Batch queries = unwatched([&] { return batch(larger_cells); });
    commands_ = driver_.begin_commands();
    const Expected<Ticket> ticket =
        context_->record(queries, {.commands = commands_, .frame = ++frame_});
    if (!ticket) {
        return ticket.error();
    }
    ticket_ = *ticket;
    return look_at_residents();
}

bool World::is_usable(const FieldOnDevice& field) const {
    const auto can_be_read = [this](const ImageOnDevice& image) {
        return driver_.has_memory(image.image, image.view);
    };
    return can_be_read(field.signed_distance) && can_be_read(field.feature) &&
           driver_.has_memory(field.header.buffer, field.header.offset, sizeof(HeaderData));
}

template <class Resident>
bool World::is_usable(const Resident& resident) const {
    return driver_.has_memory(resident.buffer, resident.offset, resident.size) &&
           driver_.has_memory(resident.header.buffer, resident.header.offset, sizeof(HeaderData));
}

template <class Query>
Status World::look_at_resident(QueryHandle<Query> handle) {
    const auto resident = context_->on_device(ticket_, handle);
    if (!resident.has_value()) {
        return resident.error();
    }
    const test_support::UnwatchedAllocations here;
    if (!is_usable(*resident)) {
        return {StatusCode::device_error, "a result that stays has no memory"};
    }
    NamedBefore now{resident->slot.revision, handles_of(*resident)};
    NamedBefore& before = named_before_[{resident->slot.index, handle.index}];
    if (now.revision == before.revision && now.handles != before.handles) {
        return {StatusCode::device_error, "a result that stays has moved without a new revision"};
    }
    before = std::move(now);
    return {};
}

Status World::look_at_residents() {
    Status status = look_at_resident(resident_penetration);
    status = status.ok() ? look_at_resident(resident_contacts) : status;
    status = status.ok() ? look_at_resident(resident_field) : status;
    return status.ok() ? look_at_resident(samples_on_device) : status;
}

Status World::collect() {
    static_cast<void>(context_->is_ready(ticket_));
    Results results;
    Status status = context_->collect(ticket_, results);
    return status.ok() ? first_error(results) : status;
}

Status World::collect_recorded(bool executed) {
    if (executed) {
        driver_.submit(commands_);
        driver_.finish_submissions();
    }
    context_->frame_completed(frame_);
    Status status = collect();
    if (executed || status.code() != (status.ok() ? StatusCode::ok : StatusCode::not_executed)) {
        return status;
    }
    return status.ok() ? Status(StatusCode::device_error, "answers that nobody computed")
                       : Status();
}

Status World::answer(std::vector<double>& numbers) {
    Results results;
    // Frees a slot for another batch, answered or not.
    context_->frame_completed(frame_);
    static_cast<void>(context_->collect(ticket_, results));
    if (Status status = context_->run(batch(larger_cells, technique_), results); !status.ok()) {
        return status;
    }
    if (Status status = first_error(results); !status.ok()) {
        return status;
    }
    if (Status status = context_->run(batch(first_cells, Technique::cpu), results); !status.ok()) {
        return status;
    }
    numbers = all_numbers(results);
    return first_error(results);
}

std::vector<double> World::undisturbed(Technique technique) {
    World world(technique);
    world.take_all_before(Step::submit_first);
    std::vector<double> numbers;
    const Status status = world.answer(numbers);
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_GT(numbers.size(), 100U);
    return numbers;
}

Batch World::batch(double cells, Technique technique) const {
    Batch batch;
    const double tolerance = 1.0 / cells;
    const Instance apart{b_, {{4.5, 0.4}, 0.3}};
    DistanceFieldQuery field{here(), there(), tolerance};
    field.technique = technique;
    if (technique != Technique::cpu) {
        constexpr Technique keeps = Technique::compute;
        batch.add(PenetrationQuery{here(), there(), tolerance, PenetrationPoints::boundary, false,
                                   keeps, true});
        batch.add(ContactQuery{here(), there(), tolerance, 0.1, ContactNormals::analytic, false,
                               keeps, true});
        field.technique = keeps;
        field.on_device = true;
        field.target = &target_;
        batch.add(field);
        field.on_device = false;
        field.target = nullptr;
        field.technique = technique;
        batch.add(IntersectionQuery{here(), there(), tolerance, IntersectionKind::boundary_volume,
                                    true, IntersectionStrategy::stencil, keeps, true});
    }
    for (const PenetrationPoints points :
         {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
        batch.add(PenetrationQuery{here(), there(), tolerance, points, false, technique});
    }
    batch.add(
        ContactQuery{here(), there(), tolerance, 0.1, ContactNormals::analytic, false, technique});
    batch.add(ClosestPointQuery{here(), apart, tolerance, technique});
    batch.add(SeparationQuery{here(), apart, tolerance, technique});
    batch.add(IntersectionTestQuery{here(), there()});
    batch.add(ContainmentQuery{here(), here()});
    batch.add(TimeOfImpactQuery{here(), apart, there().pose, apart.pose, tolerance});
    batch.add(SeparationVectorQuery{here(), there(), tolerance});
    for (const IntersectionKind kind :
         {IntersectionKind::boundary_boundary, IntersectionKind::boundary_volume,
          IntersectionKind::volume_volume}) {
        batch.add(IntersectionQuery{here(), there(), tolerance, kind, false,
                                    IntersectionStrategy::stencil, technique});
    }
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        batch.add(IntersectionQuery{here(), there(), tolerance, IntersectionKind::volume_volume,
                                    false, static_cast<IntersectionStrategy>(i), technique});
    }
    field.features = field.gradients = true;
    field.points = field_points;
    for (const SignEncoding sign :
         {SignEncoding::stencil, SignEncoding::color, SignEncoding::feature_bit}) {
        field.sign = sign;
        batch.add(field);
    }
    if (technique == Technique::raster) {
        field.gradient = GradientMethod::blended;
        batch.add(field);
    }
    batch.add(
        ContactQuery{here(), there(), tolerance, 0.1, ContactNormals::gradient, false, technique});
    return batch;
}

Batch World::overlap(double cells) const {
    Batch batch;
    batch.add(IntersectionQuery{here(), there(), 1.0 / cells, IntersectionKind::volume_volume,
                                false, IntersectionStrategy::stencil, technique_});
    return batch;
}

StatusCode code_of(VkResult error) {
    switch (error) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return StatusCode::out_of_memory;
        case VK_ERROR_DEVICE_LOST:
            return StatusCode::device_lost;
        default:
            return StatusCode::device_error;
    }
}

const char* to_string(World::Step step) {
    switch (step) {
        case World::Step::create:
            return "create";
        case World::Step::add_shapes:
            return "add shapes";
        case World::Step::submit_first:
            return "submit the first batch";
        case World::Step::collect_first:
            return "collect the first batch";
        case World::Step::submit_larger:
            return "submit a larger batch";
        case World::Step::collect_larger:
            return "collect a larger batch";
        case World::Step::record:
            return "record a batch";
        case World::Step::collect_recorded:
            return "collect the recorded batch";
        case World::Step::record_in_vain:
            return "record a batch that is thrown away";
        case World::Step::collect_unexecuted:
            return "collect the batch that was thrown away";
        case World::Step::submit_without_work:
            return "submit a batch without work for the device";
        case World::Step::collect_without_work:
            return "collect the batch without work for the device";
        case World::Step::submit_last:
            return "submit the last batch";
        case World::Step::record_last:
            return "record the last batch";
        case World::Step::destroy:
            return "destroy";
    }
    return "";
}

}  // namespace nearfield::test
