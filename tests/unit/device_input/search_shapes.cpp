#include <engine/device_input/search_shapes.hpp>

#include <gtest/gtest.h>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace nearfield::device_input {
namespace {

/// A copy of all units, which is brought up to date from time to time.
class Copy {
public:
    void update(const SearchShapes& shapes) {
        units_.resize(shapes.units().size());
        shapes.copy_changes(revision_, std::as_writable_bytes(std::span(units_)));
        revision_ = shapes.revision();
    }
    /// Writes something else everywhere. What is copied after that is known by it.
    void spoil() { std::fill(units_.begin(), units_.end(), SearchUnit{spoilt, spoilt, spoilt}); }
    [[nodiscard]] std::size_t count_copied() const {
        return units_.size() - static_cast<std::size_t>(std::count_if(
                                   units_.begin(), units_.end(), [](const SearchUnit& unit) {
                                       return unit[0] == spoilt && unit[2] == spoilt;
                                   }));
    }
    [[nodiscard]] bool is_of(const SearchShapes& shapes) const {
        return std::equal(units_.begin(), units_.end(), shapes.units().begin(),
                          shapes.units().end());
    }

private:
    static constexpr std::uint32_t spoilt = 0xdead5eed;

    std::vector<SearchUnit> units_;
    std::uint64_t revision_ = 0;
};

TEST(SearchShapes, OneThatDeformsIsCopiedAlone) {
    test::Random random(2);
    std::vector<geometry::Polygon> polygons(100);
    SearchShapes shapes;
    shapes.begin_batch();
    for (geometry::Polygon& polygon : polygons) {
        ASSERT_TRUE(polygon.assign(test::star(random, 40, 0.5)).ok());
        static_cast<void>(shapes.place(polygon));
    }
    Copy copy;
    copy.update(shapes);
    EXPECT_TRUE(copy.is_of(shapes));
    const std::size_t size_of_one = shapes.units().size() / polygons.size();
    for (int frame = 0; frame < 3; ++frame) {
        ASSERT_TRUE(polygons[70].assign(test::star(random, 40, 0.5)).ok());
        static_cast<void>(shapes.place(polygons[70]));
        copy.spoil();
        copy.update(shapes);
        EXPECT_GT(copy.count_copied(), 0U);
        EXPECT_LE(copy.count_copied(), 2 * size_of_one);
    }
}

TEST(SearchShapes, CopiesHaveAllUnitsHoweverRarelyTheyAreBroughtUpToDate) {
    test::Random random(3);
    std::vector<geometry::Polygon> polygons(60);
    SearchShapes shapes;
    Copy always;
    Copy rarely;
    for (int frame = 0; frame < 300; ++frame) {
        shapes.begin_batch();
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            if (frame == 0 || random.whole(0, 9) == 0) {
                ASSERT_TRUE(polygons[i].assign(test::star(random, random.whole(3, 90), 0.5)).ok());
            }
            static_cast<void>(shapes.place(polygons[i]));
        }
        always.update(shapes);
        ASSERT_TRUE(always.is_of(shapes));
        if (random.whole(0, 19) == 0) {
            rarely.update(shapes);
            ASSERT_TRUE(rarely.is_of(shapes));
        }
    }
}

}  // namespace
}  // namespace nearfield::device_input
