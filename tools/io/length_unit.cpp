#include <tools/io/input_error.hpp>
#include <tools/io/length_unit.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

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

double pixels_of_insunits(double code) {
    constexpr double inch = 96.0;
    constexpr double metre = 1000.0 / 25.4 * inch;
    constexpr std::array<double, 15> lengths{
        0.0,          inch,          12.0 * inch,  63360.0 * inch, 1e-3 * metre,
        1e-2 * metre, metre,         1e3 * metre,  1e-6 * inch,    1e-3 * inch,
        36.0 * inch,  1e-10 * metre, 1e-9 * metre, 1e-6 * metre,   1e-1 * metre};
    const bool is_known = code > 0.0 && code < static_cast<double>(lengths.size());
    return is_known ? lengths[static_cast<std::size_t>(code)] : 0.0;
}

}  // namespace nearfield::tools
