#pragma once

#include <engine/localize/closest.hpp>
#include <engine/localize/overlap.hpp>
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

/// What the device and the caller allow.
struct PlanLimits {
    geometry::SubpixelGrid subpixel;
    std::uint32_t largest_tile = 1024;  ///< cells along a side
    /// Cells along a side of tiles for boundary points, which fill their region thinly: small tiles
    /// leave out what holds no point, and each draws and tests the edges near it only.
    std::uint32_t points_tile = 64;
    /// The same of tiles of a field with features, where each cell looks through all edges that can
    /// be nearest in its tile, or with points, of which few tiles may hold any.
    std::uint32_t features_tile = 64;
    std::uint32_t largest_atlas = 2048;
    std::uint32_t largest_image = 4096;  ///< pixels along a side of an image that stays there
    std::uint64_t largest_range = std::uint64_t{1} << 27U;  ///< bytes that a shader can address
    std::uint64_t memory = 0;                               ///< bytes a batch may need
    std::uint32_t hierarchy_height = 12;
    BoundingVolume bounding_volume = BoundingVolume::axis_aligned;
    /// By strategy: what it needs and the device lacks.
    std::array<std::vector<std::string>, intersection_strategies> missing_for_strategy;
    AvailableTechniques techniques;
};

/// How often a batch may go to the device.
enum class Submissions {
    any,  ///< again, where what came back asks for more
    one,  ///< what would take more is refused
};

/// From queries to tiles: checks each query, localises it, cuts its regions into tiles, spreads
/// points over them and packs all tiles of the batch. Keeps its scratch memory from batch to batch.
class Planner {
public:
    explicit Planner(const PlanLimits& limits);

    /// Fills `plan` and, in `results`, everything that is known before rendering: status, bounds,
    /// regions. What is wrong with one query stands in its result and leaves it without tiles. A
    /// query that still has Technique::automatic is one that no technique of this context answers.
    /// `shapes`: of each query. `submissions`: that the batch may take. Throws Failure (too_large)
    /// where the batch needs more memory than the limit.
    void plan(std::span<const AnyQuery> queries, std::span<const QueryShapes> shapes, Plan& plan,
              std::vector<AnyResult>& results, Submissions submissions = Submissions::any);

    /// Milliseconds of the last plan() spent in hierarchies.
    [[nodiscard]] double localize_milliseconds() const { return localize_milliseconds_; }

private:
    void plan_all(std::span<const AnyQuery> queries, std::span<const QueryShapes> shapes,
                  Plan& plan, std::vector<AnyResult>& results, Submissions submissions);
    void add(const PenetrationQuery& query, PenetrationResult& result);
    void add(const IntersectionQuery& query, IntersectionResult& result);
    void add(const DistanceFieldQuery& query, DistanceFieldResult& result);
    void add(const ContactQuery& query, ContactResult& result);
    void add(const ClosestPointQuery& query, ClosestPointResult& result);
    void add(const SeparationQuery& query, SeparationResult& result);
    /// There is nothing to plan: IntersectionTest answers it.
    void add(const IntersectionTestQuery& /*query*/, IntersectionTestResult& /*result*/) {}
    /// Nor here: TimeOfImpact answers it.
    void add(const TimeOfImpactQuery& /*query*/, TimeOfImpactResult& /*result*/) {}
    /// Nor here: SeparationVector answers it.
    void add(const SeparationVectorQuery& /*query*/, SeparationVectorResult& /*result*/) {}

    /// Whether the device has what a strategy needs, where that matters; if not, the result says
    /// so.
    [[nodiscard]] bool check_strategy(IntersectionStrategy strategy, ResultSummary& result) const;
    /// Whether deviations and the boxes of both shapes leave room for the tolerance; likewise.
    [[nodiscard]] bool check_boxes(const geometry::Box& a, const geometry::Box& b,
                                   ResultSummary& result) const;
    /// Finds boxes (boxes_) around all that two volumes, or a boundary and what is near it, have in
    /// common; `within`: nothing of it lies elsewhere.
    void find_common_volume(const geometry::PlacedPolygon& a, const geometry::PlacedPolygon& b,
                            const geometry::Box& within, ResultSummary& result);
    void find_near_boundary(IntersectionKind kind, const geometry::PlacedPolygon& a,
                            const geometry::PlacedPolygon& b, const geometry::Box& within,
                            ResultSummary& result);

    /// The box that a field covers; none, and the result says why, where it has none.
    [[nodiscard]] std::optional<geometry::Box> field_box(const DistanceFieldQuery& query,
                                                         ResultSummary& result) const;
    /// Whether tolerance and deviations allow for coordinates and distances as large as these.
    [[nodiscard]] bool check_field(const geometry::Box& box, ResultSummary& result) const;
    void require_field_memory(const DistanceFieldQuery& query, const Grid& grid);
    /// Whether the images of a field that stays on the device can be had; else the result says why.
    [[nodiscard]] bool check_resident(const Grid& grid, DistanceFieldResult& result);
    /// The same of the samples of an intersection.
    [[nodiscard]] bool check_resident(const IntersectionQuery& query, IntersectionResult& result);
    [[nodiscard]] double bytes_of_samples(const IntersectionQuery& query) const;
    void add_closest(double tolerance, bool both_ways, ResultSummary& result);
    /// The chains that can hold contacts, and how many samples they take at the most.
    [[nodiscard]] double find_contact_chains(const geometry::PlacedPolygon& a,
                                             const geometry::PlacedPolygon& b,
                                             double contact_distance,
                                             std::vector<localize::Chain>& chains,
                                             ResultSummary& result);
    void add_contact_points(std::uint32_t index, double contact_distance,
                            const std::vector<localize::Chain>& chains, double samples,
                            ResultSummary& result);
    /// The chains that can hold the closest point, and how many samples they take at the most.
    [[nodiscard]] double find_closest_chains(std::uint32_t index,
                                             std::vector<localize::Chain>& chains,
                                             ResultSummary& result);
    void add_closest_points(std::uint32_t index, const std::vector<localize::Chain>& chains,
                            ResultSummary& result);

    /// Whether deviations and coordinates leave room for the tolerance; if not, the result says so.
    [[nodiscard]] bool check_numbers(ResultSummary& result) const;
    /// Whether so many samples of boundaries may be kept at once, beside what comes of them.
    [[nodiscard]] bool can_keep(double samples);
    /// Whether a query may be answered edge by edge, by all samples there are; what their records
    /// may take is counted roughly then, unless that was too much before.
    [[nodiscard]] bool fits_roughly(double samples, double bytes_of_record);
    /// The same by the samples that localisation leaves. Throws Failure (too_large) where their
    /// records do not fit.
    [[nodiscard]] bool fits(double samples, double bytes_of_record, double tolerance);
    std::uint32_t add_reverse();
    /// Of the chains at hand, which have so many `samples` at the most.
    void sample_boundary(const geometry::PlacedPolygon& polygon, const geometry::Box& within,
                         double samples, const ResultSummary& result);
    void spread_points(std::uint32_t index, const geometry::Box& within, ResultSummary& result);
    [[nodiscard]] localize::OverlapOptions overlap_options(double grow) const;
    void count(const localize::Effort& effort, ResultSummary& result) const;
    void require_sides(double tolerance) const;
    [[nodiscard]] double bytes_of_tiles() const;
    [[nodiscard]] double bytes_of_masks(int masks) const;
    /// Where nothing is asked for at every cell: drops the tiles of the query that hold no point.
    void drop_tiles_without_points(std::uint32_t first_tile);
    void join_chain_boxes(const geometry::Box& within, double grow);
    void add_regions(double cell, ResultSummary& result);
    /// Cuts a region into tiles of at most `side` x `side` cells, row by row; each is drawn with a
    /// halo of cells around it. Tiles of queries that the CPU answers are kept apart.
    void cut_into_tiles(std::uint32_t region, TileKind kind, std::uint32_t side,
                        std::uint32_t halo);
    /// Cells along a side of a field's tiles, without the halo.
    [[nodiscard]] std::uint32_t field_tile(const FieldParts& parts) const;
    /// Spreads the points of a field over the tiles that it will be cut into.
    [[nodiscard]] Status add_field_points(const DistanceFieldQuery& query, const Grid& grid,
                                          std::uint32_t first_tile);
    void require_memory(double bytes, double tolerance, double growth);
    void pack();
    void add_compute_rounds();

    PlanLimits limits_;
    AtlasPacker packer_;
    double memory_for_results_ = 0.0;  // bytes
    double query_bytes_ = 0.0;         // that the query at hand needs
    Plan* plan_ = nullptr;             // of the call in progress
    std::uint32_t query_ = 0;
    double localize_milliseconds_ = 0.0;
    double most_to_keep_ = 0.0;    // samples of a query, at once
    double most_kept_ = 0.0;       // of any query of the batch
    double rough_bytes_ = 0.0;     // that records may take of queries that were not localised
    bool counts_closely_ = false;  // those are localised too, so that less need be kept for them

    // Scratch.
    localize::ClosestChains closest_;
    std::array<std::vector<localize::Chain>, 2> chains_of_;  // A and B
    std::vector<localize::Chain> chains_;
    std::vector<geometry::Box> boxes_;
    std::vector<Grid> grids_;
    std::vector<BoundaryPoint> samples_;
    PointTiles point_tiles_{64};
    std::vector<std::uint32_t> kept_tiles_;
    std::vector<TileSize> sizes_;
    std::vector<AtlasPlace> places_;
};

}  // namespace nearfield::plan
