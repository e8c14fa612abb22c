#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nearfield::tools {

/// What a file holds besides polygons (points, lines, empty parts), counted by kind: a shape is
/// made without it, and whoever reads the file is told.
class SkippedParts {
public:
    void add(std::string_view kind, std::size_t count = 1);
    [[nodiscard]] bool empty() const noexcept { return counts_.empty(); }
    /// "Point (2), empty part (1)", in the order in which the kinds were first met.
    [[nodiscard]] std::string text() const;
    /// Why a file without a single polygon is refused.
    [[nodiscard]] std::string no_polygon_text() const;

private:
    std::vector<std::pair<std::string, std::size_t>> counts_;
};

/// Collections nest no deeper: untrusted input must not exhaust the stack.
inline constexpr int deepest_collection = 64;

/// The kind under which empty geometries and rings are counted.
inline constexpr std::string_view empty_part = "empty part";

}  // namespace nearfield::tools
