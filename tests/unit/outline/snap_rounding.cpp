#include <engine/outline/snap_rounding.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace nearfield::outline {
namespace {

/// A fraction with a denominator above 0.
struct Fraction {
    std::int64_t over;
    std::int64_t under;
};

int compare(const Fraction& a, const Fraction& b) {
    const std::int64_t difference = a.over * b.under - b.over * a.under;
    return (difference > 0 ? 1 : 0) - (difference < 0 ? 1 : 0);
}

/// The parameters at which a segment is in a cell.
class Stretch {
public:
    /// Keeps where low <= from + t * step < high.
    void keep(std::int64_t from, std::int64_t step, std::int64_t low, std::int64_t high) {
        if (step == 0) {
            empty_ = empty_ || from < low || from >= high;
        } else if (step > 0) {
            begin({low - from, step}, false);
            end({high - from, step}, true);
        } else {
            begin({from - high, -step}, true);
            end({from - low, -step}, false);
        }
    }
    [[nodiscard]] bool empty() const {
        const int order = compare(begin_, end_);
        return empty_ || order > 0 || (order == 0 && (begin_open_ || end_open_));
    }

private:
    void begin(const Fraction& at, bool open) {
        const int order = compare(at, begin_);
        begin_open_ = order > 0 ? open : begin_open_ || (order == 0 && open);
        begin_ = order > 0 ? at : begin_;
    }
    void end(const Fraction& at, bool open) {
        const int order = compare(at, end_);
        end_open_ = order < 0 ? open : end_open_ || (order == 0 && open);
        end_ = order < 0 ? at : end_;
    }

    Fraction begin_{0, 1};
    Fraction end_{1, 1};
    bool begin_open_ = false;
    bool end_open_ = false;
    bool empty_ = false;
};

/// All segments between points of a fine grid against cells around the origin.
TEST(SnapRounding, EdgesPassHalfOpenCells) {
    constexpr int fine = 4;  // parts of a cell
    constexpr int reach = 9;
    int passed = 0;
    for (int i = 0; i < 19 * 19 * 19 * 19; ++i) {
        const int ax = i % 19 - reach;
        const int ay = i / 19 % 19 - reach;
        const int bx = i / (19 * 19) % 19 - reach;
        const int by = i / (19 * 19 * 19) - reach;
        if (ax == bx && ay == by) {
            continue;
        }
        const Cell cell{i % 3 - 1, i % 5 % 3 - 1};
        Stretch stretch;
        stretch.keep(ax, bx - ax, fine * cell.x - fine / 2, fine * cell.x + fine / 2);
        stretch.keep(ay, by - ay, fine * cell.y - fine / 2, fine * cell.y + fine / 2);
        ASSERT_EQ(passes({0.25 * ax, 0.25 * ay}, {0.25 * bx, 0.25 * by}, cell), !stretch.empty())
            << ax << ' ' << ay << ' ' << bx << ' ' << by << " in " << cell.x << ' ' << cell.y;
        passed += stretch.empty() ? 0 : 1;
    }
    EXPECT_GT(passed, 10'000);
}

TEST(SnapRounding, CellsHoldTheirLowerAndLeftSides) {
    EXPECT_EQ(cell_of({0.5, -0.5}), (Cell{1, 0}));
    EXPECT_EQ(cell_of({-0.5, 0.49999999999999994}), (Cell{0, 0}));
    EXPECT_EQ(cell_of({-1e-300, -1.5}), (Cell{0, -1}));
    EXPECT_EQ(cell_of({0x1p49 + 0.5, -0x1p49 - 0.5}), (Cell{(1LL << 49) + 1, -(1LL << 49)}));
}

TEST(SnapRounding, ACrossingBetweenCellsIsInTheUpperRightOne) {
    // Two triangles without area, whose long sides cross where four cells meet.
    const std::vector<Ring> rings{{{-2, -2}, {3, 3}, {-2, -2}}, {{-2, 3}, {3, -2}, {-2, 3}}};
    EXPECT_EQ(snap_round(rings, 100).cells,
              (std::vector<Cell>{{-2, -2}, {-2, 3}, {1, 1}, {3, -2}, {3, 3}}));
}

}  // namespace
}  // namespace nearfield::outline
