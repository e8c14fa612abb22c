#pragma once

#include <nearfield/context.hpp>

#include <optional>
#include <string>

namespace nearfield::tools {

/// Measures Tables 2 and 3 of the paper, and how times grow with the number of lines and with the
/// tolerance, for each technique, and reports them. `json`: a path or "-"; `curves`: a PNG file for
/// the growth. Throws InputError or LibraryError.
void run_paper_tables(const Settings& settings, const std::optional<std::string>& json,
                      const std::optional<std::string>& curves);

}  // namespace nearfield::tools
