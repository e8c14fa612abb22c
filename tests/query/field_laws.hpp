#pragma once

#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/fake_loader.hpp>

#include <span>
#include <string>

namespace nearfield::test {

/// A shape in a context for the lifetime of this object, and its oracle.
class PlacedShape {
public:
    PlacedShape(Context& context, const Rings& rings, const Pose& pose);
    ~PlacedShape();
    PlacedShape(const PlacedShape&) = delete;
    PlacedShape& operator=(const PlacedShape&) = delete;

    [[nodiscard]] Instance instance() const { return {handle_, pose_}; }
    [[nodiscard]] const oracle::ShapeOracle& oracle() const { return oracle_; }

private:
    Context* context_;
    Pose pose_;
    oracle::ShapeOracle oracle_;
    ShapeHandle handle_;
};

/// A field of a random shape over a rectangle near it.
class AnyField {
public:
    AnyField(Context& context, Random& random);

    [[nodiscard]] DistanceFieldQuery query() const;
    [[nodiscard]] const oracle::ShapeOracle& oracle() const { return shape_.oracle(); }
    [[nodiscard]] const Rectangle& rectangle() const { return rectangle_; }
    /// Everything needed to reproduce it.
    [[nodiscard]] std::string text() const;

private:
    Pair pair_;
    PlacedShape shape_;
    Rectangle rectangle_;
    double tolerance_ = 0.0;
};

[[nodiscard]] double distance_to_feature(const oracle::ShapeOracle& b, Feature feature,
                                         const Vector2& point);
[[nodiscard]] Vector2 turned(const Vector2& vector, double angle);
[[nodiscard]] Rectangle box_around(std::span<const Vector2> points);
[[nodiscard]] Vector2 centre_of(const DistanceFieldResult& result, std::size_t cell);

/// Checks everything but the values of a distance field.
class FieldLaws : public QueryTest {
protected:
    /// Features and analytic gradients at cells: features must be nearest up to the stated margin;
    /// gradients must have unit length and be correct if they are unique, and flagged otherwise.
    static void check_cells(const oracle::ShapeOracle& b, const DistanceFieldQuery& query,
                            const DistanceFieldResult& result, std::size_t max_cells = 3000);
    /// Compares gradients by central differences with those of the exact signed distance.
    static void check_differences(const oracle::ShapeOracle& b, const DistanceFieldResult& result,
                                  std::size_t max_cells = 3000);
    /// Compares blended gradients with differences of the same values.
    static void check_blended(const DistanceFieldResult& differences,
                              const DistanceFieldResult& blended);
    /// Checks reconstructed values at points.
    static void check_points(const oracle::ShapeOracle& b, const DistanceFieldQuery& query,
                             const DistanceFieldResult& result);
    /// The largest component-wise difference of two gradient fields.
    [[nodiscard]] static double max_apart(const DistanceFieldResult& one,
                                          const DistanceFieldResult& other);
};

}  // namespace nearfield::test
