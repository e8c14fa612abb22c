#include <tests/query/field_laws.hpp>
#include <tests/support/numbers.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace nearfield::test {
namespace {

constexpr std::uint64_t reconstruction_seed = 60606;

class Reconstruction : public FieldLaws {
protected:
    /// Points in a rectangle, including its edge and corners.
    static std::vector<Vector2> any_points(Random& random, const Rectangle& box, int count) {
        std::vector<Vector2> points{
            box.min, box.max, {box.min.x, box.max.y}, {0.5 * (box.min.x + box.max.x), box.min.y}};
        for (int i = 0; i < count; ++i) {
            points.push_back(
                {random.between(box.min.x, box.max.x), random.between(box.min.y, box.max.y)});
        }
        return points;
    }
    /// The points of a field by every technique and method, and its cells if these are asked for.
    static void check(Context& context, const oracle::ShapeOracle& b, DistanceFieldQuery query,
                      std::size_t max_cells = 1000) {
        DistanceFieldResult differences;
        for (const Technique technique : every_technique) {
            for (const auto method : {GradientMethod::analytic, GradientMethod::central_differences,
                                      GradientMethod::blended}) {
                if (method == GradientMethod::blended && technique != Technique::raster) {
                    continue;
                }
                SCOPED_TRACE(to_string(technique));
                query.technique = technique;
                query.gradient = method;
                const DistanceFieldResult result = run_alone(context, query);
                check_points(b, query, result);
                if (!query.gradients) {
                    continue;
                }
                if (method == GradientMethod::analytic) {
                    check_cells(b, query, result, max_cells);
                    continue;
                }
                check_differences(b, result, max_cells);
                if (method == GradientMethod::blended) {
                    check_blended(differences, result);
                } else {  // two errors over two cells
                    EXPECT_DOUBLE_EQ(result.gradient_error_bound, result.error_bound / result.cell);
                    differences = result;
                }
            }
        }
    }
};

/// With features and gradients of all cells, or points alone.
TEST_F(Reconstruction, HoldsForRandomShapesByEveryMethodAndEncoding) {
    const int cases = random_cases(40);
    for (int i = 0; i < cases; ++i) {
        SCOPED_TRACE("seed " + std::to_string(reconstruction_seed) + " case " + std::to_string(i));
        Random random(reconstruction_seed + static_cast<std::uint64_t>(i));
        const AnyField field(context(), random);
        SCOPED_TRACE(field.text());
        DistanceFieldQuery query = field.query();
        const auto points = any_points(random, field.rectangle(), 40);
        query.points = points;
        query.values = query.features = query.gradients = i % 4 != 0;
        query.sign = static_cast<SignEncoding>(i % 3);
        check(context(), field.oracle(), query);
    }
}

TEST_F(Reconstruction, HoldsForEveryFamilyAndRealOutlines) {
    Random random(reconstruction_seed);
    const auto check_over = [&](const Rings& rings, double tolerance, const Rectangle& box,
                                const Pose& pose) {
        const PlacedShape shape(context(), rings, pose);
        DistanceFieldQuery query;
        query.b = shape.instance();
        query.tolerance = tolerance;
        query.rectangle = box;
        query.values = query.features = query.gradients = pose.angle != 0.0;
        const auto points = any_points(random, box, 100);
        query.points = points;
        check(context(), shape.oracle(), query);
    };
    for (const auto& [name, rings] : every_family(reconstruction_seed)) {
        SCOPED_TRACE(name);
        check_over(rings, 0.04, {{-1.2, -1.2}, {1.2, 1.2}}, {});
        check_over(rings, 0.03, {{-1.0, -1.5}, {2.0, 1.0}}, {{0.5, -0.25}, 0.9});
    }
    const Rings iceland = read_outline(NEARFIELD_TEST_DATA "/iceland_10m.geojson").rings;
    check_over(iceland, 2.0, oracle::ShapeOracle(iceland, {}).box(), {});
}

/// Cells in which two fields differ: in sign, or in any member.
struct Differences {
    int signs = 0;
    int values = 0;
};

Differences differences(const DistanceFieldResult& one, const DistanceFieldResult& other) {
    Differences found;
    for (std::size_t i = 0; i < one.values.size(); ++i) {
        found.signs += std::signbit(one.values[i]) != std::signbit(other.values[i]) ? 1 : 0;
        found.values += one.values[i] != other.values[i] ? 1 : 0;
    }
    return found;
}

/// The three encodings give equal signs: each in its own batch, where the whole field is identical
/// bit for bit, and all three side by side in one atlas, where a tile's place may decide which of
/// two equally near features is drawn.
TEST_F(Reconstruction, SignEncodingsAgree) {
    const int cases = random_cases(40);
    for (int i = 0; i < cases; ++i) {
        SCOPED_TRACE("seed " + std::to_string(reconstruction_seed) + " case " + std::to_string(i));
        Random random(reconstruction_seed + 500 + static_cast<std::uint64_t>(i));
        const AnyField field(context(), random);
        SCOPED_TRACE(field.text());
        Batch batch;
        std::vector<QueryHandle<DistanceFieldQuery>> handles;
        DistanceFieldResult first;
        for (const SignEncoding sign :
             {SignEncoding::stencil, SignEncoding::color, SignEncoding::feature_bit}) {
            DistanceFieldQuery query = field.query();
            query.sign = sign;
            handles.push_back(batch.add(query));
            const DistanceFieldResult result = run_alone(context(), query);
            ASSERT_TRUE(result.status.ok()) << result.status.text();
            if (sign == SignEncoding::stencil) {
                first = result;
                check_field(field.oracle(), first.tolerance, first, 2000);
            }
            ASSERT_EQ(first.values.size(), result.values.size());
            EXPECT_EQ(differences(first, result).signs, 0) << static_cast<int>(sign);
            EXPECT_EQ(differences(first, result).values, 0) << static_cast<int>(sign);
        }
        Results results;
        ASSERT_TRUE(context().run(batch, results).ok());
        for (const auto handle : handles) {
            ASSERT_TRUE(results[handle].status.ok()) << results[handle].status.text();
            EXPECT_EQ(differences(first, results[handle]).signs, 0) << handle.index;
        }
    }
}

/// Fields of every kind together with other queries, so that all passes share one graph. Unique
/// nearest features do not depend on the rest of the batch; if two are about equally near, either
/// may be reported and a few cells differ.
void check_features_alike(const DistanceFieldResult& one, const DistanceFieldResult& other) {
    ASSERT_EQ(one.features.size(), other.features.size());
    std::size_t unique = 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < one.features.size(); ++i) {
        if (one.unique[i] != 0 && other.unique[i] != 0) {
            ++unique;
            const bool same = one.features[i].kind == other.features[i].kind &&
                              one.features[i].index == other.features[i].index;
            different += same ? 0U : 1U;
        }
    }
    EXPECT_GT(unique, one.features.size() / 2);
    EXPECT_LT(different, unique / 100);
}

TEST_F(Reconstruction, HoldsInOneBatchWithEverything) {
    Random random(reconstruction_seed + 9);
    const PlacedPair pair(
        context(),
        {{"A", star(random, 20, 0.5)}, {"B", star(random, 30, 0.4)}, {}, {{0.4, 0.2}, 0.5}, 0.04});
    const Rectangle box{{-1, -1}, {1, 1}};
    const auto points = any_points(random, box, 50);
    Batch batch;
    std::vector<QueryHandle<PenetrationQuery>> penetrations;
    std::vector<QueryHandle<IntersectionQuery>> intersections;
    std::vector<QueryHandle<ContactQuery>> contacts;
    for (const Technique technique : every_technique) {
        PenetrationQuery penetration = pair.penetration();
        IntersectionQuery intersection = pair.intersection(IntersectionKind::boundary_volume);
        ContactQuery by_gradient = pair.contacts(0.08);
        penetration.technique = intersection.technique = by_gradient.technique = technique;
        by_gradient.normals = ContactNormals::gradient;
        penetrations.push_back(batch.add(penetration));
        intersections.push_back(batch.add(intersection));
        contacts.push_back(batch.add(by_gradient));
    }
    std::vector<DistanceFieldQuery> fields;
    for (int i = 0; i < 9; ++i) {
        DistanceFieldQuery query;
        query.b = pair.instance_b();
        query.tolerance = pair.tolerance();
        query.rectangle = box;
        query.sign = static_cast<SignEncoding>(i % 3);
        query.gradient = static_cast<GradientMethod>(i / 3);
        query.features = query.gradients = true;
        query.points = points;
        for (const Technique technique : every_technique) {
            query.technique = technique;
            if (technique == Technique::raster || query.gradient != GradientMethod::blended) {
                fields.push_back(query);
            }
        }
    }
    std::vector<QueryHandle<DistanceFieldQuery>> handles;
    for (const DistanceFieldQuery& query : fields) {
        handles.push_back(batch.add(query));
    }
    Results results;
    for (int run = 0; run < 2; ++run) {
        ASSERT_TRUE(context().run(batch, results).ok());
        for (std::size_t i = 0; i < contacts.size(); ++i) {
            EXPECT_EQ(results[intersections[i]].technique, every_technique[i]);
            check_penetration(pair, PenetrationPoints::boundary, results[penetrations[i]]);
            check_intersection(pair, IntersectionKind::boundary_volume, results[intersections[i]]);
            EXPECT_TRUE(results[contacts[i]].status.ok()) << results[contacts[i]].status.text();
            EXPECT_EQ(results[contacts[i]].count, results[contacts.front()].count);
            EXPECT_GT(results[contacts[i]].count, 0U);
        }
        for (std::size_t i = 0; i < fields.size(); ++i) {
            SCOPED_TRACE(i);
            const DistanceFieldResult& result = results[handles[i]];
            EXPECT_EQ(result.technique, fields[i].technique);
            check_features_alike(result, results[handles.front()]);
            check_field(pair.b(), pair.tolerance(), result, 500);
            check_points(pair.b(), fields[i], result);
            if (fields[i].gradient == GradientMethod::analytic) {
                check_cells(pair.b(), fields[i], result, 500);
            } else {
                check_differences(pair.b(), result, 500);
            }
        }
    }
}

TEST_F(Reconstruction, CellsAloneGiveWhatTheWholeImageGives) {
    const int cases = random_cases(27);
    for (int i = 0; i < cases; ++i) {
        SCOPED_TRACE("seed " + std::to_string(reconstruction_seed) + " case " + std::to_string(i));
        Random random(reconstruction_seed + 800 + static_cast<std::uint64_t>(i));
        const AnyField field(context(), random);
        DistanceFieldQuery query = field.query();
        query.sign = static_cast<SignEncoding>(i % 3);
        query.gradient = static_cast<GradientMethod>(i / 3 % 3);
        const auto points = any_points(random, field.rectangle(), 60);
        query.points = points;
        const auto whole = run_alone(context(), query);
        query.values = false;
        const auto alone = run_alone(context(), query);
        ASSERT_TRUE(whole.status.ok()) << whole.status.text();
        ASSERT_TRUE(alone.status.ok()) << alone.status.text();
        EXPECT_TRUE(alone.values.empty());
        for (std::size_t k = 0; k < points.size(); ++k) {
            EXPECT_EQ(numbers_of(whole.points[k]), numbers_of(alone.points[k])) << k;
            // The image gives the same value if it contains all four cells.
            const double x = (points[k].x - whole.origin.x) / whole.cell - 0.5;
            const double y = (points[k].y - whole.origin.y) / whole.cell - 0.5;
            if (x < 0 || y < 0 || x >= whole.width - 1.0 || y >= whole.height - 1.0) {
                continue;
            }
            const auto column = static_cast<std::size_t>(x);
            const auto row = static_cast<std::size_t>(y);
            const auto value = [&](std::size_t right, std::size_t up) {
                return static_cast<double>(whole.values[(row + up) * whole.width + column + right]);
            };
            const double u = x - static_cast<double>(column);
            const double v = y - static_cast<double>(row);
            const double expected = (1 - u) * (1 - v) * value(0, 0) + u * (1 - v) * value(1, 0) +
                                    (1 - u) * v * value(0, 1) + u * v * value(1, 1);
            EXPECT_NEAR(whole.points[k].distance, expected,
                        1e-9 * (std::abs(expected) + whole.cell + std::abs(points[k].x) +
                                std::abs(points[k].y)));
        }
    }
}

/// Both techniques use the same cells, in the image and around its border.
TEST_F(Reconstruction, TechniquesAgreeAtPoints) {
    const int cases = random_cases(20);
    for (int i = 0; i < cases; ++i) {
        SCOPED_TRACE("seed " + std::to_string(reconstruction_seed) + " case " + std::to_string(i));
        Random random(reconstruction_seed + 1200 + static_cast<std::uint64_t>(i));
        const AnyField field(context(), random);
        SCOPED_TRACE(field.text());
        DistanceFieldQuery query = field.query();
        query.gradient = GradientMethod::central_differences;
        const auto points = any_points(random, field.rectangle(), 60);
        query.points = points;
        query.values = i % 2 == 0;
        const auto drawn = run_alone(context(), query);
        query.technique = Technique::cpu;
        const auto exact = run_alone(context(), query);
        ASSERT_TRUE(drawn.status.ok() && exact.status.ok());
        EXPECT_LE(exact.error_bound, drawn.error_bound);
        const double most = drawn.error_bound + exact.error_bound;
        for (std::size_t k = 0; k < points.size(); ++k) {
            SCOPED_TRACE(k);
            EXPECT_NEAR(exact.points[k].distance, drawn.points[k].distance, most);
            EXPECT_NEAR(exact.points[k].gradient.x, drawn.points[k].gradient.x, most / drawn.cell);
            EXPECT_NEAR(exact.points[k].gradient.y, drawn.points[k].gradient.y, most / drawn.cell);
            EXPECT_LE(exact.points[k].error_bound, exact.error_bound + query.tolerance);
        }
    }
}

/// Several tiles and tile batches without seams, points everywhere, and points in only some tiles.
TEST_F(Reconstruction, HoldsAcrossTilesAndRounds) {
    Random random(reconstruction_seed);
    Settings settings;
    settings.memory_limit = std::uint64_t{24} << 20U;  // a small atlas
    Expected<Context> small = Context::create(host_device(), on_demand(settings));
    ASSERT_TRUE(small.has_value()) << small.error().text();
    const PlacedShape shape(*small, scaled_and_moved(star(random, 12, 0.3), 20.0, {}), {});
    DistanceFieldQuery query;
    query.b = shape.instance();
    query.tolerance = 0.02;
    query.rectangle = {{-20.0, 3.0}, {20.0, 5.0}};
    const auto points = any_points(random, *query.rectangle, 500);
    query.points = points;
    query.features = query.gradients = true;
    check(*small, shape.oracle(), query, 3000);
    query.features = query.gradients = query.values = false;
    check(*small, shape.oracle(), query);
    query.points = std::span(points).last(2);
    check(*small, shape.oracle(), query);
}

/// Beside a long wall, two points that lie alike between their cells. A thousand away, single
/// precision adds to the bound of the cells, and as much to that of the point.
TEST_F(Reconstruction, FarPointsAreAsExactAsTheirCells) {
    const PlacedShape shape(context(), rectangle({-1, -500}, {0, 500}), {});
    for (const Technique technique : device_techniques) {
        SCOPED_TRACE(to_string(technique));
        const auto bounds_at = [&](double away) {
            const std::array<Vector2, 1> points{{{away + 0.53, 0.02}}};
            DistanceFieldQuery query;
            query.b = shape.instance();
            query.tolerance = 0.1;
            query.rectangle = {{away, -1}, {away + 1, 1}};
            query.technique = technique;
            query.points = points;
            query.values = false;
            const auto result = run_alone(context(), query);
            EXPECT_TRUE(result.status.ok()) << result.status.text();
            return std::pair(result.error_bound, result.points.at(0).error_bound);
        };
        const auto [near_cells, near_point] = bounds_at(10.0);
        const auto [far_cells, far_point] = bounds_at(1000.0);
        EXPECT_GT(far_cells - near_cells, 1e-3);
        // A value is rounded by up to 4e-5.
        EXPECT_NEAR(far_point - near_point, far_cells - near_cells, 4e-4);
    }
}

/// The values behind a difference at a point are those of the field.
TEST_F(Reconstruction, GradientsAtPointsAreBilinearBetweenCells) {
    Random random(reconstruction_seed + 3);
    const PlacedShape shape(context(), star(random, 20, 0.4), {});
    for (const auto method : {GradientMethod::central_differences, GradientMethod::blended}) {
        DistanceFieldQuery query;
        query.technique = Technique::raster;
        query.b = shape.instance();
        query.tolerance = 0.03;
        query.rectangle = {{-1, -1}, {1, 1}};
        query.gradient = method;
        query.gradients = true;
        const auto points = any_points(random, *query.rectangle, 100);
        query.points = points;
        const auto result = run_alone(context(), query);
        ASSERT_TRUE(result.status.ok()) << result.status.text();
        int compared = 0;
        for (const FieldPoint& point : result.points) {
            const double x = (point.position.x - result.origin.x) / result.cell - 0.5;
            const double y = (point.position.y - result.origin.y) / result.cell - 0.5;
            if (x < 0 || y < 0 || x >= result.width - 1.0 || y >= result.height - 1.0) {
                continue;
            }
            const auto column = static_cast<std::size_t>(x);
            const auto row = static_cast<std::size_t>(y);
            const double u = x - static_cast<double>(column);
            const double v = y - static_cast<double>(row);
            const std::array<double, 4> weights{(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
            Vector2 expected;
            for (std::size_t corner = 0; corner < 4; ++corner) {
                const std::size_t cell = (row + corner / 2) * result.width + column + corner % 2;
                expected.x += weights[corner] * static_cast<double>(result.gradients[2 * cell]);
                expected.y += weights[corner] * static_cast<double>(result.gradients[2 * cell + 1]);
            }
            EXPECT_NEAR(point.gradient.x, expected.x, 1e-6);
            EXPECT_NEAR(point.gradient.y, expected.y, 1e-6);
            ++compared;
        }
        EXPECT_GT(compared, 50);
    }
}

}  // namespace
}  // namespace nearfield::test
