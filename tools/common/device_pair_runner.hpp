#pragma once

#include <nearfield/context.hpp>
#include <nearfield/world.hpp>
#include <nearfield/world_pairs.hpp>

#include <tools/io/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace nearfield::tools {

/// The instances between which a query of all pairs forms pairs.
struct PairSelection {
    std::vector<std::size_t> sound;   ///< indices into Scene::instances, ascending
    std::vector<Instance> instances;  ///< the same
    std::vector<unsigned> sides;      ///< of each: 1 in the first group, 2 in the second
    std::string names_of_bad;         ///< those that cannot be used
};

/// True of a query of all pairs whose hits a table of the device finds (PairTable).
[[nodiscard]] bool is_for_device_pairs(const SceneQuery& query);

/// A query of all pairs of a scene, of which the device finds the hits. What is on the device stays
/// there from frame to frame.
class DevicePairRunner {
public:
    /// A hit, or an error of one pair.
    struct Row {
        std::size_t a = 0;  ///< index into Scene::instances
        std::size_t b = 0;
        AnyResult result;
    };

    /// `request`: of a query that is_for_device_pairs(); must outlive the runner. Throws
    /// LibraryError.
    DevicePairRunner(const QueryRequest& request, Context& context, const PairSelection& among);

    /// Finds the hits at these poses, of the same instances in the same order, and reads them. Adds
    /// the times of the device. After an error there are none.
    [[nodiscard]] Status answer(std::span<const Instance> instances, const Limits& limits,
                                Timings& timings);

    /// The last ones, in the order in which a batch answers them: by pair, then by A. Valid until
    /// the next call.
    [[nodiscard]] std::span<const Row> rows() const { return {rows_.data(), row_count_}; }
    /// The number of queries of single pairs that a batch would have had.
    [[nodiscard]] std::size_t pair_count() const;

private:
    using Table = std::variant<PairTable<PenetrationQuery>, PairTable<ContactQuery>,
                               PairTable<IntersectionTestQuery>, PairTable<SeparationQuery>,
                               PairTable<ClosestPointQuery>>;

    [[nodiscard]] static Table table_of(const QueryRequest& request);
    template <class Query>
    [[nodiscard]] Status read_rows(PairTable<Query>& table, const Limits& limits);
    template <class Query>
    [[nodiscard]] Status read_row(PairTable<Query>& table, std::uint32_t index, Row& read);
    template <class Query>
    [[nodiscard]] Status error_of(Query query, const PairRow<Query>& row);

    const QueryRequest& request_;
    Context& context_;
    World world_;
    Table table_;
    std::vector<std::size_t> order_;  ///< in which instances were added: indices into the selection
    std::vector<InstanceHandle> handles_;  ///< in this order
    std::vector<std::size_t> indices_;     ///< into Scene::instances, by InstanceHandle::index
    std::vector<Pose> poses_;
    std::vector<Row> rows_;  ///< their memory is kept
    std::size_t row_count_ = 0;
};

}  // namespace nearfield::tools
