// How a table of pairs that the device finds is brought up to date.

#include <engine/base/interruption.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/context/call_within.hpp>
#include <engine/context/device_pair_state.hpp>
#include <engine/context/world_checks.hpp>
#include <engine/context/world_implementation.hpp>
#include <engine/localize/hierarchy.hpp>
#include <engine/plan/boundary_points.hpp>
#include <engine/plan/check_query.hpp>
#include <engine/plan/error_budget.hpp>
#include <engine/plan/point_search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

namespace nearfield {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;

/// After so many updates the instances are ordered anew: boxes that hold what has moved apart only
/// cost time.
constexpr std::uint32_t max_updates_in_order = 64;
/// Sines and cosines of several poses are computed at the same time; those of one alone would have
/// to be waited for.
constexpr std::size_t poses_at_once = 16;
/// Ratios and squares of lengths between these stay within the range of floats.
constexpr double smallest_unit = 0x1p-30;
constexpr double largest_unit = 0x1p+30;

/// Half of the places are on either side of it, however far away some are.
double median(std::vector<Vector2>& places, double Vector2::*coordinate) {
    const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
    std::nth_element(places.begin(), middle, places.end(), [=](const Vector2& a, const Vector2& b) {
        return a.*coordinate < b.*coordinate;
    });
    return (*middle).*coordinate;
}

}  // namespace

void DevicePairTableBase::State::check() const {
    if (question_.goal == plan::PairGoal::tests &&
        !(question_.reach >= 0.0 && question_.reach <= largest_coordinate)) {
        refuse("update", "the reach is " + geometry::number(question_.reach) +
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
            if constexpr (requires { asked.resident; }) {
                is_asked = is_asked && !asked.resident;
            }
            if (!is_asked) {
                refuse("update",
                       "the device finds these pairs by Technique::compute; the table's query "
                       "asks for another technique, or for resident results");
            }
            if constexpr (requires { asked.normals; }) {
                if (asked.normals == ContactNormals::gradient) {
                    refuse("update", "the contacts of these pairs have analytic normals");
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
        throw StatusException({status.code(), "update: " + status.message()});
    }
}

void DevicePairTableBase::State::start_anew() {
    rows = 0;
    decided_.clear();
    device_rows_.clear();
    instances_.clear();
    indices_.clear();
    membership_ = shapes_revision_ = 0;
    buffers_.reset();
    world_.reset();
    if (context_ != nullptr) {
        context_->shapes().release(held_);
    }
}

/// Lists the instances whose shapes exist in the order in which they were added.
void DevicePairTableBase::State::list_instances(const world::Instances& instances) {
    indices_.clear();
    for (std::uint32_t index = 0; index < instances.size(); ++index) {
        if (instances.is_present(index) &&
            context_->shapes().find(instances[index].shape) != nullptr) {
            indices_.push_back(index);
        }
    }
    if (indices_.size() > plan::max_instances) {
        throw StatusException(
            {StatusCode::too_large, "update: the world has " + std::to_string(indices_.size()) +
                                        " instances, of which the device takes at most " +
                                        std::to_string(plan::max_instances)});
    }
    std::sort(indices_.begin(), indices_.end(), [&](std::uint32_t i, std::uint32_t j) {
        return instances.number(i) < instances.number(j);
    });
    instances_.assign(indices_.size(), {});
}

/// Writes instances whose poses may have changed.
void DevicePairTableBase::State::place(const world::Instances& instances,
                                       std::span<const std::uint32_t> numbers) {
    const bool has_tolerance = question_.tolerance > 0.0;
    std::array<std::optional<TransformedPolygon>, poses_at_once> placed;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        PairInstance& entry = instances_[numbers[i]];
        const std::uint32_t index = indices_[numbers[i]];
        entry.instance.pose = instances[index].pose;
        entry.moves = instances.moves(index);
        entry.data.category = instances[index].category;
        entry.data.mask = instances[index].mask;
        placed[i].emplace(*entry.polygon, entry.instance.pose);
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        PairInstance& entry = instances_[numbers[i]];
        const Pose& pose = entry.instance.pose;
        plan::set_place(*placed[i], origin_, entry.data);
        const double magnitude =
            std::max({placed[i]->translation().cwiseAbs().maxCoeff() + entry.polygon->radius(),
                      entry.polygon->centre().cwiseAbs().maxCoeff(), std::abs(pose.translation.x),
                      std::abs(pose.translation.y)});
        const bool is_resolved =
            has_tolerance ? plan::check_resolution(question_.tolerance, magnitude).ok() : true;
        entry.data.rounding = has_tolerance ? 0.0F : plan::rounding_at(magnitude);
        entry.data.left_to_cpu = entry.is_left_to_cpu || !is_resolved ? 1 : 0;
        buffers_->set_instance(numbers[i], entry.data);
    }
}

void DevicePairTableBase::State::place_moved(const world::Instances& instances) {
    std::array<std::uint32_t, poses_at_once> numbers{};
    std::size_t count = 0;
    for (std::uint32_t number = 0; number < instances_.size(); ++number) {
        if (instances.moves(indices_[number]) != instances_[number].moves) {
            numbers[count++] = number;
            if (count == poses_at_once) {
                place(instances, numbers);
                count = 0;
            }
        }
    }
    place(instances, std::span(numbers).first(count));
}

/// Whether the CPU answers the pairs of a shape, whatever its poses: its deviation is large for the
/// tolerance, it has more samples than are searched, or it is so small or large that floats do not
/// hold what is computed.
bool DevicePairTableBase::State::is_for_cpu(const geometry::Polygon& polygon) const {
    const double unit = plan::unit_length_of(polygon);
    if (unit < smallest_unit || unit > largest_unit) {
        return true;
    }
    if (question_.goal == plan::PairGoal::tests) {
        return false;
    }
    if (question_.samples &&
        plan::max_samples(polygon, question_.cell) > plan::max_searched_points) {
        return true;
    }
    const plan::Deviations both{polygon.deviation(), polygon.deviation()};
    return !plan::check_deviations(question_.tolerance, both, plan::pair_budget(query_, both).bound)
                .ok();
}

void DevicePairTableBase::State::place_all(const world::Instances& instances) {
    const double cell = question_.cell;
    context_->shapes().release(held_);
    shapes_.begin_batch();
    places_.clear();
    for (std::uint32_t number = 0; number < instances_.size(); ++number) {
        checkpoint();
        PairInstance& entry = instances_[number];
        const WorldInstance& instance = instances[indices_[number]];
        entry.handle = instances.handle(indices_[number]);
        entry.instance.shape = instance.shape;
        entry.polygon = context_->shapes().hold(instance.shape, held_);
        entry.is_left_to_cpu = is_for_cpu(*entry.polygon);
        entry.data.shape = shapes_.place(*entry.polygon);
        entry.data.parts = question_.samples && !entry.is_left_to_cpu
                               ? shapes_.place_parts(*entry.polygon, cell)
                               : plan::no_parts;
        plan::set_shape(*entry.polygon, entry.data);
        places_.push_back(
            geometry::to_public(TransformedPolygon(*entry.polygon, instance.pose).translation()));
    }
    origin_ = {median(places_, &Vector2::x), median(places_, &Vector2::y)};
    place_moved(instances);
    plan::PairQueryData all;
    all.cell = static_cast<float>(cell);
    all.rival = static_cast<float>(cell / std::numbers::sqrt2 * plan::uniqueness_margin);
    all.touching =
        static_cast<float>(question_.tolerance * static_cast<double>(plan::touching_depth));
    all.reach = plan::rounded_up(question_.reach);
    all.is_test = question_.goal == plan::PairGoal::tests ? 1 : 0;
    all.is_once = question_.is_once ? 1 : 0;
    buffers_->set_query(all);
    updates_in_order_ = max_updates_in_order;
}

void DevicePairTableBase::State::order_instances() {
    if (updates_in_order_++ < max_updates_in_order) {
        return;
    }
    updates_in_order_ = 1;
    places_.clear();
    for (const PairInstance& entry : instances_) {
        places_.push_back(
            {static_cast<double>(entry.data.high.x), static_cast<double>(entry.data.high.y)});
    }
    buffers_->set_order(hilbert_order_.sort(
        places_.size(), [this](std::size_t i) -> const Vector2& { return places_[i]; }));
}

void DevicePairTableBase::State::search() {
    render::Renderer& renderer = *context_->renderer();
    buffers_->search(renderer.pair_search(question_.goal), shapes_, context_->memory_limit(),
                     timings);
    rows = buffers_->counts()[plan::row_total];
}

/// Whether the pair is one that a PairTable asks about: those in whose boxes only rounding leaves a
/// gap are not, but the device does not tell them apart.
bool DevicePairTableBase::State::boxes_meet(const plan::PairRowData& data) const {
    const auto box_of = [this](std::uint32_t number) {
        const PairInstance& entry = instances_[number];
        return TransformedPolygon(*entry.polygon, entry.instance.pose).box();
    };
    // In the same order for both rows of a pair: the sums are rounded.
    return localize::boxes_meet(box_of(std::min(data.a, data.b)), box_of(std::max(data.a, data.b)),
                                question_.reach);
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

/// Answers what single precision could not decide, and drops the rows without points.
void DevicePairTableBase::State::decide() {
    if (buffers_->undecided().empty()) {
        return;
    }
    const Stopwatch start;
    const std::span<const std::uint32_t> undecided = buffers_->undecided();
    cpu_queries_.clear();
    for (const std::uint32_t i : undecided) {
        cpu_queries_.emplace_back(query_on_cpu(buffers_->rows()[i], false));
    }
    context_->ring().answer(
        cpu_queries_, [this](ShapeHandle shape) { return context_->shapes().find(shape); },
        decided_results_);
    checkpoint();  // what was cut must not look whole
    for (std::size_t i = 0; i < undecided.size(); ++i) {
        const plan::PairRowData& data = buffers_->rows()[undecided[i]];
        decided_.push_back({undecided[i], is_hit(decided_results_.results[i], data)});
    }
    const bool are_all_rows = std::all_of(decided_.begin(), decided_.end(),
                                          [](const Decided& one) { return one.has_row; });
    if (!are_all_rows) {
        std::size_t next = 0;
        for (std::uint32_t i = 0; i < rows; ++i) {
            const bool is_decided = next < decided_.size() && decided_[next].row == i;
            if (!is_decided || decided_[next++].has_row) {
                device_rows_.push_back(i);
            }
        }
        rows = static_cast<std::uint32_t>(device_rows_.size());
    }
    timings.decode = start.milliseconds();
}

void DevicePairTableBase::State::update(Context::Implementation& with,
                                        const std::shared_ptr<const void>& identity,
                                        const world::Instances& instances) {
    const Stopwatch total;
    if (context_ != &with || world_.lock() != identity) {
        start_anew();
        context_ = &with;
        world_ = identity;
    }
    check();
    rows = 0;
    decided_.clear();
    device_rows_.clear();
    timings.plan = timings.record = timings.device = timings.decode = 0.0;
    for (PassTime& pass : timings.passes) {
        pass.milliseconds = 0.0;
    }
    if (buffers_ == nullptr || renderer_ != context_->renderer()->number()) {
        buffers_ = context_->renderer()->make_pair_buffers(question_);
        renderer_ = context_->renderer()->number();
        membership_ = 0;
    }
    const bool is_same =
        membership_ == instances.membership() && shapes_revision_ == context_->shapes().revision();
    if (is_same && instances_.size() > 1) {
        place_moved(instances);
    } else if (!is_same) {
        membership_ = 0;
        list_instances(instances);
        if (instances_.size() > 1) {
            buffers_->reserve_instances(static_cast<std::uint32_t>(instances_.size()));
            place_all(instances);
        }
        membership_ = instances.membership();
        shapes_revision_ = context_->shapes().revision();
    }
    if (instances_.size() > 1) {
        order_instances();
        timings.plan = total.milliseconds();
        search();
        decide();
    }
    timings.total = total.milliseconds();
}

void World::Implementation::update(DevicePairTableBase& table) {
    DevicePairTableBase::State& state = *table.state_;
    const Status status =
        context_->unless_lost([&] { state.update(*context_, identity_, instances_); });
    if (!status.ok()) {
        state.start_anew();
        throw StatusException(status);
    }
}

Status World::update(DevicePairTable<PenetrationQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(DevicePairTable<ContactQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(DevicePairTable<ClosestPointQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(DevicePairTable<SeparationQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

Status World::update(DevicePairTable<IntersectionTestQuery>& table, const Limits& limits) {
    return catch_within(limits, [&] { implementation_->update(table); });
}

}  // namespace nearfield
