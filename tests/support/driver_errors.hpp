#pragma once

#include <vulkan/vulkan_core.h>

#include <string_view>
#include <vector>

namespace nearfield::test_support {

/// The errors that the Vulkan 1.1 specification allows an entry point to return; empty for one that
/// has no row in the table (entry points that return nothing need none).
[[nodiscard]] const std::vector<VkResult>& errors_of(std::string_view call);

/// An error as the specification spells it.
[[nodiscard]] const char* name_of(VkResult error);

}  // namespace nearfield::test_support
