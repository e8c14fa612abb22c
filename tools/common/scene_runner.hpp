#pragma once

#include <nearfield/context.hpp>

#include <tools/common/device_pair_runner.hpp>
#include <tools/common/world_runner.hpp>
#include <tools/io/answer.hpp>
#include <tools/io/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::tools {

/// Parses the option --technique, if given.
[[nodiscard]] std::optional<Technique> parse_technique_option(
    const std::optional<std::string>& name);

/// Sets the technique of all queries in a scene, if given.
void set_technique(Scene& scene, std::optional<Technique> technique);

/// What a frame passes to the library.
enum class FrameInput {
    all,  ///< the vertices of all shapes, as if they had deformed, and all poses of pairs
    /// Poses alone, each by its last bit another one than in the frame before; shapes stay as they
    /// are, as do the instances that queries of all instances ask about.
    poses,
    nothing,  ///< the batch of the frame before, as it was
};

/// Runs a scene in a context frame by frame.
class SceneRunner {
public:
    /// `file` is for the messages. Throws LibraryError where a shape is refused, unless bad entries
    /// are recorded: the queries that need it then have a status that names it.
    SceneRunner(const Scene& scene, std::string file, Context& context,
                BadEntries bad = BadEntries::refused);
    /// Takes its shapes out of the context.
    ~SceneRunner();
    SceneRunner(const SceneRunner&) = delete;
    SceneRunner& operator=(const SceneRunner&) = delete;

    /// The answers of the next frames state the time of each query of pairs.
    void time_queries() noexcept { batch_.time_queries(true); }

    /// Runs one whole frame: shapes (which may have deformed), poses and queries in, results out.
    /// Returns the time in milliseconds. Throws LibraryError if the batch as a whole fails.
    double run_frame(FrameInput input = FrameInput::all);

    /// As run_frame(), but where the batch as a whole is too large every query is answered by
    /// itself, so that only those that are too large are not answered. Queries that the limits end
    /// have the status cancelled.
    void run_what_fits(const Limits& limits);

    /// What is wrong with shapes, instances and queries of the last frame, each with its place;
    /// not with queries that merely need something bad, or were cancelled.
    [[nodiscard]] std::vector<Status> problems() const;
    /// How many of the queries need a shape or an instance that is bad.
    [[nodiscard]] std::size_t dependent_count() const;
    /// How many of the queries were cancelled.
    [[nodiscard]] std::size_t cancelled_count() const;

    /// Throws LibraryError where a query of the last frame was refused.
    void require_results() const;

    /// The answers of the last frame in the order of the scene's queries; a query for all pairs has
    /// its answers in pair order. Valid until the next frame.
    [[nodiscard]] std::vector<SceneAnswer> answers() const;
    /// The technique that answered the queries of the last frame; "mixed" if there were several,
    /// "none" if there were no queries.
    [[nodiscard]] std::string_view technique() const;
    /// The number of queries in the last frame, counting every pair of "all pairs".
    [[nodiscard]] std::size_t query_count() const noexcept { return entries_.size(); }
    /// The number of pairs that the last frame asked about: once for each query of each pair.
    [[nodiscard]] std::size_t pair_count() const;
    /// The number of poses, points, segments, sweeps and rectangles that it asked about.
    [[nodiscard]] std::size_t world_input_count() const;
    [[nodiscard]] const Timings& timings() const noexcept { return results_.timings; }

private:
    /// A query that was asked: which of the scene's, between which instances.
    struct Entry {
        static constexpr std::size_t all = SIZE_MAX;  ///< in place of an instance: all pairs
        std::size_t query = 0;
        std::size_t a = 0;
        std::size_t b = 0;
        std::size_t result = 0;   ///< in the batch, or among those refused
        bool is_refused = false;  ///< before the batch
        bool is_dependent = false;
        bool is_world = false;  ///< a query of all instances
        bool is_table = false;  ///< of all pairs, found by the device
    };

    void add_shapes();
    void add_instances();
    [[nodiscard]] PairSelection select(const GroupPair& groups) const;
    void update_shapes();
    /// Gives every instance of a pair another pose, next to the scene's own, or that one again.
    void move_instances();
    void add_queries();
    void add_to(Batch& batch, const Entry& entry) const;
    void add(std::size_t query, std::size_t a, std::size_t b);
    void refuse(Entry entry, const std::string& reason);
    void add_pair(std::size_t query);
    void add_all_pairs(std::size_t query);
    /// For time-of-impact queries.
    void add_moving_pairs(std::size_t query, const PairSelection& among);
    void add_near_pairs(std::size_t query, const PairSelection& among);
    void add_selected(std::size_t query, const PairSelection& among, InstancePair pair);
    void add_world_query(std::size_t query);
    /// An entry of all pairs or instances that is answered after the batch.
    void add_pending(Entry entry, Technique technique);
    void answer_pending(const Limits& limits);
    [[nodiscard]] const PairSelection& selection_of(std::size_t query) const;
    [[nodiscard]] SceneAnswer answer_of(const Entry& entry) const;
    template <class Action>
    void for_each_status(const Action& action) const;
    void answer_one_by_one(const Limits& limits);
    [[nodiscard]] static bool is_of_batch(const Entry& entry) {
        return !entry.is_refused && !entry.is_world && !entry.is_table;
    }
    [[nodiscard]] const AnyResult& result_of(const Entry& entry) const;
    /// Null if there is none.
    [[nodiscard]] const QueryTime* time_of(const Entry& entry) const;
    [[nodiscard]] bool is_usable(std::size_t instance) const;
    /// "lid (shapes.box), left": with the shape where that is what is wrong.
    [[nodiscard]] std::string names_of_bad(const std::vector<std::size_t>& instances) const;
    [[nodiscard]] std::vector<std::size_t> all_instances() const;
    [[nodiscard]] std::string place_of(const SceneShape& shape) const;
    [[nodiscard]] std::string place_of(std::size_t query) const;

    const Scene& scene_;
    std::string file_;
    Context& context_;
    BadEntries bad_;
    std::vector<ShapeHandle> shapes_;  ///< the default handle for a bad one
    std::vector<Instance> instances_;
    std::vector<std::string> shape_problems_;         ///< empty for those that can be used
    std::vector<std::string> instance_problems_;      ///< likewise
    bool is_moved_ = false;                           ///< see move_instances()
    PairSelection all_;                               ///< all instances that can be used
    std::map<std::size_t, PairSelection> between_;    ///< by query, for pairs between groups
    std::optional<WorldRunner> worlds_;               ///< if there are queries of all instances
    std::map<std::size_t, DevicePairRunner> tables_;  ///< by query, if the device finds the pairs
    std::vector<Entry> entries_;
    std::vector<AnyResult> outside_batch_;  ///< of what is refused, or answered after the batch
    Batch batch_;
    Results results_;
};

}  // namespace nearfield::tools
