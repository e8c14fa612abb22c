#include <engine/base/interruption.hpp>
#include <engine/device_input/point_search.hpp>
#include <engine/geometry/angle_kernels.hpp>
#include <engine/queries/boundary_points.hpp>
#include <engine/queries/check_query.hpp>
#include <engine/queries/error_budget.hpp>
#include <engine/world/device_instances.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace nearfield {
namespace {

using geometry::TransformedPolygon;
using geometry::Vector;
using geometry::kernels::angles_at_once;

/// Ratios and squares of lengths between these stay within the range of floats.
constexpr double smallest_unit = 0x1p-30;
constexpr double largest_unit = 0x1p+30;

/// Where the middle of the instances is farther from the origin than this, in radii of an average
/// one, the origin moves there: boxes are rounded by 2^-20 of their distance from it.
constexpr double max_radii_from_origin = 1024.0;

/// Half of the places are on either side of it, however far away some are.
double median(std::vector<Vector2>& places, double Vector2::*coordinate) {
    const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
    std::nth_element(places.begin(), middle, places.end(), [=](const Vector2& a, const Vector2& b) {
        return a.*coordinate < b.*coordinate;
    });
    return (*middle).*coordinate;
}

}  // namespace

void DeviceInstances::clear(batch::ShapeStore* shapes) {
    entries_.clear();
    indices_.clear();
    membership_ = shapes_revision_ = 0;
    if (shapes != nullptr) {
        shapes->release(held_);
    }
}

/// Lists the instances whose shapes exist in the order in which they were added.
void DeviceInstances::list(const char* call, batch::ShapeStore& shapes,
                           const world::Instances& instances) {
    indices_.clear();
    end_index_ = 0;
    for (std::uint32_t index = 0; index < instances.size(); ++index) {
        if (instances.is_present(index) && shapes.find(instances[index].shape) != nullptr) {
            indices_.push_back(index);
            end_index_ = index + 1;
        }
    }
    if (indices_.size() > shaders::max_instances) {
        throw StatusException(
            {StatusCode::too_large, std::string(call) + ": the world has " +
                                        std::to_string(indices_.size()) +
                                        " instances, of which the device takes at most " +
                                        std::to_string(shaders::max_instances)});
    }
    std::sort(indices_.begin(), indices_.end(), [&](std::uint32_t i, std::uint32_t j) {
        return instances.number(i) < instances.number(j);
    });
    entries_.assign(indices_.size(), {});
    moves_.assign(indices_.size(), not_placed);
}

/// Writes instances whose poses may have changed.
void DeviceInstances::place(const world::Instances& instances,
                            std::span<const std::uint32_t> numbers,
                            render::InstanceBuffers& buffers) {
    std::array<double, angles_at_once> angles{};
    std::array<SineCosine, angles_at_once> turns;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        angles[i] = instances[indices_[numbers[i]]].pose.angle;
    }
    geometry::kernels::find_sines_cosines(std::span(angles).first(numbers.size()), turns);
    const bool has_tolerance = question_->tolerance > 0.0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::uint32_t index = indices_[numbers[i]];
        const WorldInstance& instance = instances[index];
        Entry& entry = entries_[numbers[i]];
        entry.instance.pose = instance.pose;
        moves_[numbers[i]] = instances.moves(index);
        const ShapeOfInstances& shape = shapes_of_[entry.instance.shape.index];
        shaders::SearchInstanceData data = shape.data;
        data.category = entry.category = instance.category;
        data.mask = entry.mask = instance.mask;
        data.element = index;
        const auto [place, magnitude] =
            device_input::set_place(*shape.polygon, instance.pose, turns[i], origin_, data);
        entry.place = place;
        data.box_rounding = device_input::rounding_at(magnitude);
        data.rounding = has_tolerance ? 0.0F : data.box_rounding;
        const bool is_resolved = question_->resolved == 0.0 ||
                                 question_->resolved >= queries::smallest_tolerance(magnitude);
        data.left_to_cpu |= is_resolved ? 0U : shaders::left_by_place;
        buffers.set(numbers[i], data);
    }
}

void DeviceInstances::place_moved(const world::Instances& instances,
                                  render::InstanceBuffers& buffers) {
    if (instances.all_moves() != all_moves_) {
        place_each_moved(instances, buffers);
    }
}

void DeviceInstances::place_each_moved(const world::Instances& instances,
                                       render::InstanceBuffers& buffers) {
    std::array<std::uint32_t, angles_at_once> numbers{};
    std::size_t count = 0;
    for (std::uint32_t number = 0; number < entries_.size(); ++number) {
        if (instances.moves(indices_[number]) != moves_[number]) {
            numbers[count++] = number;
            if (count == angles_at_once) {
                place(instances, numbers, buffers);
                count = 0;
            }
        }
    }
    place(instances, std::span(numbers).first(count), buffers);
    all_moves_ = instances.all_moves();
}

/// Whether the CPU answers what is about a shape, whatever its poses: its deviation is large for
/// the tolerance, it has more samples than are searched, or it is so small or large that floats do
/// not hold what is computed.
bool DeviceInstances::is_for_cpu(const geometry::Polygon& polygon) const {
    const double unit = device_input::unit_length_of(polygon);
    if (unit < smallest_unit || unit > largest_unit) {
        return true;
    }
    if (question_->goal == device_input::PairGoal::tests) {
        return false;
    }
    if (question_->samples &&
        queries::max_samples(polygon, question_->cell) > queries::max_searched_points) {
        return true;
    }
    const queries::Deviations both{polygon.deviation(), polygon.deviation()};
    return !queries::check_deviations(question_->tolerance, both,
                                      device_input::pair_budget(*query_, both).bound)
                .ok();
}

const DeviceInstances::ShapeOfInstances& DeviceInstances::add_shape(batch::ShapeStore& shapes,
                                                                    ShapeHandle handle) {
    if (handle.index >= shapes_of_.size()) {
        shapes_of_.resize(handle.index + std::size_t{1});
    }
    ShapeOfInstances& shape = shapes_of_[handle.index];
    if (shape.polygon != nullptr && shape.polygon == shapes.find(handle)) {
        return shape;
    }
    const geometry::Polygon& polygon = *shapes.hold(handle, held_);
    if (shape.polygon != nullptr) {
        shapes.release(held_, *shape.polygon);
    }
    const bool is_left_to_cpu = is_for_cpu(polygon);
    shape.data = device_input::data_of_shape(polygon);
    shape.data.left_to_cpu = is_left_to_cpu ? shaders::left_by_shape : 0;
    shape.data.shape = shapes_.place(polygon);
    shape.data.parts = question_->samples && !is_left_to_cpu
                           ? shapes_.place_parts(polygon, question_->cell)
                           : shaders::no_parts;
    shape.polygon = &polygon;
    return shape;
}

void DeviceInstances::place_all(batch::ShapeStore& shapes, const world::Instances& instances,
                                const std::optional<Vector>& origin,
                                render::InstanceBuffers& buffers) {
    const double cell = question_->cell;
    shapes.release(held_);
    shapes_of_.clear();
    shapes_.begin_batch();
    places_.clear();
    for (std::uint32_t number = 0; number < entries_.size(); ++number) {
        checkpoint();
        Entry& entry = entries_[number];
        const WorldInstance& instance = instances[indices_[number]];
        static_cast<void>(add_shape(shapes, instance.shape));
        entry.handle = instances.handle(indices_[number]);
        entry.instance.shape = instance.shape;
        places_.push_back(geometry::to_public(
            TransformedPolygon(*polygon_of(instance.shape), instance.pose).translation()));
    }
    origin_ = origin ? *origin : Vector{median(places_, &Vector2::x), median(places_, &Vector2::y)};
    place_each_moved(instances, buffers);
    shaders::PairQueryData all;
    all.cell = static_cast<float>(cell);
    all.rival = static_cast<float>(cell / std::numbers::sqrt2 * queries::uniqueness_margin);
    all.touching =
        static_cast<float>(question_->tolerance * static_cast<double>(shaders::touching_depth));
    all.reach = device_input::rounded_up(question_->reach);
    all.is_test = question_->goal == device_input::PairGoal::tests ? 1 : 0;
    all.is_once = question_->is_once ? 1 : 0;
    buffers.set_query(all);
    order_soon();
}

void DeviceInstances::update(const char* call, batch::ShapeStore& shapes,
                             const world::Instances& instances, const std::optional<Vector>& origin,
                             render::InstanceBuffers& buffers) {
    const bool are_same = are_all_of(shapes, instances);
    membership_ = 0;  // until all went well
    if (!are_same) {
        ++content_;
        list(call, shapes, instances);
        if (!entries_.empty()) {
            buffers.reserve(size());
            place_all(shapes, instances, origin, buffers);
        }
    } else if (!entries_.empty()) {
        if (shapes_revision_ != shapes.revision()) {
            replace_shapes(shapes);
        }
        place_moved(instances, buffers);
    }
    membership_ = instances.membership();
    shapes_revision_ = shapes.revision();
    filters_ = instances.filters();
}

/// Whether they are all instances whose shapes exist.
bool DeviceInstances::are_all_of(batch::ShapeStore& shapes,
                                 const world::Instances& instances) const {
    if (membership_ == 0) {
        return false;
    }
    if (membership_ == instances.membership() && shapes_revision_ == shapes.revision()) {
        return true;
    }
    const auto exists = [&](std::uint32_t index) {
        return instances.is_present(index) && shapes.find(instances[index].shape) != nullptr;
    };
    std::size_t count = 0;
    for (std::uint32_t index = 0; index < instances.size(); ++index) {
        count += exists(index) ? 1U : 0U;
    }
    bool are_all = count == entries_.size();
    for (std::uint32_t number = 0; are_all && number < count; ++number) {
        const std::uint32_t index = indices_[number];
        are_all = exists(index) && instances.handle(index) == entries_[number].handle;
    }
    return are_all;
}

bool DeviceInstances::are_those_of(batch::ShapeStore& shapes,
                                   const world::Instances& instances) const {
    if (!are_all_of(shapes, instances)) {
        return false;
    }
    if (shapes_revision_ == shapes.revision() && filters_ == instances.filters()) {
        return true;
    }
    for (std::uint32_t number = 0; number < entries_.size(); ++number) {
        const Entry& entry = entries_[number];
        const WorldInstance& instance = instances[indices_[number]];
        if (!has_current_shape(shapes, entry) || entry.category != instance.category ||
            entry.mask != instance.mask) {
            return false;
        }
    }
    return true;
}

/// Those with other rings than at the last update, whose instances are placed anew.
void DeviceInstances::replace_shapes(batch::ShapeStore& shapes) {
    bool are_others = false;
    for (std::uint32_t number = 0; number < entries_.size(); ++number) {
        if (!has_current_shape(shapes, entries_[number])) {
            moves_[number] = not_placed;
            are_others = true;
        }
    }
    if (!are_others) {
        return;
    }
    ++content_;
    all_moves_ = not_placed;
    for (std::uint32_t number = 0; number < entries_.size(); ++number) {
        if (moves_[number] == not_placed) {
            static_cast<void>(add_shape(shapes, entries_[number].instance.shape));
        }
    }
}

void DeviceInstances::order(const world::Instances& instances, bool may_move,
                            render::InstanceBuffers& buffers) {
    if (!is_order_due()) {
        ++updates_in_order_;
        return;
    }
    updates_in_order_ = 1;
    places_.clear();
    double radii = 0.0;
    for (const Entry& entry : entries_) {
        places_.push_back(geometry::to_public(entry.place));
        radii += polygon_of(entry.instance.shape)->radius();
    }
    buffers.set_order(hilbert_order_.sort(
        places_.size(), [this](std::size_t i) -> const Vector2& { return places_[i]; }));
    if (!may_move) {
        return;
    }
    const Vector middle{median(places_, &Vector2::x), median(places_, &Vector2::y)};
    if (middle.norm() > max_radii_from_origin * radii / static_cast<double>(entries_.size())) {
        origin_ += middle;
        std::fill(moves_.begin(), moves_.end(), not_placed);
        place_each_moved(instances, buffers);
    }
}

void DeviceInstances::take_pose(std::uint32_t number, const Pose& pose, const SineCosine& turn) {
    Entry& entry = entries_[number];
    entry.instance.pose = pose;
    shaders::SearchInstanceData unused;
    entry.place =
        device_input::set_place(*polygon_of(entry.instance.shape), pose, turn, origin_, unused)
            .place;
}

}  // namespace nearfield
