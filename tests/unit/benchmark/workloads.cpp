#include <gtest/gtest.h>
#include <tools/benchmark/workloads.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace nearfield::benchmark {
namespace {

double cross(const Vector2& o, const Vector2& a, const Vector2& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

bool is_convex(const Ring& ring) {
    bool left = false;
    bool right = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double turn =
            cross(ring[i], ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]);
        left = left || turn > 0.0;
        right = right || turn < 0.0;
    }
    return !(left && right);
}

/// The number of edge pairs that share a point, except neighbours; touching counts.
std::size_t crossings(const Ring& ring) {
    struct Edge {
        Vector2 from;
        Vector2 to;
        std::size_t index;
    };
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        edges.push_back({ring[i], ring[(i + 1) % ring.size()], i});
    }
    const auto low = [](const Edge& edge) { return std::min(edge.from.x, edge.to.x); };
    const auto high = [](const Edge& edge) { return std::max(edge.from.x, edge.to.x); };
    std::sort(edges.begin(), edges.end(),
              [&](const Edge& a, const Edge& b) { return low(a) < low(b); });
    std::size_t count = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& a = edges[i];
        for (std::size_t j = i + 1; j < edges.size() && low(edges[j]) <= high(a); ++j) {
            const Edge& b = edges[j];
            const std::size_t apart = a.index > b.index ? a.index - b.index : b.index - a.index;
            const bool neighbors = apart == 1 || apart + 1 == edges.size();
            if (!neighbors && cross(a.from, a.to, b.from) * cross(a.from, a.to, b.to) <= 0.0 &&
                cross(b.from, b.to, a.from) * cross(b.from, b.to, a.to) <= 0.0) {
                ++count;
            }
        }
    }
    return count;
}

struct PaperScene {
    const char* name;
    tools::Scene (*make)(std::size_t scale);
    std::size_t objects;
    std::size_t lines;
    bool convex = false;
};

/// Table 2 of the paper.
constexpr PaperScene paper_scenes[] = {{"map", map_scene, 6, 719},
                                       {"gears", gears_scene, 13, 391},
                                       {"links", links_scene, 15, 440},
                                       {"cars", cars_scene, 18, 266, true},
                                       {"wavy", wavy_scene, 2, 200}};

TEST(PaperScenes, HaveTheObjectsAndLinesOfThePaper) {
    for (const PaperScene& scene : paper_scenes) {
        for (const std::size_t scale : {1U, 10U, 100U}) {
            const tools::Scene made = scene.make(scale);
            EXPECT_EQ(made.instances.size(), scene.objects) << scene.name << " x" << scale;
            EXPECT_EQ(vertex_count(made), scale * scene.lines) << scene.name << " x" << scale;
        }
    }
}

TEST(PaperScenes, HaveShapesThatDoNotCrossThemselvesAndAreNotConvexButForCars) {
    for (const PaperScene& scene : paper_scenes) {
        for (const std::size_t scale : {1U, 10U, 100U}) {
            for (const tools::SceneShape& shape : scene.make(scale).shapes) {
                const std::string where =
                    std::string(scene.name) + " x" + std::to_string(scale) + " " + shape.name;
                for (const Ring& ring : shape.rings) {
                    EXPECT_EQ(crossings(ring), 0U) << where;
                }
                EXPECT_EQ(is_convex(shape.rings.front()), scene.convex) << where;
            }
        }
    }
}

TEST(PaperScenes, LookTheSameFromAfarAtEveryScale) {
    for (const PaperScene& scene : paper_scenes) {
        const tools::Scene coarse = scene.make(1);
        const tools::Scene fine = scene.make(10);
        for (std::size_t i = 0; i < coarse.shapes.size(); ++i) {
            const auto highest = [](const Ring& ring) {
                return std::max_element(
                           ring.begin(), ring.end(),
                           [](const Vector2& a, const Vector2& b) { return a.y < b.y; })
                    ->y;
            };
            EXPECT_NEAR(highest(coarse.shapes[i].rings.front()),
                        highest(fine.shapes[i].rings.front()), 0.1)
                << scene.name << i;
            EXPECT_EQ(coarse.instances[i].pose.translation, fine.instances[i].pose.translation);
        }
    }
}

TEST(StandardTable, HasRowsOfDifferentNamesWithQueriesInEach) {
    std::set<std::string> names;
    for (const Row& row : standard_table()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
    }
    EXPECT_GT(names.size(), 100U);
}

TEST(StandardTable, IsTheSameWorkEachTime) {
    const std::vector<Row> first = standard_table();
    const std::vector<Row> second = standard_table();
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        const tools::Scene a = first[i].scene();
        const tools::Scene b = second[i].scene();
        EXPECT_FALSE(a.queries.empty()) << first[i].name;
        ASSERT_EQ(a.shapes.size(), b.shapes.size()) << first[i].name;
        for (std::size_t shape = 0; shape < a.shapes.size(); ++shape) {
            ASSERT_EQ(a.shapes[shape].rings, b.shapes[shape].rings) << first[i].name;
            ASSERT_EQ(a.instances[shape].pose.translation, b.instances[shape].pose.translation);
        }
    }
}

}  // namespace
}  // namespace nearfield::benchmark
