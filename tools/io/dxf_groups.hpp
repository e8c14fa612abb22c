#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nearfield::tools {

/// A group of a DXF file: two lines, of which the first one says what the second one is.
struct DxfGroup {
    int code = 0;
    std::string_view value;  ///< without spaces around it; borrowed from the text
    std::size_t offset = 0;  ///< of the value in the text
};

/// The groups of a DXF file in text form, one after the other.
class DxfGroups {
public:
    /// Both are borrowed.
    DxfGroups(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    /// Reads the next group; false at the end of the text. Throws InputError for a code that is no
    /// whole number, or that has no value.
    bool next(DxfGroup& group);

    /// Throws InputError for a place in the text.
    [[noreturn]] void fail(std::size_t offset, const std::string& reason) const;

private:
    [[nodiscard]] std::string_view take_line();

    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0;
};

/// An entity of a drawing, or a marker of its structure (SECTION, BLOCK, EOF): what a group with
/// the code 0 names, and the groups up to the next one.
struct DxfEntity {
    std::string_view type;
    std::size_t offset = 0;  ///< of the type
    std::vector<DxfGroup> groups = {};

    /// The first group with a code; nothing if there is none.
    [[nodiscard]] const DxfGroup* find(int code) const;
    /// The value of the first group with a code; empty if there is none.
    [[nodiscard]] std::string_view text(int code) const;
    /// The same as a name, in which small letters are as capitals.
    [[nodiscard]] std::string name(int code) const;
};

/// Whether entities of a type are no outlines, but say something about them.
[[nodiscard]] bool is_dxf_annotation(std::string_view type);

/// All entities and markers of a DXF file in text form.
[[nodiscard]] std::vector<DxfEntity> read_dxf_entities(DxfGroups& groups);

}  // namespace nearfield::tools
