#pragma once

#include <engine/base/interruption.hpp>
#include <engine/batch/contacts.hpp>
#include <engine/batch/point_resolver.hpp>
#include <engine/device_input/pair_question.hpp>
#include <engine/device_input/plan.hpp>
#include <engine/render/pair_search_buffers.hpp>
#include <engine/solvers/found_contacts.hpp>
#include <engine/solvers/solver_jobs.hpp>
#include <engine/world/device_instances.hpp>
#include <engine/world/pair_row.hpp>
#include <engine/world/world_view.hpp>
#include <nearfield/device_poses.hpp>
#include <nearfield/pairs_on_device.hpp>
#include <nearfield/submission.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace nearfield {

/// The pairs of a table that the device finds and answers, and what rows are read from. Its members
/// throw; after start() or finish() has, start_anew() has to be called.
class DevicePairs {
public:
    /// Precondition: device_input::is_for_all_pairs(query), which has to stay, as the options.
    DevicePairs(const AnyQuery& query, const PairTableOptions& options, Timings& timings);
    ~DevicePairs();
    DevicePairs(const DevicePairs&) = delete;
    DevicePairs& operator=(const DevicePairs&) = delete;

    /// Lets the device begin, or records what it does into commands of the host, which submits them
    /// as many times as it calls collect_recorded(). `call`: for messages. `input`: where poses
    /// come from and results go, if that is the host's.
    void start(const char* call, const WorldView& world, const PairTableInput& input,
               const Recording* recording);
    /// Waits, and makes the rows of what was started.
    void finish();
    /// The same of what was recorded; what uses it stays whatever happens.
    void collect_recorded();
    void start_anew();
    /// Throws if what was collected last does not all fit the host's buffers; rows are there.
    void require_room_of_target();
    /// Throws unless it may be started again.
    void require_collected(const char* call) const;
    /// Throws unless the frame that it was recorded for, if it was, is complete.
    void require_complete_frame(const char* call) const;
    [[nodiscard]] bool is_submitted() const { return is_submitted_; }
    [[nodiscard]] bool is_for_frame() const { return frame_.has_value(); }
    /// Whether what was recorded is about the world as it is, and has room.
    [[nodiscard]] bool is_recorded(const WorldView& world) const;
    [[nodiscard]] bool is_ready() const;
    [[nodiscard]] PairTableCounts found() const noexcept;
    [[nodiscard]] PairTableCounts capacity() const {
        return buffers_ == nullptr ? PairTableCounts{} : buffers_->room();
    }
    void trim() noexcept;
    /// Precondition: the query is resident.
    [[nodiscard]] PairsOnDevice on_device() const;
    [[nodiscard]] std::uint32_t size() const { return rows_; }
    [[nodiscard]] std::uint32_t candidates() const;
    [[nodiscard]] std::uint32_t left_to_cpu() const {
        return static_cast<std::uint32_t>(decided_.size());
    }

    // Preconditions: `index` is below size(); of records, the query has them.
    void row(std::uint32_t index, PairRow<PenetrationQuery>& row);
    void row(std::uint32_t index, PairRow<ContactQuery>& row);
    void row(std::uint32_t index, PairRow<IntersectionTestQuery>& row);
    void row(std::uint32_t index, PairRow<ClosestPointQuery>& row) { row_of_cpu(index, row); }
    void row(std::uint32_t index, PairRow<SeparationQuery>& row) { row_of_cpu(index, row); }
    void records(std::uint32_t index, std::vector<PenetratingPoint>& records);
    void records(std::uint32_t index, std::vector<ContactPoint>& records);
    void manifold(std::uint32_t index, std::vector<ContactCluster>& manifold);

private:
    /// A pose of the host's is taken when it is needed (pair_of()).
    using PairInstance = DeviceInstances::Entry;
    /// A row that the CPU decided. Its answer, unless it is that of an intersection test, is the
    /// result with the same index.
    struct Decided {
        std::uint32_t row = 0;      // of the device
        bool has_row = false;       // in the table
        shaders::PairRowData pair;  // its instances
    };

    void set_submitted(bool is_submitted);
    void report_open_frame() const noexcept;
    void set_poses(const DevicePoses* poses);
    /// Says where the device finds the host's poses. `call`: for messages.
    void find_poses(const char* call);
    void check_target(const char* call, const PairTarget& target) const;
    /// What the device has found out about a pair; the poses of both instances are taken.
    [[nodiscard]] shaders::PairRowData pair_of(std::uint32_t device_row);
    void take_pose(std::uint32_t number);
    /// Those of a pair, if they are the host's.
    void take_poses(const shaders::PairRowData& pair);
    void require_usable_poses();
    /// What the device has lost where it took the pose of an instance.
    [[nodiscard]] double rounding_of(const PairInstance& entry) const;
    void check(const char* call) const;
    void order_instances(const world::Instances& instances);
    [[nodiscard]] bool boxes_meet(const shaders::PairRowData& data) const;
    [[nodiscard]] bool is_hit(const AnyResult& answer, const shaders::PairRowData& data) const;
    [[nodiscard]] bool do_share_a_point(const shaders::PairRowData& pair);
    void answer_undecided();
    void decide();
    /// The device's row of a row of the table.
    [[nodiscard]] std::uint32_t device_row(std::uint32_t index) const;
    /// What the CPU answered; null if the device decided.
    [[nodiscard]] const AnyResult* find_decided(std::uint32_t row) const;
    [[nodiscard]] AnyQuery query_on_cpu(const shaders::PairRowData& data, bool with_records) const;
    [[nodiscard]] const geometry::Polygon* polygon_of(ShapeHandle shape) const {
        return instances_.polygon_of(shape);
    }
    /// Asks the CPU about `count` pairs: calls `take(i, result)` for each `pair_of(i)`.
    template <class PairOf, class Take>
    void ask_cpu(std::size_t count, bool with_records, const PairOf& pair_of, const Take& take);
    [[nodiscard]] const AnyResult& answer_on_cpu(const shaders::PairRowData& data,
                                                 bool with_records);
    template <class Query>
    void row_of_cpu(std::uint32_t index, PairRow<Query>& row) {
        const std::uint32_t number = device_row(index);
        const shaders::PairRowData data = pair_of(number);
        const AnyResult* const decided = find_decided(number);
        const AnyResult& answer = decided != nullptr ? *decided : answer_on_cpu(data, false);
        fill(row, data, std::get<typename Query::Result>(answer));
    }
    /// The pair as a planned query, until the next one.
    [[nodiscard]] const device_input::PlannedQuery& plan_pair(const shaders::PairRowData& data);
    [[nodiscard]] batch::QueryPoints points_of(std::uint32_t row, std::uint32_t first,
                                               std::uint32_t count) const {
        return {.found = buffers_->records(row, first, count)};
    }
    /// Those of a row of the device.
    void find_contacts(const shaders::PairRowData& data, std::uint32_t row);
    /// The manifold of a pair of contacts and, if the query asks for them, their records; until the
    /// next call of any kind.
    [[nodiscard]] ContactResult& contacts_of(const shaders::PairRowData& data, std::uint32_t row);
    [[nodiscard]] bool do_intersect(const shaders::PairRowData& data);
    /// A row that says of its pair what a result does.
    template <class Query>
    void fill(PairRow<Query>& row, const shaders::PairRowData& data,
              const typename Query::Result& result) const {
        row = row_of<Query>(instances_[data.a].handle, instances_[data.b].handle, result);
        if constexpr (requires { result.count; }) {
            row.point_count = question_.records ? result.count : 0;
        }
    }

    const AnyQuery& query_;
    const PairTableOptions& options_;
    Timings& timings_;
    const device_input::PairQuestion question_;  // that it asks of the device
    std::optional<DevicePoses> poses_;           // of the host
    batch::PointResolver resolver_;
    std::shared_ptr<Context::Implementation> context_;
    std::weak_ptr<const void> world_;
    std::unique_ptr<render::PairSearchBuffers> buffers_;
    PairTableCounts reserve_;  // for buffers that are made
    DeviceInstances instances_{query_, question_};
    std::uint32_t rows_ = 0;
    std::vector<Decided> decided_;             // in ascending order of the rows
    std::vector<AnyResult> decided_results_;   // of the first ones; the rest is memory
    std::vector<std::uint32_t> dropped_rows_;  // of the device, in ascending order
    // For reading rows, as are those that follow: a pair, and its other direction.
    device_input::PlannedQuery of_a_;
    device_input::PlannedQuery of_b_;
    std::vector<solvers::SolverJobs::Question> questions_;  // to the CPU, by job
    batch::ContactDecoder contact_decoder_;
    solvers::FoundContacts found_contacts_;
    ContactResult contacts_;
    narrowphase::OverlapTest overlap_test_;
    simd::TransformedInstances edges_;
    std::optional<std::uint64_t> frame_;  // of the host, that it was recorded for
    std::uint32_t renderer_ = 0;          // number of that of the last update
    bool are_poses_taken_ = false;        // by the device, of the present instances
    bool is_submitted_ = false;           // or recorded, and not collected
    bool lacks_room_ = false;             // what was recorded
};

template <class PairOf, class Take>
void DevicePairs::ask_cpu(std::size_t count, bool with_records, const PairOf& pair_of,
                          const Take& take) {
    solvers::SolverJobs& solvers = context_->ring().solvers();
    questions_.resize(solvers.jobs());
    expect_answers(count);
    solvers.answer_each(
        count, questions_,
        [&](std::size_t i, solvers::SolverJobs::Question& question) {
            const shaders::PairRowData& pair = pair_of(i);
            question.query = query_on_cpu(pair, with_records);
            question.shapes = {polygon_of(instances_[pair.a].instance.shape),
                               polygon_of(instances_[pair.b].instance.shape)};
        },
        [&](std::uint32_t /*job*/, std::size_t i, const AnyResult& result) { take(i, result); });
}

}  // namespace nearfield
