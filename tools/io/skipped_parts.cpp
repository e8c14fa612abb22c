#include <tools/io/skipped_parts.hpp>

#include <algorithm>

namespace nearfield::tools {

void SkippedParts::add(std::string_view kind, std::size_t count) {
    const auto found = std::find_if(counts_.begin(), counts_.end(),
                                    [kind](const auto& known) { return known.first == kind; });
    if (found == counts_.end()) {
        counts_.emplace_back(kind, count);
    } else {
        found->second += count;
    }
}

std::string SkippedParts::text() const {
    std::string text;
    for (const auto& [kind, count] : counts_) {
        text += (text.empty() ? "" : ", ") + kind + " (" + std::to_string(count) + ")";
    }
    return text;
}

std::string SkippedParts::no_polygon_text() const {
    return "holds no polygon" + (empty() ? std::string() : ", only " + text());
}

}  // namespace nearfield::tools
