#pragma once

#include <engine/solvers/workspace.hpp>

#include <cstdint>
#include <optional>

namespace nearfield::solvers {

/// A workspace with a memory limit of its own, by default that of a context.
struct TestWorkspace : Workspace {
    explicit TestWorkspace(std::uint64_t bytes = std::uint64_t{1} << 30U) {
        limits.memory = bytes;
        limits = queries::with_affordable_atlas(limits);
        budget.emplace(limits);
        memory = &*budget;
    }

    std::optional<queries::MemoryBudget> budget;
};

}  // namespace nearfield::solvers
