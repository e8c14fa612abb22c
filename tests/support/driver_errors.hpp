#pragma once

#include <vulkan/vulkan_core.h>

#include <string_view>
#include <vector>

namespace nearfield::test_support {

/// The errors that the Vulkan 1.1 specification allows an entry point to return; empty if the table
/// has no row for it (entry points without a result need none).
[[nodiscard]] const std::vector<VkResult>& errors_of(std::string_view call);

/// The name of an error in the specification.
[[nodiscard]] const char* name_of(VkResult error);

}  // namespace nearfield::test_support
