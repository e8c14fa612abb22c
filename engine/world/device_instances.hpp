#pragma once

#include <engine/batch/shape_store.hpp>
#include <engine/device_input/pair_question.hpp>
#include <engine/device_input/pair_search.hpp>
#include <engine/device_input/search_shapes.hpp>
#include <engine/geometry/hilbert_curve.hpp>
#include <engine/render/instance_buffers.hpp>
#include <engine/world/instances.hpp>
#include <nearfield/query.hpp>
#include <nearfield/shape.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nearfield {

/// Begins the times of a submission anew. The names of passes stay, so that one like the one before
/// allocates nothing.
inline void clear_parts(Timings& timings) {
    timings.plan = timings.record = timings.device = timings.decode = 0.0;
    for (PassTime& pass : timings.passes) {
        pass.milliseconds = 0.0;
    }
}

/// The instances of a world as the device was told of them last, for one question: what of them is
/// written to the device. Their shapes are held. Its members throw.
class DeviceInstances {
public:
    /// An instance. Its number is its place among all, in the order in which they were added.
    struct Entry {
        Instance instance;
        InstanceHandle handle;
        geometry::Vector place;      // of its shape's centre, relative to the origin
        std::uint32_t category = 0;  // see WorldInstance
        std::uint32_t mask = 0;
    };

    /// `query`: what the question is of; both have to stay.
    DeviceInstances(const AnyQuery& query, const device_input::PairQuestion& question)
        : query_(&query), question_(&question) {}

    /// A shape of instances. Its polygon is held; null: it has none.
    struct ShapeOfInstances {
        const geometry::Polygon* polygon = nullptr;
        shaders::SearchInstanceData data;  // what all its instances have alike
    };

    /// Forgets all instances. `shapes`: that they were of; null: there are none.
    void clear(batch::ShapeStore* shapes);
    /// Writes all of them at the next update, whether they have moved or not.
    void forget_places() { membership_ = 0; }
    /// Takes down the instances as they are, and writes those that have changed. `call`: for
    /// messages. `origin`: that the host's own poses are relative to, if it has any.
    void update(const char* call, batch::ShapeStore& shapes, const world::Instances& instances,
                const std::optional<geometry::Vector>& origin, render::InstanceBuffers& buffers);
    /// Also takes down a shape that no instance needs to have, until the next update.
    const ShapeOfInstances& add_shape(batch::ShapeStore& shapes, ShapeHandle handle);
    /// Whether order() is going to sort them: now and then, or after order_soon().
    [[nodiscard]] bool is_order_due() const { return updates_in_order_ >= max_updates_in_order; }
    void order_soon() { updates_in_order_ = max_updates_in_order; }
    /// Puts them in the order of the hierarchy, if that is due. `may_move`: the origin may be
    /// another one after that.
    void order(const world::Instances& instances, bool may_move, render::InstanceBuffers& buffers);
    /// Whether those of the last update are those of a world as it is, but for their poses.
    [[nodiscard]] bool are_those_of(batch::ShapeStore& shapes,
                                    const world::Instances& instances) const;

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(entries_.size()); }
    [[nodiscard]] const Entry& operator[](std::uint32_t number) const { return entries_[number]; }
    /// Of an instance when it was written last: see world::Instances.
    [[nodiscard]] std::uint64_t moves(std::uint32_t number) const { return moves_[number]; }
    /// The index of an instance in the world.
    [[nodiscard]] std::uint32_t index(std::uint32_t number) const { return indices_[number]; }
    /// All indices are below it.
    [[nodiscard]] std::uint32_t end_index() const { return end_index_; }
    [[nodiscard]] const geometry::Polygon* polygon_of(ShapeHandle shape) const {
        return shapes_of_[shape.index].polygon;
    }
    [[nodiscard]] const geometry::Vector& origin() const { return origin_; }
    [[nodiscard]] const device_input::SearchShapes& shapes() const { return shapes_; }
    /// Differs after instances were listed anew, or the rings of any have changed.
    [[nodiscard]] std::uint64_t content() const { return content_; }
    /// Puts an instance at a pose that the host wrote.
    void take_pose(std::uint32_t number, const Pose& pose, const SineCosine& turn);

private:
    static constexpr std::uint64_t not_placed = UINT64_MAX;
    /// After so many updates the instances are ordered anew: boxes that hold what has moved apart
    /// only cost time.
    static constexpr std::uint32_t max_updates_in_order = 64;

    [[nodiscard]] bool are_all_of(batch::ShapeStore& shapes,
                                  const world::Instances& instances) const;
    [[nodiscard]] bool has_current_shape(batch::ShapeStore& shapes, const Entry& entry) const {
        return shapes.find(entry.instance.shape) == polygon_of(entry.instance.shape);
    }
    void replace_shapes(batch::ShapeStore& shapes);
    void list(const char* call, batch::ShapeStore& shapes, const world::Instances& instances);
    void place(const world::Instances& instances, std::span<const std::uint32_t> numbers,
               render::InstanceBuffers& buffers);
    void place_moved(const world::Instances& instances, render::InstanceBuffers& buffers);
    void place_each_moved(const world::Instances& instances, render::InstanceBuffers& buffers);
    [[nodiscard]] bool is_for_cpu(const geometry::Polygon& polygon) const;
    void place_all(batch::ShapeStore& shapes, const world::Instances& instances,
                   const std::optional<geometry::Vector>& origin, render::InstanceBuffers& buffers);

    const AnyQuery* query_;
    const device_input::PairQuestion* question_;
    geometry::Vector origin_ = geometry::Vector::Zero();
    device_input::SearchShapes shapes_;
    batch::ShapeStore::Held held_;
    std::vector<Entry> entries_;
    std::vector<std::uint64_t> moves_;         // of these, in one piece
    std::vector<std::uint32_t> indices_;       // of these in the world
    std::vector<ShapeOfInstances> shapes_of_;  // by the index of a shape's handle
    // Of the world, at the last update.
    std::uint64_t membership_ = 0;
    std::uint64_t shapes_revision_ = 0;
    std::uint64_t filters_ = 0;
    std::uint64_t content_ = 0;
    std::uint64_t all_moves_ = 0;  // of the instances, when they were placed
    geometry::HilbertOrder hilbert_order_;
    std::vector<Vector2> places_;         // of the instances
    std::uint32_t updates_in_order_ = 0;  // since they were ordered
    std::uint32_t end_index_ = 0;
};

}  // namespace nearfield
