#pragma once

#include <engine/localize/closest.hpp>
#include <engine/localize/overlap.hpp>
#include <engine/plan/check_target.hpp>
#include <engine/plan/plan.hpp>
#include <engine/plan/point_tiles.hpp>
#include <engine/plan/query_shapes.hpp>
#include <engine/plan/technique.hpp>
#include <nearfield/result.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nearfield::plan {

/// Limits set by the device and the caller.
struct PlanLimits {
    std::uint32_t context = 0;          ///< number in the handles of its shapes
    geometry::SubpixelGrid subpixel;    ///< of the device
    std::uint32_t largest_tile = 1024;  ///< cells along a side
    /// Side, in cells, of tiles for boundary points. Points are sparse in their region: small tiles
    /// omit the empty parts, and each draws and tests only the edges near it.
    std::uint32_t points_tile = 64;
    /// The same for field tiles with features, where each cell searches all edges that can be
    /// nearest in its tile, or with points, which few tiles may hold.
    std::uint32_t features_tile = 64;
    std::uint32_t largest_atlas = largest_atlas_side;
    std::uint32_t largest_image = 4096;  ///< pixels along a side of a resident image
    std::uint64_t largest_range = std::uint64_t{1} << 27U;  ///< bytes that a shader can address
    std::uint64_t offset_alignment = 1;                     ///< of what it addresses, in bytes
    std::uint64_t memory = 0;                               ///< bytes a batch may need
    std::uint32_t hierarchy_height = 12;
    BoundingVolume bounding_volume = BoundingVolume::axis_aligned;
    /// By strategy: the requirements that the device lacks.
    std::array<std::vector<std::string>, intersection_strategies> missing_for_strategy;
    AvailableTechniques techniques;
};

/// How many submissions a batch may take.
enum class Submissions {
    any,  ///< further ones where the results of the first require it
    one,  ///< queries that need more are rejected
};

/// Turns queries into tiles: checks each query, localises it, cuts its regions into tiles, assigns
/// its points to them and packs all tiles of the batch. Keeps its scratch memory from batch to
/// batch.
class Planner {
public:
    explicit Planner(const PlanLimits& limits);

    /// Fills `plan` and, in `results`, everything known before rendering: status, bounds, regions.
    /// An error in one query is stored in its result and leaves it without tiles. A query that
    /// still has Technique::automatic is one that no technique of this context answers. `shapes`:
    /// of each query. `submissions`: how many the batch may take. Throws StatusException
    /// (too_large) if the batch needs more memory than the limit.
    void plan(std::span<const AnyQuery> queries, std::span<const QueryShapes> shapes, Plan& plan,
              std::vector<AnyResult>& results, Submissions submissions = Submissions::any);

    /// In place of plan(), where the call ends before: nothing is planned, and all results are
    /// empty and have this status.
    static void plan_nothing(std::span<const AnyQuery> queries, const Status& status, Plan& plan,
                             std::vector<AnyResult>& results);

    /// Milliseconds that the last plan() spent in hierarchies.
    [[nodiscard]] double localize_milliseconds() const { return localize_milliseconds_; }

private:
    struct BoxedPolygon {
        geometry::TransformedPolygon placed;
        geometry::Box box;

        BoxedPolygon(const geometry::Polygon& polygon, const Pose& pose)
            : placed(polygon, pose), box(placed.box()) {}
    };

    void plan_all(std::span<const AnyQuery> queries, std::span<const QueryShapes> shapes,
                  Plan& plan, std::vector<AnyResult>& results, Submissions submissions);
    /// Plans the current query, or states in its result why it is rejected.
    template <class Query>
    void plan_query(const Query& query, const QueryShapes& shapes, Submissions submissions,
                    typename Query::Result& result);
    template <class Query>
    [[nodiscard]] Status check_target(const Query& query);
    void add(const PenetrationQuery& query, PenetrationResult& result);
    void add(const IntersectionQuery& query, IntersectionResult& result);
    void add(const DistanceFieldQuery& query, DistanceFieldResult& result);
    void add(const ContactQuery& query, ContactResult& result);
    void add(const ClosestPointQuery& query, ClosestPointResult& result);
    void add(const SeparationQuery& query, SeparationResult& result);
    /// Nothing to plan: IntersectionTest answers it.
    void add(const IntersectionTestQuery& /*query*/, IntersectionTestResult& /*result*/) {}
    /// Nothing to plan: TimeOfImpact answers it.
    void add(const TimeOfImpactQuery& /*query*/, TimeOfImpactResult& /*result*/) {}
    /// Nothing to plan: SeparationVector answers it.
    void add(const SeparationVectorQuery& /*query*/, SeparationVectorResult& /*result*/) {}
    /// Nothing to plan: Containment answers it.
    void add(const ContainmentQuery& /*query*/, ContainmentResult& /*result*/) {}

    [[nodiscard]] bool can_be_searched(double samples, double bytes_of_record);
    void search(double reach, bool both_ways, ResultSummary& result);

    /// Checks that the device has what a strategy needs, if a device is involved; the result states
    /// the error.
    [[nodiscard]] bool check_strategy(IntersectionStrategy strategy, ResultSummary& result) const;
    /// Checks that the deviations and the boxes of both shapes are compatible with the tolerance;
    /// the result states the error.
    [[nodiscard]] bool check_boxes(const geometry::Box& a, const geometry::Box& b,
                                   ResultSummary& result) const;
    /// Finds boxes (boxes_) that cover everything that two volumes, or a boundary and its
    /// neighbourhood, have in common; all of it lies in `within`.
    void find_common_volume(const geometry::TransformedPolygon& a,
                            const geometry::TransformedPolygon& b, const geometry::Box& within,
                            ResultSummary& result);
    void find_near_boundary(IntersectionKind kind, const geometry::TransformedPolygon& a,
                            const geometry::TransformedPolygon& b, const geometry::Box& within,
                            ResultSummary& result);

    /// The box that a field covers; empty if there is none, and then the result states why.
    [[nodiscard]] std::optional<geometry::Box> field_box(const DistanceFieldQuery& query,
                                                         ResultSummary& result) const;
    /// Checks that tolerance and deviations are compatible with coordinates and distances this
    /// large.
    [[nodiscard]] bool check_field(const geometry::Box& box, ResultSummary& result) const;
    void require_field_memory(const DistanceFieldQuery& query, const Grid& grid);
    /// Checks that the images of a resident field fit the device; the result states the error.
    [[nodiscard]] bool check_resident(const Grid& grid, DistanceFieldResult& result);
    /// The same for the samples of an intersection.
    [[nodiscard]] bool check_resident(const IntersectionQuery& query, IntersectionResult& result);
    /// Checks that the records of the current query, whose points are planned, fit the host's
    /// buffer, if it names one. Otherwise drops its tiles, from `first_tile` on, and its points;
    /// the result states the error.
    void check_resident(const ResidentBufferTarget* target, std::size_t first_tile,
                        ResultSummary& result);
    [[nodiscard]] double bytes_of_samples(const IntersectionQuery& query) const;
    void add_closest(double tolerance, bool both_ways, ResultSummary& result);
    /// Finds the chains that can hold contacts; returns an upper bound on their samples.
    [[nodiscard]] double find_contact_chains(const geometry::TransformedPolygon& a,
                                             const geometry::TransformedPolygon& b,
                                             double contact_distance,
                                             std::vector<localize::Chain>& chains,
                                             ResultSummary& result);
    void add_contact_points(std::uint32_t index, double contact_distance,
                            const std::vector<localize::Chain>& chains, double samples,
                            ResultSummary& result);
    /// Finds the chains that can hold the closest point; returns an upper bound on their samples.
    [[nodiscard]] double find_closest_chains(std::uint32_t index,
                                             std::vector<localize::Chain>& chains,
                                             ResultSummary& result);
    void add_closest_points(std::uint32_t index, const std::vector<localize::Chain>& chains,
                            ResultSummary& result);

    /// Checks that deviations and coordinates are compatible with the tolerance; the result states
    /// the error.
    [[nodiscard]] bool check_numbers(ResultSummary& result) const;
    [[nodiscard]] bool check_numbers(const BoxedPolygon& a, const BoxedPolygon& b,
                                     ResultSummary& result) const;
    /// Returns whether this many boundary samples, and what is derived from them, may be kept at
    /// once.
    [[nodiscard]] bool can_keep(double samples);
    /// Returns whether a query may be answered by brute force over all its samples. The memory for
    /// its records is estimated roughly, unless the rough estimate exceeded the limit before.
    [[nodiscard]] bool fits_roughly(double samples, double bytes_of_record);
    /// The same for the samples that localisation leaves. Throws StatusException (too_large) if
    /// their records do not fit.
    [[nodiscard]] bool fits(double samples, double bytes_of_record, double tolerance);
    std::uint32_t add_reverse();
    /// Samples the current chains; `samples` is an upper bound on their number.
    void sample_boundary(const geometry::TransformedPolygon& polygon, const geometry::Box& within,
                         double samples, const ResultSummary& result);
    void spread_points(std::uint32_t index, const geometry::Box& within, ResultSummary& result);
    [[nodiscard]] localize::OverlapOptions overlap_options(double grow) const;
    void count(const localize::Effort& effort, ResultSummary& result) const;
    void require_sides(double tolerance) const;
    [[nodiscard]] double bytes_of_tiles() const;
    [[nodiscard]] double bytes_of_masks(int masks) const;
    /// For queries without output at every cell: drops the query's tiles that hold no point.
    void drop_tiles_without_points(std::uint32_t first_tile);
    void join_chain_boxes(const geometry::Box& within, double grow);
    void add_regions(double cell, ResultSummary& result);
    /// Cuts a region into tiles of at most `side` x `side` cells, row by row; each is drawn with a
    /// halo of cells around it. Tiles of queries that the CPU answers are kept apart.
    void cut_into_tiles(std::uint32_t region, TileKind kind, std::uint32_t side,
                        std::uint32_t halo);
    /// Side of a field's tiles in cells, without the halo.
    [[nodiscard]] std::uint32_t field_tile(const FieldParts& parts) const;
    /// Assigns the points of a field to the tiles that it will be cut into.
    [[nodiscard]] Status add_field_points(const DistanceFieldQuery& query, const Grid& grid,
                                          std::uint32_t first_tile);
    void require_memory(double bytes, double tolerance, double growth);
    void pack_drawn_tiles();
    void pack();
    void add_compute_tile_batches();

    PlanLimits limits_;
    AtlasPacker packer_;
    Targets targets_;                  // of the batch
    double memory_of_images_ = 0.0;    // bytes
    double memory_for_results_ = 0.0;  // bytes
    double query_bytes_ = 0.0;         // needed by the current query
    Plan* plan_ = nullptr;             // of the call in progress
    std::uint32_t query_ = 0;
    double localize_milliseconds_ = 0.0;
    double max_to_keep_ = 0.0;     // samples of a query, at once
    double max_kept_ = 0.0;        // of any query of the batch
    double rough_bytes_ = 0.0;     // that records may take of queries that were not localised
    bool counts_closely_ = false;  // those are localised too, so that they need less memory

    // Scratch.
    localize::ClosestChains closest_;
    std::array<std::vector<localize::Chain>, 2> chains_of_;  // A and B
    std::vector<localize::Chain> chains_;
    std::vector<geometry::Box> boxes_;
    std::vector<Grid> grids_;
    std::vector<BoundaryPoint> samples_;
    PointTiles point_tiles_{64};
    std::vector<std::uint32_t> kept_tiles_;
    /// Tiles that the same draws serve.
    struct DrawnTogether {
        std::vector<std::uint32_t> tiles;
        std::vector<TileSize> sizes;
    };
    std::array<DrawnTogether, 1 + intersection_strategies> drawn_together_;
    std::vector<AtlasPlace> places_;
};

}  // namespace nearfield::plan
