#pragma once

#include <engine/base/jobs.hpp>
#include <engine/base/stopwatch.hpp>
#include <engine/gpu/device.hpp>
#include <engine/graph/compute_layout.hpp>
#include <nearfield/context.hpp>
#include <passes/export_pairs.hpp>
#include <passes/exports.hpp>
#include <passes/fields.hpp>
#include <passes/masks.hpp>
#include <passes/pair_poses.hpp>
#include <passes/pair_search.hpp>
#include <passes/world_queries.hpp>

#include <array>
#include <atomic>
#include <functional>
#include <optional>

namespace nearfield::render {

/// The passes of resident outputs, with their pipelines.
struct ExportPipelines {
    ExportPipelines(const gpu::Device& device, const graph::ComputeLayout& layout);

    passes::CopyBack copy_back;
    passes::CopyHeader copy_header;
    passes::ExportField field;
    passes::ExportRecords records;
    passes::ExportSamples samples;
};

/// All passes with their pipelines. A function makes what it returns, unless that has been made,
/// and throws StatusException as the driver fails.
class PipelineSet {
public:
    PipelineSet(const gpu::Device& device, const graph::ComputeLayout& layout)
        : device_(&device), layout_(&layout) {}
    /// Makes all of these techniques, divided among the jobs. `others`: to be made beside them.
    void make(const DeviceTechniques& techniques, Jobs& jobs,
              const std::function<void()>& others) const;

    [[nodiscard]] const ExportPipelines& exports() const { return made(exports_); }
    /// Compute, as are those that follow.
    [[nodiscard]] const passes::Masks& masks() const { return made(masks_); }
    [[nodiscard]] const passes::Fields& fields() const { return made(fields_); }
    [[nodiscard]] const passes::PairPoses& pair_poses() const { return made(pair_poses_); }
    [[nodiscard]] const passes::PairSearch& pair_search(
        const device_input::PairSearchKind& kind) const;
    [[nodiscard]] const passes::ExportPairs& export_pairs() const { return made(export_pairs_); }
    [[nodiscard]] const passes::WorldQueries& world_queries(
        device_input::WorldQuestion question) const;

    /// The time that making them has taken.
    [[nodiscard]] double milliseconds() const { return milliseconds_; }

private:
    template <class Passes, class... Arguments>
    const Passes& made(std::optional<Passes>& passes, Arguments... arguments) const {
        if (!passes) {
            const Stopwatch start;
            passes.emplace(*device_, *layout_, arguments...);
            milliseconds_ += start.milliseconds();
        }
        return *passes;
    }

    [[nodiscard]] const passes::InstanceShaders& instance_shaders() const {
        return made(instance_shaders_);
    }
    [[nodiscard]] const passes::FoundPairShaders& found_pair_shaders() const {
        return made(found_pair_shaders_, &instance_shaders());
    }

    const gpu::Device* device_;
    const graph::ComputeLayout* layout_;
    mutable std::atomic<double> milliseconds_ = 0.0;
    mutable std::optional<ExportPipelines> exports_;
    mutable std::optional<passes::Masks> masks_;
    mutable std::optional<passes::Fields> fields_;
    mutable std::optional<passes::PairPoses> pair_poses_;
    mutable std::optional<passes::ExportPairs> export_pairs_;
    mutable std::optional<passes::InstanceShaders> instance_shaders_;
    mutable std::optional<passes::SearchShaders> search_shaders_;
    mutable std::optional<passes::FoundPairShaders> found_pair_shaders_;
    mutable std::array<std::optional<passes::PairSearch>, device_input::pair_search_kinds.size()>
        pair_searches_;
    mutable std::array<std::optional<passes::WorldQueries>, device_input::world_questions>
        world_queries_;
};

}  // namespace nearfield::render
