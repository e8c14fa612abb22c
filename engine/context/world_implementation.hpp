#pragma once

#include <engine/base/jobs.hpp>
#include <engine/context/implementation.hpp>
#include <engine/world/hilbert_curve.hpp>
#include <engine/world/instances.hpp>
#include <engine/world/nearest_queries.hpp>
#include <engine/world/overlap_queries.hpp>
#include <engine/world/pose_queries.hpp>
#include <engine/world/ray_queries.hpp>
#include <nearfield/world.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace nearfield {

/// What a world consists of. Its members are those of the public class, and throw.
class World::Implementation {
public:
    explicit Implementation(Context::Implementation& context);

    [[nodiscard]] InstanceHandle add(const WorldInstance& instance);
    void move(std::span<const InstanceHandle> instances, std::span<const Pose> poses);
    void set_filter(InstanceHandle instance, std::uint32_t category, std::uint32_t mask);
    void remove(InstanceHandle instance);
    [[nodiscard]] WorldInstance instance(InstanceHandle instance) const;
    [[nodiscard]] std::uint32_t size() const { return instances_.count(); }

    void test_poses(const PoseTestQuery& query, std::span<const Pose> poses,
                    std::span<std::uint8_t> intersects);
    void find_clearances(const ClearanceQuery& query, std::span<const Pose> poses,
                         std::span<Clearance> clearances);
    void find_nearest(const NearestQuery& query, std::span<const Vector2> points,
                      std::span<NearestHit> hits);
    void cast_rays(std::span<const Segment> segments, std::span<RayHit> hits,
                   const WorldFilter& filter);
    void cast_rays(std::span<const Segment> segments, RayHits& hits, const WorldFilter& filter);
    void cast_shape(const ShapeCastQuery& query, std::span<const Sweep> sweeps,
                    std::span<ShapeCastHit> hits);
    void find_overlaps(std::span<const Rectangle> rectangles, InstanceLists& lists,
                       const WorldFilter& filter);
    void find_overlaps(std::span<const Vector2> points, InstanceLists& lists,
                       const WorldFilter& filter);
    void find_overlaps(const PoseTestQuery& query, std::span<const Pose> poses,
                       InstanceLists& lists);

    [[nodiscard]] std::uint64_t bytes() const;
    void trim();

private:
    /// What one job needs. Kept, so that a frame like the one before allocates nothing.
    struct Job {
        world::PoseQueries poses;
        world::NearestQueries nearest;
        world::RayQueries rays;
        world::OverlapQueries overlaps;
        std::vector<std::uint32_t> found;
    };
    /// Part of a shape cast's answer.
    struct Candidate {
        std::size_t sweep;
        std::uint32_t instance;
    };

    /// Takes in what has changed in the world.
    void prepare();
    [[nodiscard]] const geometry::Polygon& shape(ShapeHandle handle, const char* call) const;
    /// Writes one list per entry; `find(job, i, found)` appends the instances of entry i.
    template <class Find>
    void write_lists(std::size_t count, InstanceLists& lists, const Find& find);
    void find_candidates(const ShapeCastQuery& query, const geometry::Polygon& shape,
                         const Sweep& sweep, std::size_t number);
    void answer_candidates(const ShapeCastQuery& query, std::span<const Sweep> sweeps,
                           std::span<ShapeCastHit> hits);

    Context::Implementation* context_;
    world::Instances instances_;
    Jobs jobs_;
    std::vector<Job> scratch_;  // by job
    world::HilbertOrder hilbert_order_;
    Batch batch_;  // of shape casts
    Results results_;
    std::vector<Candidate> candidates_;  // by query of the batch
};

}  // namespace nearfield
