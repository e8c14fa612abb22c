// Tables of pairs: what is asked, who answers it, and how the CPU does.

#include <engine/base/interruption.hpp>
#include <engine/base/jobs.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/batch/call_within.hpp>
#include <engine/narrowphase/overlap_test.hpp>
#include <engine/queries/error_budget.hpp>
#include <engine/solvers/penetration.hpp>
#include <engine/world/checks.hpp>
#include <engine/world/motions.hpp>
#include <engine/world/pair_list.hpp>
#include <engine/world/pair_row.hpp>
#include <engine/world/pair_table_state.hpp>
#include <engine/world/world_state.hpp>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace nearfield {
namespace table {

/// The number of pairs that a job takes at a time.
constexpr std::size_t pairs_of_part = 128;
constexpr std::size_t queries_of_batch = 4096;
constexpr double largest_headroom = 1024.0;

template <class Query>
constexpr bool has_distance = requires(const typename Query::Result& result) {
    result.distance;
};

/// Where the list of a row is, among those of all rows.
struct Slice {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// The lists of all rows of a table. They stay where they are while rows come and go, until those
/// of rows that are gone take more memory than the others.
template <class Element>
class RowLists {
public:
    void clear() { elements_.clear(); }
    [[nodiscard]] Slice add(std::span<const Element> list) {
        if (elements_.size() + list.size() > UINT32_MAX) {
            throw StatusException({StatusCode::too_large,
                                   "update: the table has more records than 32 bits can count"});
        }
        const Slice slice{static_cast<std::uint32_t>(elements_.size()),
                          static_cast<std::uint32_t>(list.size())};
        elements_.insert(elements_.end(), list.begin(), list.end());
        return slice;
    }
    [[nodiscard]] std::span<const Element> operator[](const Slice& slice) const {
        return std::span(elements_).subspan(slice.first, slice.count);
    }
    /// Drops the lists of rows that are gone, if they take much memory. `slices`: of the others.
    void compact(std::span<Slice> slices) {
        std::size_t used = 0;
        for (const Slice& slice : slices) {
            used += slice.count;
        }
        if (elements_.size() <= 2 * used) {
            return;
        }
        before_.swap(elements_);
        elements_.clear();
        for (Slice& slice : slices) {
            const auto list = std::span(before_).subspan(slice.first, slice.count);
            slice.first = static_cast<std::uint32_t>(elements_.size());
            elements_.insert(elements_.end(), list.begin(), list.end());
        }
    }

private:
    std::vector<Element> elements_;
    std::vector<Element> before_;  // memory for compact()
};

/// What a result lists, if its kind lists anything.
template <class Result>
const auto& points_of(const Result& result) requires requires {
    result.points;
}
{ return result.points; }
template <class Result>
const auto& points_of(const Result& result) requires requires {
    result.samples;
}
{ return result.samples; }

/// Rows, and where their lists are; of queries without lists there are no slices.
template <class Query>
struct Content {
    std::vector<PairRow<Query>> rows;
    std::vector<Slice> records;
    std::vector<Slice> manifolds;  // of contacts

    void clear() {
        rows.clear();
        records.clear();
        manifolds.clear();
    }
    /// Appends consecutive rows of another one.
    void add(const Content& from, std::size_t first, std::size_t end) {
        const std::size_t before = rows.size();
        append(from.rows, first, end, rows);
        for (std::size_t i = before; i < rows.size(); ++i) {
            rows[i].index = static_cast<std::uint32_t>(i);
        }
        append(from.records, first, end, records);
        append(from.manifolds, first, end, manifolds);
    }

private:
    template <class Element>
    static void append(const std::vector<Element>& from, std::size_t first, std::size_t end,
                       std::vector<Element>& to) {
        if (!from.empty()) {
            to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(first),
                      from.begin() + static_cast<std::ptrdiff_t>(end));
        }
    }
};

/// Two instances by their indices in the world.
struct Pair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
};

/// What one job needs to answer pairs in place.
struct Job {
    narrowphase::OverlapTest overlap_test;
    std::optional<solvers::PenetrationSolver> penetration;  // whose construction may fail
    PenetrationResult result;
};

/// The lists that one job has found.
template <class Query>
struct JobLists {
    RowLists<typename Query::Result::Point> points;
    RowLists<ContactCluster> manifolds;
};

/// Whether the CPU answers these queries from what the world keeps of its instances, which is
/// quicker.
static bool is_answered_in_place(const IntersectionTestQuery& /*query*/) {
    return true;
}
static bool is_answered_in_place(const PenetrationQuery& query) {
    return query.points == PenetrationPoints::vertices && query.summary_only;
}

/// The answer for two instances whose shapes exist. A result would take longer to make than most
/// answers.
static void answer(const IntersectionTestQuery& /*query*/, const world::Instances& instances,
                   const Pair& pair, Job& job, PairRow<IntersectionTestQuery>& row) {
    row.status = StatusCode::ok;
    row.error_bound = instances.rounding(pair.a) + instances.rounding(pair.b) +
                      instances.deviation(pair.a) + instances.deviation(pair.b);
    row.intersects = instances.intersect(pair.a, pair.b, job.overlap_test);
}

static void answer(const PenetrationQuery& query, const world::Instances& instances,
                   const Pair& pair, Job& job, PairRow<PenetrationQuery>& row) {
    PenetrationResult& result = job.result;
    result.intersects = false;
    result.count = 0;
    result.deepest = {};
    const queries::Deviations deviations{instances.deviation(pair.a), instances.deviation(pair.b)};
    result.error_bound = queries::penetration_budget(query, deviations).bound;
    result.status = queries::check_deviations(query.tolerance, deviations, result.error_bound);
    if (result.status.ok()) {
        result.status = queries::check_resolution(
            query.tolerance, std::max(instances.magnitude(pair.a), instances.magnitude(pair.b)));
    }
    if (result.status.ok() && instances.boxes_meet(pair.a, pair.b)) {
        if (!job.penetration) {
            job.penetration.emplace();
        }
        const simd::TransformedEdges& a = instances.edges(pair.a);
        const simd::TransformedEdges& b = instances.edges(pair.b);
        job.penetration->answer(query,
                                {&a.placed.polygon(), &b.placed.polygon(), instances[pair.a].pose,
                                 instances[pair.b].pose},
                                a, b, result);
    }
    row = row_of<PenetrationQuery>({}, {}, result);
}

/// Writes the row of a pair that is answered in place.
template <class Query>
void answer_pair(const Query& query, const world::Instances& instances, const Pair& pair, Job& job,
                 PairRow<Query>& row) {
    if (instances.is_placed(pair.a) && instances.is_placed(pair.b)) {
        answer(query, instances, pair, job, row);
    } else {
        row = {};
        row.status = StatusCode::unknown_shape;
    }
    row.a = instances.handle(pair.a);
    row.b = instances.handle(pair.b);
}

/// The technique that the caller asks for, of the table or else of the query.
static Technique asked_technique(const char* call, const AnyQuery& query,
                                 const PairTableOptions& options) {
    const Technique own = std::visit([](const auto& any) { return any.technique; }, query);
    if (own != Technique::automatic && options.technique != Technique::automatic &&
        own != options.technique) {
        refuse(call,
               "the table is answered by Technique::" + std::string(to_string(options.technique)) +
                   ", and its query asks for Technique::" + to_string(own));
    }
    return options.technique != Technique::automatic ? options.technique : own;
}

static bool is_on_device(const AnyQuery& query) {
    return std::visit(
        [](const auto& any) {
            if constexpr (requires { any.on_device; }) {
                return any.on_device;
            } else {
                return false;
            }
        },
        query);
}

/// What Technique::automatic is for a table. `needs_device`: nothing else can answer it.
static Technique automatic_technique(const Context::Implementation& context, const AnyQuery& query,
                                     const PairTableOptions& options, bool needs_device) {
    const bool is_quick = context.device() != nullptr && !context.device()->is_software() &&
                          context.techniques().compute;
    const bool is_answered =
        options.hits_only && !options.listed && device_input::is_for_all_pairs(query);
    return needs_device || (is_quick && is_answered) ? Technique::compute : Technique::cpu;
}

/// Refuses what the device does not answer about the pairs that it finds.
static void require_for_device(const char* call, const AnyQuery& query,
                               const PairTableOptions& options) {
    if (!options.hits_only) {
        refuse(call,
               "Technique::compute finds the pairs that are hit; a table of all candidates "
               "(hits_only = false) is for Technique::cpu");
    }
    if (!device_input::is_for_all_pairs(query)) {
        refuse(call, std::holds_alternative<ContactQuery>(query)
                         ? "the contacts of these pairs have analytic normals"
                         : "Technique::compute does not answer this query of pairs of a world");
    }
    const auto* const penetration = std::get_if<PenetrationQuery>(&query);
    const auto* const contacts = std::get_if<ContactQuery>(&query);
    if ((penetration != nullptr && penetration->target != nullptr) ||
        (contacts != nullptr && contacts->target != nullptr)) {
        refuse(call, "the table's query names a target; that of a table is PairTableInput::target");
    }
}

}  // namespace table

template <class Action>
void PairTableBase::State::run_or_start_anew(const Action& action) {
    const Status status = context_->unless_lost(action);
    if (!status.ok()) {
        start_anew();
        throw StatusException(status);
    }
}

void PairTableBase::State::start_anew() {
    is_submitted = false;
    row_count = candidate_count = answer_count = 0;
    forget_answers();
    forget_exact_rows();
    if (device != nullptr) {
        device->start_anew();
    }
}

void PairTableBase::State::require_collected(const char* call) const {
    if (device != nullptr) {
        device->require_collected(call);
    }
    if (is_submitted) {
        throw StatusException(
            {StatusCode::not_ready,
             std::string(call) + ": the table was submitted, and has not been collected since"});
    }
}

void PairTableBase::State::choose(const char* call, const WorldView& world,
                                  const PairTableInput& input, bool is_recorded) {
    if (!(options.reach >= 0.0 && options.reach <= largest_coordinate)) {
        refuse(call, "the reach is " + geometry::number(options.reach) +
                         "; it must be a finite number of at least 0");
    }
    if (!(options.headroom >= 1.0 && options.headroom <= table::largest_headroom)) {
        refuse(call, "the headroom is " + geometry::number(options.headroom) +
                         "; it must be at least 1 and at most " +
                         geometry::number(table::largest_headroom));
    }
    if (input.a.size() != input.b.size()) {
        refuse(call, std::to_string(input.a.size()) + " and " + std::to_string(input.b.size()) +
                         " instances form no pairs");
    }
    if (!options.listed && !input.a.empty()) {
        refuse(call, "pairs are given to a table that finds its own");
    }
    if (!std::holds_alternative<TimeOfImpactQuery>(query) &&
        !(input.moving.empty() && input.ends.empty())) {
        refuse(call, "motions are given to a table that asks for no times of impact");
    }
    if (input.target != nullptr && !table::is_on_device(query)) {
        refuse(call,
               "a target is given to a table whose query leaves nothing on the device "
               "(PenetrationQuery::on_device)");
    }
    const bool needs_device = is_recorded || input.poses != nullptr || table::is_on_device(query);
    Technique technique = table::asked_technique(call, query, options);
    if (technique == Technique::automatic) {
        technique = table::automatic_technique(world.context, query, options, needs_device);
    }
    if (technique == Technique::raster) {
        refuse(call, "pairs of a world are answered by Technique::cpu or compute");
    }
    technique_ = technique;
    if (technique == Technique::compute && !options.listed) {
        table::require_for_device(call, query, options);
        if (device == nullptr) {
            start_anew();
            device = std::make_unique<DevicePairs>(query, options, timings);
        }
    } else {
        if (needs_device) {
            refuse(call,
                   std::string("commands of the host, poses that they write and results on the "
                               "device are for Technique::compute; the table ") +
                       (technique == Technique::compute ? "has a list of pairs"
                                                        : "is answered by Technique::cpu"));
        }
        if (device != nullptr) {
            start_anew();
            device.reset();
        }
    }
}

void PairTableBase::State::begin(const char* call, const WorldView& world,
                                 const PairTableInput& input, const Recording* recording) {
    choose(call, world, input, recording != nullptr);
    read_status = {};
    forget_exact_rows();
    if (device != nullptr) {
        device->start(call, world, input, recording);
        return;
    }
    const Stopwatch total;
    timings.plan = timings.record = timings.device = 0.0;
    timings.passes.clear();
    answer(call, world, input);
    is_submitted = true;
    timings.total = total.milliseconds();
    timings.decode = timings.total - timings.plan - timings.device;
}

void PairTableBase::State::start(const char* call, const WorldView& world,
                                 const PairTableInput& input, const Recording* recording) {
    require_collected(call);
    context_ = world.context.shared_from_this();
    run_or_start_anew([&] { begin(call, world, input, recording); });
}

void PairTableBase::State::finish() {
    run_or_start_anew([&] {
        if (device != nullptr) {
            device->finish();
        }
        is_submitted = false;
    });
    if (device != nullptr) {
        device->require_room_of_target();
    }
}

void PairTableBase::State::collect() {
    const bool is_for_frame = device != nullptr && device->is_for_frame();
    if (is_for_frame) {
        device->require_complete_frame("collect");
    } else if (!is_submitted && (device == nullptr || !device->is_submitted())) {
        throw StatusException({StatusCode::not_ready, "collect: the table was not submitted"});
    }
    read_status = {};
    forget_exact_rows();
    if (is_for_frame) {
        device->collect_recorded();
    } else {
        finish();
    }
}

PairTableBase::PairTableBase(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
PairTableBase::~PairTableBase() = default;
PairTableBase::PairTableBase(PairTableBase&&) noexcept = default;
PairTableBase& PairTableBase::operator=(PairTableBase&&) noexcept = default;

const PairTableOptions& PairTableBase::options() const noexcept {
    return state_->options;
}

std::uint32_t PairTableBase::size() const noexcept {
    return state_->size();
}

std::uint32_t PairTableBase::candidates() const noexcept {
    return state_->count(&DevicePairs::candidates, state_->candidate_count);
}

std::uint32_t PairTableBase::left_to_cpu() const noexcept {
    return state_->count(&DevicePairs::left_to_cpu, state_->answer_count);
}

const Timings& PairTableBase::timings() const noexcept {
    return state_->timings;
}

Status PairTableBase::collect(const Limits& limits) {
    return catch_within(limits, [&] { state_->collect(); });
}

bool PairTableBase::is_ready() const noexcept {
    return state_->device != nullptr ? state_->device->is_ready() : state_->is_submitted;
}

PairTableCounts PairTableBase::found() const noexcept {
    return state_->device != nullptr ? state_->device->found() : PairTableCounts{};
}

PairTableCounts PairTableBase::capacity() const noexcept {
    return state_->device != nullptr ? state_->device->capacity() : PairTableCounts{};
}

void PairTableBase::trim() noexcept {
    if (state_->device != nullptr) {
        state_->device->trim();
    }
}

Expected<PairsOnDevice> PairTableBase::on_device() const {
    return catch_to_expected([&] {
        if (!table::is_on_device(state_->query)) {
            refuse("on_device", "the table's query does without results that stay on the device");
        }
        if (state_->device == nullptr) {
            throw StatusException(
                {StatusCode::not_ready, "on_device: the table was not submitted"});
        }
        return state_->device->on_device();
    });
}

const Status& PairTableBase::read_status() const noexcept {
    return state_->read_status;
}

/// The rows of a table of one kind, and how they are answered unless the device finds the pairs.
template <class Query>
struct PairTable<Query>::Rows final : State {
    using Row = PairRow<Query>;

    Rows(const Query& asked, const PairTableOptions& how) : State(asked, how) {}

    [[nodiscard]] std::span<const Row> rows() {
        if (device != nullptr) {
            make_exact();
        }
        return std::span(now_.rows).first(size());
    }
    [[nodiscard]] Row row(std::uint32_t index) {
        if (index >= size()) {
            refuse("row", "there is no row " + std::to_string(index) + "; the table has " +
                              std::to_string(size()));
        }
        return device == nullptr || are_exact_ ? now_.rows[index] : exact_row(index);
    }
    [[nodiscard]] std::span<const Point> points(const Row& row) {
        if (row.index >= size() || row.point_count == 0) {
            return {};
        }
        if constexpr (requires { device->records(0U, points_); }) {
            if (device != nullptr) {
                device->records(row.index, points_);
                return points_;
            }
        }
        return points_of_rows_[now_.records[row.index]];
    }
    [[nodiscard]] std::span<const ContactCluster> manifold(const Row& row) {
        if (row.index >= size()) {
            return {};
        }
        if (device != nullptr) {
            device->manifold(row.index, manifold_);
            return manifold_;
        }
        return manifolds_of_rows_[now_.manifolds[row.index]];
    }
    /// Does what reads rows, unless there is no memory for it.
    template <class Read>
    auto read(const Read& read_rows) noexcept {
        decltype(read_rows()) found;
        if (Status status = catch_to_status([&] { found = read_rows(); }); !status.ok()) {
            read_status = std::move(status);
        }
        return found;
    }

private:
    void answer(const char* call, const WorldView& world, const PairTableInput& input) override {
        const Query query = asked(call, world.context);
        world.prepare();
        if (world_.lock() != world.identity) {
            forget_answers();
            world_ = world.identity;
            jobs_.emplace(world.context.jobs());
            scratch_ = std::vector<table::Job>(jobs_->count());
        }
        if (options.listed) {
            answer_list(call, world, query, input);
        } else {
            find_overlapping_boxes(call, world.instances, input);
            answer_new_pairs(world, query);
            merge_rows();
        }
        row_count = static_cast<std::uint32_t>(now_.rows.size());
    }

    void forget_answers() override {
        motions_.clear();
        list_.clear();
        row_of_.clear();
        now_.clear();
        points_of_rows_.clear();
        manifolds_of_rows_.clear();
        world_.reset();
    }

    void forget_exact_rows() override { are_exact_ = false; }

    void make_exact() {
        if (are_exact_) {
            return;
        }
        now_.clear();
        now_.rows.resize(size());
        for (std::uint32_t i = 0; i < size(); ++i) {
            now_.rows[i] = exact_row(i);
        }
        are_exact_ = true;
    }

    /// Of the device.
    [[nodiscard]] Row exact_row(std::uint32_t index) {
        Row row;
        if constexpr (requires { device->row(index, row); }) {
            device->row(index, row);
        }
        row.index = index;
        return row;
    }

    [[nodiscard]] Query asked(const char* call, const Context::Implementation& context) const {
        Query query = std::get<Query>(this->query);
        query.technique = technique_;
        require_answered(call, query, context);
        if (options.listed && has_motions) {
            refuse(call, "times of impact are not asked of a list of pairs");
        }
        return query;
    }

    /// How far apart the boxes of candidates may be.
    [[nodiscard]] double reach() const {
        // No other answers make hits of pairs that are farther apart.
        const double reach = options.hits_only && !table::has_distance<Query> ? 0.0 : options.reach;
        if constexpr (requires(Query query) { query.contact_distance; }) {
            return std::max(reach, std::get<Query>(query).contact_distance);
        } else {
            return reach;
        }
    }

    void find_overlapping_boxes(const char* call, const world::Instances& instances,
                                const PairTableInput& input) {
        const Stopwatch start;
        if constexpr (has_motions) {
            require_moves(call, instances, input.moving, input.ends);
            motions_.update(instances, input.moving, input.ends);
            list_.update(instances, motions_, reach());
        } else {
            list_.update(instances, reach(), !device_input::is_symmetric<Query>);
        }
        candidate_count = static_cast<std::uint32_t>(list_.pairs().size());
        timings.plan = start.milliseconds();
    }

    /// Those that are new or have changed.
    void answer_new_pairs(const WorldView& world, const Query& query) {
        const auto pairs = list_.pairs();
        const auto fresh = list_.new_pairs();
        answer_pairs(world, query, fresh.size(), [&](std::size_t i) {
            const world::PairList::Pair& pair = pairs[fresh[i]];
            return table::Pair{pair.a, pair.b};
        });
    }

    void answer_list(const char* call, const WorldView& world, const Query& query,
                     const PairTableInput& input) {
        candidate_count = static_cast<std::uint32_t>(input.a.size());
        points_of_rows_.clear();
        manifolds_of_rows_.clear();
        answer_pairs(world, query, input.a.size(), [&](std::size_t i) {
            return table::Pair{world.instances.find(input.a[i], call),
                               world.instances.find(input.b[i], call)};
        });
        if (!options.hits_only) {
            std::swap(now_, answered_);
            return;
        }
        now_.clear();
        for (std::size_t i = 0; i < answered_.rows.size(); ++i) {
            now_.add(answered_, i, has_row(answered_.rows[i]) ? i + 1 : i);
        }
    }

    /// Whether a pair has a row.
    [[nodiscard]] bool has_row(const Row& row) const {
        return !options.hits_only || row.status != StatusCode::ok || is_hit(row, options.reach);
    }

    /// Makes rows of consecutive pairs: `pair_of(i)` is pair i.
    template <class PairOf>
    void answer_pairs(const WorldView& world, const Query& query, std::size_t count,
                      const PairOf& pair_of) {
        const bool is_by_cpu = technique_ == Technique::cpu;
        answer_count = is_by_cpu ? static_cast<std::uint32_t>(count) : 0;
        if constexpr (requires { table::is_answered_in_place(query); }) {
            if (is_by_cpu && table::is_answered_in_place(query)) {
                answer_in_place(world.instances, query, count, pair_of);
                return;
            }
        }
        if (is_by_cpu) {
            answer_by_solvers(world, query, count, pair_of);
        } else {
            answer_by_batches(world, query, count, pair_of);
        }
    }

    template <class PairOf>
    void answer_in_place(const world::Instances& instances, const Query& query, std::size_t count,
                         const PairOf& pair_of) {
        answered_.rows.resize(count);
        expect_answers(count);
        jobs_->divide(count, table::pairs_of_part,
                      [&](std::uint32_t number, std::size_t first, std::size_t end) {
                          table::Job& job = scratch_[number];
                          if (job.penetration) {
                              job.penetration->begin_batch();
                          }
                          for (std::size_t i = first; i < end; ++i) {
                              checkpoint();
                              table::answer_pair(query, instances, pair_of(i), job,
                                                 answered_.rows[i]);
                              answered_.rows[i].index = static_cast<std::uint32_t>(i);
                          }
                          finish_answers(end - first);
                      });
    }

    void set_pair(const world::Instances& instances, const table::Pair& pair, Query& query) const {
        const WorldInstance& a = instances[pair.a];
        const WorldInstance& b = instances[pair.b];
        query.a = {a.shape, a.pose};
        query.b = {b.shape, b.pose};
        if constexpr (has_motions) {
            query.end_a = motions_.end(pair.a);
            query.end_b = motions_.end(pair.b);
        }
    }

    template <class PairOf>
    void answer_by_solvers(const WorldView& world, const Query& query, std::size_t count,
                           const PairOf& pair_of) {
        solvers::SolverJobs& solvers = world.context.ring().solvers();
        const world::Instances& instances = world.instances;
        answered_.clear();
        answered_.rows.resize(count);
        answered_.records.resize(has_points ? count : 0);
        answered_.manifolds.resize(has_manifold ? count : 0);
        job_of_.resize(count);
        questions_.resize(solvers.jobs());
        lists_.resize(solvers.jobs());
        for (table::JobLists<Query>& lists : lists_) {
            lists.points.clear();
            lists.manifolds.clear();
        }
        expect_answers(count);
        solvers.answer_each(
            count, questions_,
            [&](std::size_t i, solvers::SolverJobs::Question& question) {
                const table::Pair pair = pair_of(i);
                answered_.rows[i].a = instances.handle(pair.a);
                answered_.rows[i].b = instances.handle(pair.b);
                if (!std::holds_alternative<Query>(question.query)) {
                    question.query = query;
                }
                auto& asked = std::get<Query>(question.query);
                asked = query;
                set_pair(instances, pair, asked);
                question.shapes = {instances.find_polygon(pair.a), instances.find_polygon(pair.b)};
            },
            [&](std::uint32_t job, std::size_t i, AnyResult& any) {
                const auto& result = *std::get_if<typename Query::Result>(&any);
                Row& row = answered_.rows[i];
                row = row_of<Query>(row.a, row.b, result);
                row.index = static_cast<std::uint32_t>(i);
                job_of_[i] = job;
                if constexpr (has_points) {
                    const auto& points = table::points_of(result);
                    row.point_count = static_cast<std::uint32_t>(points.size());
                    answered_.records[i] = lists_[job].points.add(points);
                }
                if constexpr (has_manifold) {
                    answered_.manifolds[i] = lists_[job].manifolds.add(result.manifold);
                }
            });
        for (std::size_t i = 0; i < answered_.records.size(); ++i) {
            table::Slice& slice = answered_.records[i];
            slice = points_of_rows_.add(lists_[job_of_[i]].points[slice]);
        }
        for (std::size_t i = 0; i < answered_.manifolds.size(); ++i) {
            table::Slice& slice = answered_.manifolds[i];
            slice = manifolds_of_rows_.add(lists_[job_of_[i]].manifolds[slice]);
        }
    }

    template <class PairOf>
    void answer_by_batches(const WorldView& world, Query query, std::size_t count,
                           const PairOf& pair_of) {
        answered_.clear();
        for (std::size_t first = 0; first < count; first += table::queries_of_batch) {
            const std::size_t end = std::min(first + table::queries_of_batch, count);
            batch_.clear();
            pairs_of_batch_.clear();
            for (std::size_t i = first; i < end; ++i) {
                const table::Pair pair = pair_of(i);
                set_pair(world.instances, pair, query);
                batch_.add(query);
                pairs_of_batch_.push_back(pair);
            }
            world.context.ring().run(batch_, results_);
            timings.device += results_.timings.device;
            checkpoint();  // what was cut must not look whole
            for (std::size_t i = 0; i < pairs_of_batch_.size(); ++i) {
                add_row(world.instances.handle(pairs_of_batch_[i].a),
                        world.instances.handle(pairs_of_batch_[i].b),
                        *std::get_if<typename Query::Result>(&results_.results[i]));
            }
        }
    }

    void add_row(InstanceHandle a, InstanceHandle b, const typename Query::Result& result) {
        Row& row = answered_.rows.emplace_back(row_of<Query>(a, b, result));
        row.index = static_cast<std::uint32_t>(answered_.rows.size() - 1);
        if constexpr (has_points) {
            const auto& points = table::points_of(result);
            row.point_count = static_cast<std::uint32_t>(points.size());
            answered_.records.push_back(points_of_rows_.add(points));
        }
        if constexpr (has_manifold) {
            answered_.manifolds.push_back(manifolds_of_rows_.add(result.manifold));
        }
    }

    /// Puts the rows that stay and the new ones into the order of the candidates.
    void merge_rows() {
        constexpr std::uint32_t none = world::PairList::none;
        const auto pairs = list_.pairs();
        if (answered_.rows.empty() && pairs.size() == row_of_.size()) {
            return;  // all are as they were
        }
        before_.clear();
        row_of_before_.resize(pairs.size());
        std::size_t next_answered = 0;
        for (std::size_t i = 0; i < pairs.size();) {
            const auto to_row = static_cast<std::uint32_t>(before_.rows.size());
            if (pairs[i].before == none) {
                const std::size_t row = next_answered++;
                const bool is_kept = has_row(answered_.rows[row]);
                row_of_before_[i] = is_kept ? to_row : none;
                before_.add(answered_, row, is_kept ? row + 1 : row);
                ++i;
                continue;
            }
            // A run of pairs that stay has its rows, if they are listed, in one piece.
            std::uint32_t first = none;
            std::uint32_t end = 0;
            const std::size_t begin = i;
            for (; i < pairs.size() && pairs[i].before == pairs[begin].before + (i - begin); ++i) {
                const std::uint32_t row = row_of_[pairs[i].before];
                if (row != none) {
                    first = std::min(first, row);
                    end = row + 1;
                }
                row_of_before_[i] = row == none ? none : to_row + row - first;
            }
            before_.add(now_, std::min(first, end), end);
        }
        std::swap(now_, before_);
        row_of_.swap(row_of_before_);
        points_of_rows_.compact(now_.records);
        manifolds_of_rows_.compact(now_.manifolds);
    }

    static constexpr bool has_motions = std::is_same_v<Query, TimeOfImpactQuery>;
    static constexpr bool has_manifold = std::is_same_v<Query, ContactQuery>;
    static constexpr bool has_points = requires(const typename Query::Result& result) {
        table::points_of(result);
    };

    std::weak_ptr<const void> world_;  // identity of the one of the last update
    world::Motions motions_;           // for times of impact
    world::PairList list_;
    std::vector<std::uint32_t> row_of_;  // by candidate; PairList::none: no hit
    std::vector<std::uint32_t> row_of_before_;
    table::Content<Query> now_;       // or the rows of the device that were made exact
    table::Content<Query> answered_;  // by the last update
    table::Content<Query> before_;    // memory for the next update
    table::RowLists<Point> points_of_rows_;
    table::RowLists<ContactCluster> manifolds_of_rows_;
    std::optional<Jobs> jobs_;
    std::vector<table::Job> scratch_;  // by job
    // Likewise, where solvers answer.
    std::vector<solvers::SolverJobs::Question> questions_;
    std::vector<table::JobLists<Query>> lists_;
    std::vector<std::uint32_t> job_of_;  // by pair that was answered
    Batch batch_;
    Results results_;
    std::vector<table::Pair> pairs_of_batch_;
    bool are_exact_ = false;
    std::vector<Point> points_;  // of the device, that were read last
    std::vector<ContactCluster> manifold_;
};

template <class Query>
PairTable<Query>::PairTable(const Query& query, const PairTableOptions& options)
    : PairTableBase(std::make_unique<Rows>(query, options)), query_(query) {}

template <class Query>
typename PairTable<Query>::Rows& PairTable<Query>::state() const noexcept {
    return static_cast<Rows&>(*state_);
}

template <class Query>
std::span<const PairRow<Query>> PairTable<Query>::rows() noexcept {
    return state().read([this] { return state().rows(); });
}

template <class Query>
Expected<PairRow<Query>> PairTable<Query>::row(std::uint32_t index) {
    return catch_to_expected([&] { return state().row(index); });
}

template <class Query>
std::span<const typename PairTable<Query>::Point> PairTable<Query>::points(
    const PairRow<Query>& row) noexcept {
    return state().read([&] { return state().points(row); });
}

template <class Query>
std::span<const ContactCluster> PairTable<Query>::manifold(
    const PairRow<Query>& row) noexcept requires std::is_same_v<Query, ContactQuery> {
    return state().read([&] { return state().manifold(row); });
}

template class PairTable<PenetrationQuery>;
template class PairTable<ContactQuery>;
template class PairTable<IntersectionQuery>;
template class PairTable<ClosestPointQuery>;
template class PairTable<SeparationQuery>;
template class PairTable<IntersectionTestQuery>;
template class PairTable<SeparationVectorQuery>;
template class PairTable<ContainmentQuery>;
template class PairTable<TimeOfImpactQuery>;

Status World::update(PairTableBase& table, const PairTableInput& input, const Limits& limits) {
    return catch_within(limits, [&] {
        table.state_->start("update", state_->view(), input, nullptr);
        table.state_->finish();
    });
}

Status World::submit(PairTableBase& table, const PairTableInput& input, const Limits& limits) {
    return catch_within(limits,
                        [&] { table.state_->start("submit", state_->view(), input, nullptr); });
}

Status World::record(PairTableBase& table, const Recording& recording, const PairTableInput& input,
                     const Limits& limits) {
    return catch_within(limits, [&] {
        state_->context->ring().require_open_frame(recording);
        table.state_->start("record", state_->view(), input, &recording);
    });
}

bool World::is_recorded(const PairTableBase& table) const noexcept {
    const DevicePairs* const device = table.state_->device.get();
    return device != nullptr && device->is_recorded(state_->view());
}

}  // namespace nearfield
