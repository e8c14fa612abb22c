#include <tools/io/characters.hpp>
#include <tools/io/dxf_groups.hpp>
#include <tools/io/input_error.hpp>
#include <tools/io/text_file.hpp>
#include <tools/io/values.hpp>

#include <algorithm>
#include <charconv>
#include <iterator>

namespace nearfield::tools {

void DxfGroups::fail(std::size_t offset, const std::string& reason) const {
    throw InputError(text_position(file_, text_, offset) + ": " + reason);
}

std::string_view DxfGroups::take_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    return without_spaces(line);
}

bool DxfGroups::next(DxfGroup& group) {
    const std::size_t start = at_;
    const std::string_view code = take_line();
    constexpr std::string_view end_mark = "\x1A";  // of DOS
    if (code == end_mark ||
        (code.empty() && text_.find_first_not_of(" \t\r\n", start) == std::string_view::npos)) {
        return false;
    }
    const auto [rest, error] = std::from_chars(code.data(), code.data() + code.size(), group.code);
    if (error != std::errc{} || rest != code.data() + code.size()) {
        fail(start, "expected the code of a group, a whole number; found \"" +
                        std::string(code.substr(0, 40)) + "\"");
    }
    if (at_ == text_.size()) {
        fail(at_,
             "the file ends where the value of group " + std::to_string(group.code) + " should be");
    }
    group.offset = at_;
    group.value = take_line();
    return true;
}

const DxfGroup* DxfEntity::find(int code) const {
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [code](const DxfGroup& group) { return group.code == code; });
    return found == groups.end() ? nullptr : &*found;
}

std::string_view DxfEntity::text(int code) const {
    const DxfGroup* const group = find(code);
    return group == nullptr ? std::string_view() : group->value;
}

std::string DxfEntity::name(int code) const {
    std::string name(text(code));
    std::transform(name.begin(), name.end(), name.begin(), to_upper);
    return name;
}

bool is_dxf_annotation(std::string_view type) {
    constexpr std::string_view types[] = {
        "TEXT",   "MTEXT",  "DIMENSION", "LEADER", "MULTILEADER", "TOLERANCE", "POINT",  "HATCH",
        "ATTDEF", "ATTRIB", "XLINE",     "RAY",    "VIEWPORT",    "IMAGE",     "SEQEND", "WIPEOUT"};
    return std::find(std::begin(types), std::end(types), type) != std::end(types);
}

std::vector<DxfEntity> read_dxf_entities(DxfGroups& groups) {
    constexpr int comment = 999;
    std::vector<DxfEntity> entities;
    for (DxfGroup group; groups.next(group);) {
        if (group.code == 0) {
            entities.push_back({.type = group.value, .offset = group.offset});
        } else if (group.code == comment) {
            continue;
        } else if (entities.empty()) {
            groups.fail(group.offset, "a DXF file begins with a group of code 0");
        } else {
            entities.back().groups.push_back(group);
        }
    }
    return entities;
}

}  // namespace nearfield::tools
