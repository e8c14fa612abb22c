#include <tools/io/length_unit.hpp>

#include <array>
#include <cstddef>

namespace nearfield::tools {

double pixels_per(LengthUnit unit) {
    switch (unit) {
        case LengthUnit::mm:
            return 96.0 / 25.4;
        case LengthUnit::cm:
            return 96.0 / 2.54;
        case LengthUnit::inch:
            return 96.0;
        case LengthUnit::pt:
            return 96.0 / 72.0;
        case LengthUnit::pc:
            return 16.0;
        case LengthUnit::user:
        case LengthUnit::px:
            break;
    }
    return 1.0;
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
