#include <tools/io/dxf_values.hpp>
#include <tools/io/values.hpp>

#include <cmath>

namespace nearfield::tools {

void DxfValues::fail(const DxfEntity& entity, const std::string& reason) const {
    groups_.fail(entity.offset, std::string(entity.type) + ": " + reason);
}

double DxfValues::number(const DxfGroup& group) const {
    double number = 0.0;
    if (!parse_finite(group.value, number)) {
        groups_.fail(group.offset, "group " + std::to_string(group.code) + ": \"" +
                                       std::string(group.value.substr(0, 40)) +
                                       "\" is not a finite number");
    }
    if (std::abs(number) > largest_coordinate) {
        groups_.fail(group.offset, "group " + std::to_string(group.code) +
                                       ": numbers must be at most 1e12 in magnitude");
    }
    return number;
}

double DxfValues::number(const DxfEntity& entity, int code) const {
    const DxfGroup* const group = entity.find(code);
    if (group == nullptr) {
        fail(entity, "lacks group " + std::to_string(code));
    }
    return number(*group);
}

double DxfValues::number(const DxfEntity& entity, int code, double usual) const {
    const DxfGroup* const group = entity.find(code);
    return group == nullptr ? usual : number(*group);
}

std::vector<double> DxfValues::numbers(const DxfEntity& entity, int code) const {
    std::vector<double> numbers;
    for (const DxfGroup& group : entity.groups) {
        if (group.code == code) {
            numbers.push_back(number(group));
        }
    }
    return numbers;
}

bool DxfValues::has_flag(const DxfEntity& entity, int code, int flag) const {
    const double flags = number(entity, code, 0.0);
    return std::abs(flags) <= 0x1p30 && (static_cast<int>(flags) & flag) != 0;
}

Vector2 DxfValues::point(const DxfEntity& entity, int code) const {
    return {number(entity, code), number(entity, code + 10)};
}

double DxfValues::direction(const DxfEntity& entity) const {
    constexpr double rounding = 1e-9;
    const double z = number(entity, 230, 1.0);
    if (std::abs(number(entity, 210, 0.0)) > rounding ||
        std::abs(number(entity, 220, 0.0)) > rounding || std::abs(std::abs(z) - 1.0) > rounding) {
        fail(entity, "does not lie in the plane of x and y");
    }
    return z < 0.0 ? -1.0 : 1.0;
}

double DxfValues::radius(const DxfEntity& entity) const {
    const double radius = number(entity, 40);
    if (!(radius >= 0.0)) {
        fail(entity, "its radius is below 0");
    }
    return radius;
}

}  // namespace nearfield::tools
