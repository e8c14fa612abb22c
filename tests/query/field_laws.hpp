#pragma once

#include <tests/query/check.hpp>
#include <tests/query/query_test.hpp>
#include <tests/support/fake_loader.hpp>

#include <span>
#include <string>

namespace nearfield::test {

/// One shape known to a context for as long as this lives, and the oracle's view of it.
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
    /// Everything needed to make it again.
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

/// The laws of everything but the values of a distance field.
class FieldLaws : public QueryTest {
protected:
    /// Features and analytic gradients at cells: nearest up to the stated margin, of unit length
    /// and right where they are the only answer, flagged where they are not.
    static void check_cells(const oracle::ShapeOracle& b, const DistanceFieldQuery& query,
                            const DistanceFieldResult& result, std::size_t most_cells = 3000);
    /// Gradients by central differences against those of the exact signed distance.
    static void check_differences(const oracle::ShapeOracle& b, const DistanceFieldResult& result,
                                  std::size_t most_cells = 3000);
    /// Blended gradients against differences of the same values.
    static void check_blended(const DistanceFieldResult& differences,
                              const DistanceFieldResult& blended);
    /// What is reconstructed at points.
    static void check_points(const oracle::ShapeOracle& b, const DistanceFieldQuery& query,
                             const DistanceFieldResult& result);
    /// The largest difference of two fields of gradients in any component.
    [[nodiscard]] static double most_apart(const DistanceFieldResult& one,
                                           const DistanceFieldResult& other);
};

}  // namespace nearfield::test
