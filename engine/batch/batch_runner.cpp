#include <engine/base/catch_to_status.hpp>
#include <engine/base/interruption.hpp>
#include <engine/batch/batch_runner.hpp>
#include <engine/queries/empty_result.hpp>
#include <engine/queries/query_timer.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace nearfield::batch {
namespace {

/// Index of a query's entry among those that stay on the device.
template <class Output>
std::size_t place_of(const std::vector<Output>& all, std::uint32_t query) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [query](const Output& one) { return one.query == query; });
    return static_cast<std::size_t>(found - all.begin());
}

/// The error of a query whose points do not all stay.
Status no_room(const device_input::BufferOutput& records, std::uint32_t count) {
    const std::uint64_t bytes =
        sizeof(SummaryData) + std::uint64_t{std::max(count, records.capacity)} * sizeof(PointData);
    return {StatusCode::overflow,
            "query " + std::to_string(records.query) + " has " + std::to_string(count) +
                " points, and what stays on the device has room for " +
                std::to_string(records.capacity) +
                (records.target.buffer == VK_NULL_HANDLE
                     ? "; that of the next batch has room for as many"
                     : "; a buffer of " + std::to_string(bytes) + " bytes has room for as many")};
}

}  // namespace

BatchRunner::BatchRunner(Planning& planning, render::Renderer* renderer)
    : planning_(&planning),
      renderer_(renderer),
      slot_(renderer == nullptr ? nullptr : renderer->make_resources()),
      answers_(renderer == nullptr ? "" : renderer->gradient_format()) {}

void BatchRunner::begin_timings(std::size_t queries) {
    Timings& timings = results_.timings;
    timings.queries.assign(times_queries_ ? queries : 0, {});
    plan_.times = timings.queries;
    timings.localize = timings.plan = timings.record = timings.device = 0.0;
    timings.decode = timings.total = 0.0;
    // Names stay, so that a frame like the one before allocates nothing; passes that have not run
    // are dropped at the end.
    for (PassTime& pass : timings.passes) {
        pass.milliseconds = -1.0;
    }
}

/// Results of a batch larger than this one wait for the next such batch.
void BatchRunner::resize_results(std::size_t queries) {
    std::vector<AnyResult>& results = results_.results;
    while (results.size() > queries) {
        spare_results_.push_back(std::move(results.back()));
        results.pop_back();
    }
    while (results.size() < queries) {
        if (spare_results_.empty()) {
            results.resize(queries);
            break;
        }
        results.push_back(std::move(spare_results_.back()));
        spare_results_.pop_back();
    }
}

void BatchRunner::make_tile_batches() {
    std::span<const device_input::ComputeBatch> computed;
    if (slot_ != nullptr) {
        std::uint32_t tile_batches = 0;
        for (const auto& tiles : slot_->tiles()) {
            tiles->build(plan_);
            for (std::uint32_t number = 0; number < tiles->count(); ++number) {
                note_places(tiles->batch(number), tile_batches++);
            }
        }
        computed = slot_->computed().batches();
    }
    resident_outputs_builder_.build(plan_, computed, results_.results,
                                    renderer_ == nullptr ? 0 : renderer_->expected_records(),
                                    resident_);
}

/// For list_tiles(), which does not need the tile batch any more.
void BatchRunner::note_places(const device_input::TileBatch& batch, std::uint32_t number) {
    for (std::size_t i = 0; i < batch.tiles.size(); ++i) {
        device_input::PlannedTile& tile = plan_.tiles[batch.tile_index[i]];
        tile.tile_batch = number;
        tile.atlas_x = batch.tiles[i].atlas_x;
        tile.atlas_y = batch.tiles[i].atlas_y;
    }
}

/// Divides the queries between the CPU and the device, and plans what the device answers. Those
/// that are rejected are left to neither.
void BatchRunner::check_queries() {
    for_cpu_.clear();
    for_device_.clear();
    for (std::uint32_t i = 0; i < queries_.size(); ++i) {
        checkpoint();
        const queries::QueryTimer timer(results_.timings.queries, i, &QueryTime::plan);
        queries::CheckedQuery checked;
        if (queries::check(i, queries_[i], shapes_[i], planning_->limits, checked,
                           results_.results[i])) {
            take(checked);
        }
    }
}

void BatchRunner::take(const queries::CheckedQuery& checked) {
    if (checked.technique == Technique::cpu) {
        for_cpu_.push_back(checked);
        return;
    }
    if (for_device_.empty()) {
        planning_->planner.begin(queries_.size(), plan_);
    }
    for_device_.push_back(checked.index);
    const auto plan_drawn_points = [this](device_input::CurrentQuery& current, AnyResult& result) {
        renderer_->plan_drawn_points(current, result);
    };
    planning_->planner.add(checked, plan_drawn_points, plan_, results_.results[checked.index]);
}

/// Makes what the device needs.
void BatchRunner::finish_plan() {
    planning_->planner.finish(plan_);
    answers_.begin_batch(plan_);
    make_tile_batches();
    results_.timings.localize += plan_.localize_milliseconds;
}

/// Everything up to the recording of tile batches. If the call ends before, nothing is left to do.
void BatchRunner::begin(std::span<const AnyQuery> queries, const queries::FindShape& find_shape,
                        render::SampleRoom room, Laps& laps) {
    if (submission_state() == render::SubmissionState::submitted) {
        slot_->wait();  // for a batch that failed half-way
    }
    late_failure_ = nullptr;
    Timings& timings = results_.timings;
    begin_timings(queries.size());
    queries_.assign(queries.begin(), queries.end());
    queries::find_shapes(queries_, find_shape, shapes_);
    expect_answers(queries_.size());
    resize_results(queries_.size());
    try {
        choose_techniques(queries_, shapes_, planning_->rule);
        check_queries();
        if (!for_device_.empty()) {
            finish_plan();
        }
    } catch (const Interrupted& interrupted) {
        for_cpu_.clear();
        for_device_.clear();
        for (std::size_t i = 0; i < queries_.size(); ++i) {
            queries::make_refused(queries_[i], interrupted.status(), results_.results[i]);
        }
    }
    timings.plan += laps.next() - timings.localize;
    if (has_device_work()) {
        renderer_->prepare(resident_, planning_->planner.search_shapes(), plan_.pairs, room, *slot_,
                           timings);
        laps.next();
    }
}

void BatchRunner::reserve(std::span<const AnyQuery> queries, const queries::FindShape& find_shape) {
    Laps laps;
    begin(queries, find_shape, render::SampleRoom::likely, laps);
    if (slot_ != nullptr) {
        slot_->release();
    }
}

void BatchRunner::trim() noexcept {
    if (renderer_ != nullptr && submission_state() == render::SubmissionState::none) {
        static_cast<void>(catch_to_status([this] { slot_ = renderer_->make_resources(); }));
    }
}

/// Resident samples need the device even without tile batches: to state that there are none.
bool BatchRunner::has_device_work() const {
    return !for_device_.empty() &&
           (!plan_.tiles.empty() || !plan_.pairs.directions.empty() || !resident_.empty());
}

void BatchRunner::solve(Laps& laps) {
    planning_->solvers.answer(for_cpu_, for_device_.empty() ? 0.0 : plan_.result_bytes,
                              results_.timings.queries, results_.results);
    results_.timings.decode += laps.next();
}

void BatchRunner::submit(std::span<const AnyQuery> queries, const queries::FindShape& find_shape,
                         Laps& laps, const Submission& order) {
    begin(queries, find_shape, render::SampleRoom::likely, laps);
    bool is_submitted = has_device_work();
    if (is_submitted) {
        renderer_->submit(*slot_, order, results_.timings);
        submitted_ = {};
        device_milliseconds_.reset();
        laps.next();
    } else if (slot_ != nullptr) {
        slot_->submit_semaphores(order);
        is_submitted = !order.waits.empty() || !order.signals.empty();
    }
    try {
        solve(laps);
    } catch (...) {
        if (!is_submitted) {
            throw;
        }
        // It must still be reported to the host, since semaphores will be signalled.
        late_failure_ = std::current_exception();
    }
}

void BatchRunner::record(std::span<const AnyQuery> queries, const queries::FindShape& find_shape,
                         Laps& laps, VkCommandBuffer commands, std::uint32_t stamp) {
    begin(queries, find_shape, render::SampleRoom::all, laps);
    solve(laps);
    if (has_device_work()) {
        renderer_->record(*slot_, commands, stamp, results_.timings);
        device_milliseconds_ = 0.0;  // only the host knows
        laps.next();
    }
}

template <class Query>
void BatchRunner::require_on_device(QueryHandle<Query> handle) const {
    const auto refuse = [&](const std::string& why) {
        throw StatusException({StatusCode::invalid_query,
                               "on_device: query " + std::to_string(handle.index) + " " + why});
    };
    if (handle.batch != results_.batch && handle.batch != 0) {
        refuse("is of another batch, or of the same one before it was cleared");
    }
    if (handle.index >= queries_.size()) {
        refuse("is none of the batch, which has " + std::to_string(queries_.size()));
    }
    const auto* const query = std::get_if<Query>(&queries_[handle.index]);
    if (query == nullptr) {
        refuse("is of another kind than its handle says");
    } else if (!query->on_device) {
        refuse("did not ask for results that stay on the device (on_device)");
    }
    const Status& status =
        std::visit([](const auto& result) -> const Status& { return result.status; },
                   results_.results[handle.index]);
    if (!status.ok()) {
        throw StatusException(status);
    }
}

template void BatchRunner::require_on_device(QueryHandle<PenetrationQuery>) const;
template void BatchRunner::require_on_device(QueryHandle<ContactQuery>) const;

FieldOnDevice BatchRunner::on_device(QueryHandle<DistanceFieldQuery> handle) const {
    require_on_device(handle);
    return slot_->resident().field(place_of(resident_.fields, handle.index));
}

SamplesOnDevice BatchRunner::on_device(QueryHandle<IntersectionQuery> handle) const {
    require_on_device(handle);
    return slot_->resident().samples(place_of(resident_.samples, handle.index));
}

PointsOnDevice BatchRunner::resident_records(std::uint32_t query) const {
    return slot_->resident().records(place_of(resident_.records, query));
}

bool BatchRunner::is_done() {
    if (slot_ != nullptr && !slot_->is_done()) {
        return false;
    }
    if (submission_state() == render::SubmissionState::submitted && !device_milliseconds_) {
        device_milliseconds_ = submitted_.milliseconds();
    }
    return true;
}

void BatchRunner::wait() {
    Timings& timings = results_.timings;
    renderer_->wait(*slot_, timings);
    timings.device += device_milliseconds_.value_or(submitted_.milliseconds());
}

/// Waits for the device and reads what it wrote, as often as it has to be submitted.
void BatchRunner::read_back(Laps& laps) {
    Timings& timings = results_.timings;
    while (submission_state() != render::SubmissionState::none) {
        const bool was_recorded = submission_state() == render::SubmissionState::recorded;
        wait();
        laps.next();
        for (const auto& tiles : slot_->tiles()) {
            for (const std::uint32_t number : tiles->running()) {
                if (tiles->had_room(number)) {
                    checkpoint();
                    decode(*tiles, number);
                }
            }
        }
        take_found_pairs(was_recorded);
        timings.decode += laps.next();
        if (!was_recorded && renderer_->submit_those_without_room(*slot_, timings)) {
            submitted_ = {};
            device_milliseconds_.reset();
            laps.next();
        }
    }
}

/// What the host has submitted is not repeated: the CPU answers what there was no room for.
void BatchRunner::take_found_pairs(bool was_recorded) {
    const render::GivenSearch* const search = slot_->running_search();
    if (search == nullptr) {
        return;
    }
    if (!search->had_room()) {
        if (was_recorded) {
            answers_.pairs().leave_to_cpu();
            static_cast<void>(slot_->select_those_without_room());  // the next commands have room
        }
        return;
    }
    for (std::size_t i = 0; i < search->found().parts(); ++i) {
        checkpoint();
        const render::PairPartMemory& part = search->found().part(i);
        answers_.pairs().add(part.rows(), part.records());
    }
}

void BatchRunner::collect(Laps& laps) {
    Timings& timings = results_.timings;
    try {
        read_back(laps);
    } catch (const Interrupted&) {
        // Below, the queries whose results were not all read say so.
    }
    if (slot_ != nullptr) {
        slot_->release();
    }
    if (late_failure_) {
        std::rethrow_exception(std::exchange(late_failure_, nullptr));
    }
    if (!for_device_.empty()) {
        queries::MemoryBudget memory(planning_->limits);
        memory.add(plan_.result_bytes);
        planning_->writer.write(plan_, for_device_, answers_, memory, results_.results);
        solve_what_had_no_room();
        check_room_for_records();
        timings.decode += laps.next();
    }
    std::erase_if(timings.passes, [](const PassTime& pass) { return pass.milliseconds < 0.0; });
    time_device();
}

/// What was found of these queries did not fit the memory of a search that is not repeated.
void BatchRunner::solve_what_had_no_room() {
    if (!answers_.pairs().are_left_to_cpu()) {
        return;
    }
    for_cpu_.clear();
    for (const std::uint32_t index : for_device_) {
        const device_input::PlannedQuery& planned = plan_.queries[index];
        if (planned.has_points_of(device_input::PointSource::device)) {
            ResultSummary& result = std::visit([](auto& any) -> ResultSummary& { return any; },
                                               results_.results[index]);
            result.regions.clear();  // of the search
            if (result.status.ok()) {
                for_cpu_.push_back(planned);
            }
        }
    }
    planning_->solvers.answer(for_cpu_, plan_.result_bytes, results_.timings.queries,
                              results_.results);
}

/// Says in the results which records that stay were more than there was room for.
void BatchRunner::check_room_for_records() {
    for (const device_input::BufferOutput& records : resident_.records) {
        std::visit(
            [&](auto& result) {
                if constexpr (requires { result.count, result.points; }) {
                    if (!result.status.ok()) {
                        return;
                    }
                    renderer_->note_records(result.count);
                    if (result.count > records.capacity || answers_.pairs().are_left_to_cpu()) {
                        result.status = no_room(records, result.count);
                    }
                }
            },
            results_.results[records.query]);
    }
}

/// The position of the query that all work on the device was for, if it was for one alone.
std::optional<std::size_t> BatchRunner::only_query_on_device() const {
    if (for_device_.empty()) {
        return std::nullopt;
    }
    const AnyQuery* only = nullptr;
    bool is_only = true;
    const auto add = [&](std::uint32_t planned) {
        const AnyQuery* const query = plan_.queries[planned].query;
        is_only = is_only && (only == nullptr || only == query);
        only = query;
    };
    for (const device_input::PlannedTile& tile : plan_.tiles) {
        add(tile.query);
    }
    for (const shaders::SearchDirectionData& searched : plan_.pairs.directions) {
        add(searched.a);
    }
    // Even without tiles these have passes that state that there is nothing.
    for (const device_input::SamplesOutput& samples : resident_.samples) {
        add(samples.query);
    }
    return is_only && only != nullptr
               ? std::optional(static_cast<std::size_t>(only - queries_.data()))
               : std::nullopt;
}

/// The passes are attributed only where they worked for one query alone.
void BatchRunner::time_device() {
    Timings& timings = results_.timings;
    if (timings.queries.empty() || timings.passes.empty()) {
        return;
    }
    if (const std::optional<std::size_t> query = only_query_on_device()) {
        double& sum = timings.queries[*query].device.emplace(0.0);
        for (const PassTime& pass : timings.passes) {
            sum += pass.milliseconds;
        }
    }
}

void BatchRunner::list_tiles(std::vector<TileReport>& reports) const {
    reports.clear();
    for (const device_input::PlannedTile& tile : plan_.tiles) {
        const device_input::PlannedQuery& planned = plan_.queries[tile.query];
        const geometry::Vector low = tile.origin();
        const geometry::Vector high =
            low + tile.grid.cell * geometry::Vector(tile.width, tile.height);
        TileReport& report = reports.emplace_back();
        report.query = planned.index;
        report.technique = planned.technique;
        // The other direction of a query follows all queries of the batch.
        report.side = planned.index == tile.query ? Side::a : Side::b;
        report.min = geometry::to_public(low);
        report.max = geometry::to_public(high);
        report.width = tile.width;
        report.height = tile.height;
        report.tile_batch = tile.tile_batch;
        report.x = tile.atlas_x;
        report.y = tile.atlas_y;
    }
}

void BatchRunner::decode(const render::TileWork& tiles, std::uint32_t number) {
    const device_input::TileBatch& batch = tiles.batch(number);
    std::vector<AnyResult>& results = results_.results;
    answers_.add_points(batch, tiles.points(number));
    answers_.add_field(plan_, batch, tiles.field_words(number), results);
    if (tiles.left_fields(number)) {
        answers_.refuse_fields(plan_, batch);
    }
    DeviceAnswers::add_summaries(plan_, batch, tiles.summaries(number), results);
    answers_.add_samples(plan_, batch, tiles.samples(number));
}

}  // namespace nearfield::batch
