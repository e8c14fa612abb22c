#include <engine/outline/exact_kernels.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

// Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates,
// Discrete & Computational Geometry 18(3), 1997. A sum of doubles that do not overlap holds a
// number exactly; it is computed only where rounding could change the sign.
namespace nearfield::outline::exact {
namespace {

constexpr double half_epsilon = 0.5 * std::numeric_limits<double>::epsilon();

int sign(double value) {
    return (value > 0.0 ? 1 : 0) - (value < 0.0 ? 1 : 0);
}

/// The error of a sum: first + second = sum + error, exactly.
double error_of_sum(double first, double second, double sum) {
    const double virtual_second = sum - first;
    const double virtual_first = sum - virtual_second;
    return (first - virtual_first) + (second - virtual_second);
}

/// An exact sum of doubles, none of which overlaps another, in order of magnitude.
class Expansion {
public:
    void add(double value) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const double sum = value + terms_[i];
            const double error = error_of_sum(value, terms_[i], sum);
            if (error != 0.0) {
                terms_[kept++] = error;
            }
            value = sum;
        }
        if (value != 0.0) {
            terms_[kept++] = value;
        }
        size_ = kept;
    }

    void add_product(double first, double second) {
        const double product = first * second;
        add(std::fma(first, second, -product));
        add(product);
    }

    /// Adds another one times a factor.
    void add_product(const Expansion& other, double factor) {
        for (std::size_t i = 0; i < other.size_; ++i) {
            add_product(other.terms_[i], factor);
        }
    }

    [[nodiscard]] int sign_of_sum() const { return size_ == 0 ? 0 : sign(terms_[size_ - 1]); }

private:
    std::array<double, 128> terms_;  // 96 are needed for a crossing
    std::size_t size_ = 0;
};

/// cross(b - a, c - a)
Expansion exact_cross(const Vector2& a, const Vector2& b, const Vector2& c) {
    Expansion sum;
    sum.add_product(b.x, c.y);
    sum.add_product(-b.x, a.y);
    sum.add_product(-a.x, c.y);
    sum.add_product(-b.y, c.x);
    sum.add_product(b.y, a.x);
    sum.add_product(a.y, c.x);
    return sum;
}

/// A number and a bound on its error.
struct Rounded {
    double value;
    double error;
};

Rounded rounded_cross(const Vector2& a, const Vector2& b, const Vector2& c) {
    const double left = (b.x - a.x) * (c.y - a.y);
    const double right = (b.y - a.y) * (c.x - a.x);
    return {left - right,
            (3.0 + 16.0 * half_epsilon) * half_epsilon * (std::abs(left) + std::abs(right))};
}

/// True if a difference has no rounding.
bool is_exact_difference(double first, double second) {
    return error_of_sum(first, -second, first - second) == 0.0;
}

/// The sign of a product less another one. Rounding keeps the order of different products.
int compare_products(double a, double b, double c, double d) {
    const double first = a * b;
    const double second = c * d;
    if (first != second) {
        return first > second ? 1 : -1;
    }
    return sign(std::fma(a, b, -first) - std::fma(c, d, -second));
}

double coordinate(const Vector2& point, Axis axis) {
    return axis == Axis::x ? point.x : point.y;
}

}  // namespace

int orientation(const Vector2& a, const Vector2& b, const Vector2& c) {
    const Rounded cross = rounded_cross(a, b, c);
    if (std::abs(cross.value) > cross.error) {
        return sign(cross.value);
    }
    if (is_exact_difference(b.x, a.x) && is_exact_difference(c.y, a.y) &&
        is_exact_difference(b.y, a.y) && is_exact_difference(c.x, a.x)) {
        return compare_products(b.x - a.x, c.y - a.y, b.y - a.y, c.x - a.x);
    }
    return exact_cross(a, b, c).sign_of_sum();
}

int compare_coordinate(const Crossing& crossing, Axis axis, double value) {
    const auto& [a, b, c, d] = crossing;
    const double at_a = coordinate(a, axis);
    const double at_b = coordinate(b, axis);
    const double at_c = coordinate(c, axis);
    const double at_d = coordinate(d, axis);
    for (const auto& [first, second] : {std::array{at_a, at_b}, std::array{at_c, at_d}}) {
        if (first == second || (first >= value && second >= value) ||
            (first <= value && second <= value)) {
            return first == value ? sign(second - value) : sign(first - value);
        }
    }
    // The point is the mean of a and b, each with the other one's distance from the line cd as
    // weight. The weights have different signs.
    const Rounded of_a = rounded_cross(c, d, b);
    const Rounded of_b = rounded_cross(c, d, a);
    const double from_a = at_a - value;
    const double from_b = at_b - value;
    const double sum = from_b * of_b.value - from_a * of_a.value;
    const double error =
        std::abs(from_b) * of_b.error + std::abs(from_a) * of_a.error +
        4.0 * half_epsilon * (std::abs(from_b * of_b.value) + std::abs(from_a * of_a.value));
    const int side_of_a = orientation(c, d, a);
    if (std::abs(sum) > 1.01 * error) {
        return side_of_a * sign(sum);
    }
    const Expansion weight_of_a = exact_cross(c, d, b);
    const Expansion weight_of_b = exact_cross(c, d, a);
    Expansion exact_sum;
    exact_sum.add_product(weight_of_b, at_b);
    exact_sum.add_product(weight_of_b, -value);
    exact_sum.add_product(weight_of_a, -at_a);
    exact_sum.add_product(weight_of_a, value);
    return side_of_a * exact_sum.sign_of_sum();
}

double approximate_coordinate(const Crossing& crossing, Axis axis) {
    const auto& [a, b, c, d] = crossing;
    const double of_a = std::abs(rounded_cross(c, d, b).value);
    const double of_b = std::abs(rounded_cross(c, d, a).value);
    const double at_a = coordinate(a, axis);
    const double part = of_a + of_b > 0.0 ? of_b / (of_a + of_b) : 0.5;
    return at_a + part * (coordinate(b, axis) - at_a);
}

}  // namespace nearfield::outline::exact
