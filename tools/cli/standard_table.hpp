#pragma once

#include <nearfield/context.hpp>

#include <optional>
#include <string>

namespace nearfield::tools {

/// Measures the rows of the standard table whose names contain `filter`, with each technique, and
/// reports them. `json`: a path or "-". Throws InputError if no row matches, or LibraryError.
void run_standard_table(const std::string& filter, const Settings& settings,
                        const std::optional<std::string>& json);

}  // namespace nearfield::tools
