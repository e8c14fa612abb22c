#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nearfield::tools {

/// The text of an XML file in which references to the entities that its document type declares
/// (<!ENTITY name "text">) are replaced by their texts. References to characters, and to what is
/// not declared there, stay.
class ExpandedXml {
public:
    /// Throws InputError where the texts refer to each other in a circle, or are too long together.
    ExpandedXml(std::string_view text, const std::string& file);

    /// The text; it leaves this object, which still knows its places.
    [[nodiscard]] std::string take_text() noexcept { return std::move(text_); }
    /// The offset in the file of a byte of the text: of the reference, where it comes from one.
    [[nodiscard]] std::size_t offset_in_file(std::size_t offset) const;

private:
    std::string text_;
    /// Offsets in the text and in the file of what is copied and of what a reference stands for, by
    /// turns; the former comes first.
    std::vector<std::pair<std::size_t, std::size_t>> copies_;
};

}  // namespace nearfield::tools
