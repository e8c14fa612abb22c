#pragma once

#include <tests/support/buffer_accesses.hpp>

#include <span>
#include <string>
#include <vector>

namespace nearfield::test_support {

/// What a barrier orders: the accesses to one buffer, or to all.
struct Dependency {
    VkBuffer buffer = VK_NULL_HANDLE;  // null: a memory barrier
    VkAccessFlags source = 0;
    VkAccessFlags destination = 0;

    friend bool operator==(const Dependency&, const Dependency&) = default;
};

/// A line for each access that the recorded barriers do not order after an earlier one, or that
/// need not see what it wrote; and for each result that does not reach the host or the host's
/// shaders. Validation layers do not see such hazards between dispatches. Images are left to them.
/// What the batch before did is not seen, except that the host's shaders have read the results; but
/// commands that may be submitted again follow themselves.
/// `left_out`: no barrier has this dependency, of whatever range; null: all have theirs.
///
/// Dispatches of one pipeline with no barrier between them are taken for one: they write different
/// elements, or the same ones by atomic operations.
[[nodiscard]] std::vector<std::string> find_hazards(std::span<const Recording> recordings,
                                                    const Dependency* left_out = nullptr);

/// The different dependencies of all barriers, except those of attachments.
[[nodiscard]] std::vector<Dependency> dependencies(std::span<const Recording> recordings);

}  // namespace nearfield::test_support
