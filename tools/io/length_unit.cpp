#include <tools/io/input_error.hpp>
#include <tools/io/length_unit.hpp>

#include <algorithm>
#include <array>

namespace nearfield::tools {
namespace {

struct NamedUnit {
    std::string_view name;
    double pixels;
    LengthUnit unit;
};

constexpr std::array<NamedUnit, 7> units{{
    {"user", 1.0, LengthUnit::user},
    {"px", 1.0, LengthUnit::px},
    {"mm", 96.0 / 25.4, LengthUnit::mm},
    {"cm", 96.0 / 2.54, LengthUnit::cm},
    {"in", 96.0, LengthUnit::inch},
    {"pt", 96.0 / 72.0, LengthUnit::pt},
    {"pc", 16.0, LengthUnit::pc},
}};

}  // namespace

std::optional<LengthUnit> find_length_unit(std::string_view name) {
    const auto found = std::find_if(units.begin(), units.end(),
                                    [&](const NamedUnit& unit) { return unit.name == name; });
    return found == units.end() ? std::nullopt : std::optional(found->unit);
}

LengthUnit parse_length_unit(const std::string& name, const std::string& what) {
    const std::optional<LengthUnit> unit = find_length_unit(name);
    if (!unit) {
        throw InputError(what + ": \"" + name + "\" is none of user, px, mm, cm, in, pt, pc");
    }
    return *unit;
}

double pixels_per(LengthUnit unit) {
    return std::find_if(units.begin(), units.end(),
                        [&](const NamedUnit& named) { return named.unit == unit; })
        ->pixels;
}

}  // namespace nearfield::tools
