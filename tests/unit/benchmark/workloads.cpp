#include <gtest/gtest.h>
#include <tools/benchmark/table.hpp>
#include <tools/benchmark/workloads.hpp>

#include <algorithm>
#include <cmath>
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

TEST(Questions, OnlySeparationsReachBeyondTheBoxes) {
    const tools::Scene separations = asked(crowd_scene(), separation(0.01), Pairs::all);
    EXPECT_DOUBLE_EQ(separations.queries.back().reach, 20.0 * 0.01);
    EXPECT_EQ(asked(crowd_scene(), contacts(0.01), Pairs::all).queries.back().reach, 0.0);
}

TEST(Crowds, AreStarsOfFiftyVertices) {
    const tools::Scene crowd = crowd_scene();
    EXPECT_EQ(crowd.instances.size(), 1000U);
    EXPECT_EQ(vertex_count(crowd), 50000U);
    const tools::Scene pairs = small_pairs_scene(1000);
    EXPECT_EQ(pairs.instances.size(), 2000U);
    EXPECT_EQ(vertex_count(pairs), 100000U);
    for (const tools::Scene* scene : {&crowd, &pairs}) {
        for (const tools::SceneShape& shape : scene->shapes) {
            EXPECT_EQ(crossings(shape.rings.front()), 0U) << shape.name;
            EXPECT_FALSE(is_convex(shape.rings.front())) << shape.name;
        }
    }
}

TEST(Coasts, HaveAsManyVerticesAsAskedAndDoNotCrossThemselves) {
    for (const std::size_t n : {8U, 200U, 20000U}) {
        const Ring ring = coast(1, n);
        EXPECT_EQ(ring.size(), n);
        EXPECT_EQ(crossings(ring), 0U) << n;
    }
    EXPECT_FALSE(is_convex(coast(1, 200)));
}

TEST(CoastLines, AreTheRealOnes) {
    ASSERT_EQ(iceland().size(), 1U);
    ASSERT_EQ(ireland().size(), 1U);
    EXPECT_EQ(iceland().front().size(), 3056U);
    EXPECT_EQ(ireland().front().size(), 2250U);
    EXPECT_EQ(crossings(iceland().front()), 0U);
    EXPECT_EQ(crossings(ireland().front()), 0U);
}

TEST(CoastLines, GapIsWhereTheFirstVertexMeetsTheOther) {
    const std::vector<Ring> square{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}};
    const std::vector<Ring> wedge{{{3.0, 0.5}, {5.0, 0.0}, {5.0, 1.0}}};
    EXPECT_DOUBLE_EQ(gap_along_x(square, wedge), 2.0);
    const std::vector<Ring> high{{{3.0, 2.5}, {5.0, 2.0}, {5.0, 3.0}}};
    EXPECT_EQ(gap_along_x(square, high), INFINITY);
    // A vertex of the left one against an edge of the right one.
    const std::vector<Ring> left{{{0.0, 0.0}, {1.0, 0.5}, {0.0, 1.0}}};
    const std::vector<Ring> right{{{4.0, -1.0}, {4.0, 2.0}, {6.0, 0.5}}};
    EXPECT_DOUBLE_EQ(gap_along_x(left, right), 3.0);
}

TEST(CoastLines, StandAsFarApartAsTold) {
    const auto place = [](double overlap) {
        return coast_lines_scene(overlap).instances[1].pose.translation.x;
    };
    const Ring ring = iceland().front();
    const auto [low, high] = std::minmax_element(
        ring.begin(), ring.end(), [](const Vector2& a, const Vector2& b) { return a.x < b.x; });
    const double width = high->x - low->x;
    EXPECT_NEAR(place(-0.1) - place(0.0), 0.1 * width, 1e-9);
    EXPECT_NEAR(place(0.0) - place(0.01), 0.01 * width, 1e-9);
    // Touching: no distance left.
    const tools::Scene touching = coast_lines_scene(0.0);
    std::vector<Ring> moved = touching.shapes[1].rings;
    for (Ring& other : moved) {
        for (Vector2& vertex : other) {
            vertex.x += touching.instances[1].pose.translation.x;
        }
    }
    EXPECT_NEAR(gap_along_x(touching.shapes[0].rings, moved), 0.0, 1e-9);
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
