#include "containment_queries.hpp"

namespace nearfield::test {
namespace {

constexpr std::uint64_t containment_lattice_seed = 2718;

/// Unions of the cells of a lattice, whose closed sets contain each other exactly if their cells
/// do: coincident edges, holes that are filled exactly, islands, corners that touch.
class Lattice {
public:
    static constexpr int side = 6;
    using Cells = std::set<std::pair<int, int>>;

    static Cells any(Random& random, double share) {
        Cells cells;
        for (int x = 0; x < side; ++x) {
            for (int y = 0; y < side; ++y) {
                if (random.between(0.0, 1.0) < share) {
                    cells.insert({x, y});
                }
            }
        }
        if (cells.empty()) {
            cells.insert({random.whole(0, side), random.whole(0, side)});
        }
        return cells;
    }

    /// Each cell a ring of its own, so that neighbours share edges.
    static Rings parcels(const Cells& cells) {
        Rings rings;
        for (const auto& [x, y] : cells) {
            rings.push_back(rectangle({1.0 * x, 1.0 * y}, {x + 1.0, y + 1.0})[0]);
        }
        return rings;
    }

    /// The boundary alone, with collinear vertices or without.
    static Rings outline(const Cells& cells, bool joins_collinear) {
        // From each lattice point the directed edges that have a cell on the left only.
        std::multimap<std::pair<int, int>, std::pair<int, int>> edges;
        const auto add = [&](int x, int y, int dx, int dy, std::pair<int, int> beyond) {
            if (!cells.contains(beyond)) {
                edges.insert({{x, y}, {x + dx, y + dy}});
            }
        };
        for (const auto& [x, y] : cells) {
            add(x, y, 1, 0, {x, y - 1});
            add(x + 1, y, 0, 1, {x + 1, y});
            add(x + 1, y + 1, -1, 0, {x, y + 1});
            add(x, y + 1, 0, -1, {x - 1, y});
        }
        Rings rings;
        while (!edges.empty()) {
            Ring ring;
            const auto first = edges.begin()->first;
            std::pair<int, int> at = first;
            do {
                ring.push_back({1.0 * at.first, 1.0 * at.second});
                const auto next = edges.find(at);
                at = next->second;
                edges.erase(next);
            } while (at != first);
            rings.push_back(joins_collinear ? without_collinear(ring) : ring);
        }
        return rings;
    }

    static Rings any_rings(Random& random, const Cells& cells) {
        const int style = random.whole(0, 3);
        return style == 0 ? parcels(cells) : outline(cells, style == 1);
    }

private:
    static Ring without_collinear(const Ring& ring) {
        Ring corners;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vector2& before = ring[(i + ring.size() - 1) % ring.size()];
            const Vector2& after = ring[(i + 1) % ring.size()];
            if (oracle::orientation(before, ring[i], after) != 0.0L) {
                corners.push_back(ring[i]);
            }
        }
        return corners;
    }
};

TEST_F(ContainmentQueries, OfCellsIsThatOfTheirSets) {
    int inside = 0;
    int clear = 0;
    for_each_case(containment_lattice_seed, 1500, [&](Random& random) {
        const Lattice::Cells in_b = Lattice::any(random, random.between(0.3, 0.98));
        Lattice::Cells in_a = Lattice::any(random, random.between(0.02, 0.5));
        const double part = random.whole(0, 2) == 0 ? 1.0 : 1.0 / 3.0;  // side of A's cells
        const int per_cell = part == 1.0 ? 1 : 3;
        const int offset = part == 1.0 ? 0 : random.whole(0, 13);
        // Usually A loses what would stick out, but often a single cell is left.
        bool keeps_one = random.whole(0, 2) == 0;
        const auto is_in_b = [&](const std::pair<int, int>& cell) {
            return in_b.contains(
                {(cell.first + offset) / per_cell, (cell.second + offset) / per_cell});
        };
        for (auto cell = in_a.begin(); cell != in_a.end();) {
            const bool stays = is_in_b(*cell) || std::exchange(keeps_one, false);
            cell = stays ? std::next(cell) : in_a.erase(cell);
        }
        if (in_a.empty()) {
            in_a.insert({0, 0});
        }
        const bool truth = std::all_of(in_a.begin(), in_a.end(), is_in_b);
        const Pose pose{{random.between(-9.0, 9.0), random.between(-9.0, 9.0)},
                        random.whole(0, 2) == 0 ? 0.0 : random.between(-4.0, 4.0)};
        Pair pair{{"A", Lattice::any_rings(random, in_a)},
                  {"B", Lattice::any_rings(random, in_b)},
                  pose,
                  pose,
                  0.1};
        pair.a.rings = scaled_and_moved(pair.a.rings, part, {offset * part, offset * part});
        const ContainmentResult result = check(pair);
        EXPECT_EQ(result.inside, truth) << describe(pair);
        inside += result.inside ? 1 : 0;
        clear += result.clearance > 0.0 ? 1 : 0;
    });
    EXPECT_GT(inside, random_cases(1500) / 5);
    EXPECT_LT(inside, random_cases(1500) * 4 / 5);
    EXPECT_GT(clear, random_cases(1500) / 100);
}

}  // namespace
}  // namespace nearfield::test
