#pragma once

#include <nearfield/shape.hpp>

#include <tools/io/dxf_groups.hpp>

#include <string>
#include <vector>

namespace nearfield::tools {

/// The numbers of a DXF file's entities. All throw InputError, with the place in the file, for what
/// is no finite number of at most 1e12.
class DxfValues {
public:
    DxfValues(std::string_view text, const std::string& file) : groups_(text, file) {}

    [[nodiscard]] DxfGroups& groups() { return groups_; }

    /// Throws InputError for a place in the text, or an entity.
    [[noreturn]] void fail(std::size_t offset, const std::string& reason) const {
        groups_.fail(offset, reason);
    }
    [[noreturn]] void fail(const DxfEntity& entity, const std::string& reason) const;

    [[nodiscard]] double number(const DxfGroup& group) const;
    /// The number of the first group with a code, which there must be, or else `usual`.
    [[nodiscard]] double number(const DxfEntity& entity, int code) const;
    [[nodiscard]] double number(const DxfEntity& entity, int code, double usual) const;
    /// Those of all groups with a code.
    [[nodiscard]] std::vector<double> numbers(const DxfEntity& entity, int code) const;
    /// Whether the first group with a code has a bit.
    [[nodiscard]] bool has_flag(const DxfEntity& entity, int code, int flag) const;
    /// Of the groups `code` and `code` + 10.
    [[nodiscard]] Vector2 point(const DxfEntity& entity, int code) const;

    /// 1, or -1 for an entity that is seen from behind, whose x points the other way.
    [[nodiscard]] double direction(const DxfEntity& entity) const;
    [[nodiscard]] double radius(const DxfEntity& entity) const;

private:
    DxfGroups groups_;
};

}  // namespace nearfield::tools
