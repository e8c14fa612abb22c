#pragma once

#include <nearfield/timings.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_request.hpp>

#include <tools/io/world_report.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::tools {

/// The instances of a scene as worlds, for the queries of all instances or of groups. The worlds
/// stay from frame to frame; what happens to the shapes in the context is seen by them.
class WorldRunner {
public:
    /// `shapes` and `instances` are those of the scene, and `sound` lists the instances that can be
    /// used; what is passed must outlive the runner. Throws LibraryError.
    WorldRunner(const Scene& scene, Context& context, std::span<const ShapeHandle> shapes,
                std::span<const Instance> instances, std::span<const std::size_t> sound);

    /// Answers the scene's query with this index, which must be one of a world that its technique
    /// answers (technique_problem()), and adds the times of the device. An error is returned, and
    /// leaves the answer undefined.
    [[nodiscard]] Status answer(std::size_t query, const Limits& limits, Timings& timings);

    /// The last answer to a query. Valid until it is answered again.
    [[nodiscard]] const WorldAnswer& answer_of(std::size_t query) const {
        return entries_[query].answer;
    }

private:
    /// What asks the device about inputs of one kind, and how many at a time.
    struct ByDevice {
        nearfield::WorldRequest request = {};
        std::size_t part = std::size_t{1} << 20U;
    };
    /// A world, whose filters distinguish a limited number of groups.
    struct GroupedWorld {
        World world;
        std::vector<InstanceHandle> handles;  ///< by index into Scene::instances
        std::vector<std::size_t> instances;   ///< indices into it, by InstanceHandle::index
        ByDevice tests = {};
        ByDevice nearest = {};
        ByDevice rays = {};
    };
    /// What one call of answer() is given.
    struct Call {
        GroupedWorld& world;
        const WorldOptions& options;
        Timings& timings;
    };
    /// What a query needs.
    struct Entry {
        std::size_t group = 0;  ///< the instances considered
        WorldFilter filter = {};
        WorldAnswer answer = {};
    };

    void add_entries();
    void add_world(Context& context, std::size_t first_group);
    /// The number of the group of these instances, which it gets when it is new.
    [[nodiscard]] std::size_t group_of(std::vector<std::size_t> instances);

    [[nodiscard]] Status answer_poses(const Call& call, Entry& entry) const;
    [[nodiscard]] Status answer_nearest(const Call& call, Entry& entry);
    [[nodiscard]] Status answer_rays(const Call& call, Entry& entry) const;
    [[nodiscard]] Status answer_cast(const Call& call, Entry& entry) const;
    [[nodiscard]] Status answer_overlap(const Call& call, Entry& entry) const;
    /// Has the device answer inputs, as many at a time as it takes: `submit(request, inputs)` asks
    /// about some of them.
    template <class Input, class Output, class Submit>
    [[nodiscard]] static Status ask_device(ByDevice& by, const Call& call,
                                           std::span<const Input> inputs, std::span<Output> outputs,
                                           const Submit& submit);
    /// Finds those of points, or of a shape at poses: `find(inputs, hits)` finds `count` hits each.
    /// `scratch`: of some of them at a time, with what was not found.
    template <class Input, class Hit, class Find>
    [[nodiscard]] static Status write_nearest(std::span<const Input> inputs, std::uint32_t count,
                                              std::vector<Hit>& scratch, NearestLists<Hit>& lists,
                                              const Find& find);
    [[nodiscard]] std::uint32_t wanted_hits(const Entry& entry) const;
    [[nodiscard]] ShapeHandle shape_of(const Entry& entry) const;

    const Scene& scene_;
    std::span<const ShapeHandle> shapes_;
    std::span<const Instance> instances_;
    std::span<const std::size_t> sound_;
    /// The instances that queries consider, indices into Scene::instances; a world distinguishes as
    /// many groups as a category has bits.
    std::vector<std::vector<std::size_t>> groups_;
    std::vector<GroupedWorld> worlds_;
    std::vector<Entry> entries_;  ///< by index into Scene::queries
    std::vector<NearestHit> nearest_;
    std::vector<Clearance> nearest_of_shape_;
    std::vector<ShapeEdgeHit> edges_near_shape_;
};

}  // namespace nearfield::tools
