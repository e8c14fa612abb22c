#include <tests/query/agreement.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/degenerate_shapes.hpp>
#include <tests/query/device_offers.hpp>
#include <tests/query/query_test.hpp>
#include <tests/query/two_drivers.hpp>
#include <tests/support/outlines.hpp>

#include <algorithm>
#include <optional>
#include <sstream>
#include <vector>

namespace nearfield::test {
namespace {

constexpr std::uint64_t drivers_seed = 2357;

/// The manifests that CMake found or was given.
std::vector<std::string> manifests() {
    std::vector<std::string> files;
    std::istringstream text(NEARFIELD_TEST_DRIVER_MANIFESTS);
    for (std::string file; std::getline(text, file, ':');) {
        files.push_back(file);
    }
    return files;
}

/// Every kind of query about a pair, by every method that involves the device.
class Questions {
public:
    explicit Questions(const PlacedPair& pair) : pair_(&pair), points_(some_points()) {
        add_records();
        add_intersections();
        add_fields();
        add_cpu();
    }
    Questions(const Questions&) = delete;
    Questions& operator=(const Questions&) = delete;

    [[nodiscard]] const Batch& batch() const { return batch_; }
    /// The equivalent query with a strategy that every device supports.
    [[nodiscard]] std::size_t by_stencil(std::size_t query) const { return by_stencil_[query]; }

private:
    /// A corner of B's box and some cells around it, so that large shapes stay fast.
    [[nodiscard]] Rectangle field_of_view() const {
        const Rectangle box = pair_->b().box();
        const double cell = 1.5 * pair_->tolerance();
        const Vector2 low{box.min.x - 5.3 * cell, box.min.y - 5.3 * cell};
        return {low,
                {std::min(box.max.x + 5.3 * cell, low.x + 60.0 * cell),
                 std::min(box.max.y + 5.3 * cell, low.y + 60.0 * cell)}};
    }
    [[nodiscard]] std::vector<Vector2> some_points() const;

    template <class Query>
    void add(const Query& query) {
        by_stencil_.push_back(by_stencil_.size());
        batch_.add(query);
    }
    void add_records();
    void add_intersections();
    void add_fields();
    void add_cpu();

    const PlacedPair* pair_;
    std::vector<Vector2> points_;
    Batch batch_;
    std::vector<std::size_t> by_stencil_;
};

std::vector<Vector2> Questions::some_points() const {
    const Rectangle view = field_of_view();
    Random random(drivers_seed);
    std::vector<Vector2> points;
    for (int i = 0; i < 40; ++i) {
        points.push_back(
            {random.between(view.min.x, view.max.x), random.between(view.min.y, view.max.y)});
    }
    return points;
}

void Questions::add_records() {
    for (const Technique technique : device_techniques) {
        for (const PenetrationPoints points :
             {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
            PenetrationQuery query = pair_->penetration(points);
            query.technique = technique;
            add(query);
        }
        for (const ContactNormals normals : {ContactNormals::analytic, ContactNormals::gradient}) {
            ContactQuery query = pair_->contacts(2.0 * pair_->tolerance());
            query.technique = technique;
            query.normals = normals;
            add(query);
        }
        SeparationQuery separation = pair_->separation();
        separation.technique = technique;
        add(separation);
        ClosestPointQuery closest = pair_->closest_point();
        closest.technique = technique;
        add(closest);
    }
}

void Questions::add_intersections() {
    for (const IntersectionKind kind : every_kind) {
        IntersectionQuery query = pair_->intersection(kind);
        const std::size_t first = by_stencil_.size();
        for (const IntersectionStrategy strategy : every_strategy) {
            query.technique = Technique::raster;
            query.strategy = strategy;
            add(query);
            by_stencil_.back() = first;
        }
        for (const Technique technique : {Technique::compute, Technique::cpu}) {
            query.technique = technique;
            add(query);
        }
    }
}

void Questions::add_fields() {
    DistanceFieldQuery query;
    query.b = pair_->instance_b();
    query.tolerance = pair_->tolerance();
    query.rectangle = field_of_view();
    for (const SignEncoding sign :
         {SignEncoding::stencil, SignEncoding::color, SignEncoding::feature_bit}) {
        query.technique = Technique::raster;
        query.sign = sign;
        add(query);
    }
    query.points = points_;
    query.gradients = true;
    for (const Technique technique : device_techniques) {
        query.technique = technique;
        query.gradient = GradientMethod::central_differences;
        add(query);
        query.gradient = GradientMethod::analytic;
        query.features = true;
        add(query);
        query.features = false;
    }
    query.technique = Technique::raster;
    query.gradient = GradientMethod::blended;
    add(query);
}

void Questions::add_cpu() {
    const Instance a = pair_->instance_a();
    const Instance b = pair_->instance_b();
    add(IntersectionTestQuery{a, b});
    add(ContainmentQuery{a, b});
    add(TimeOfImpactQuery{a, b, b.pose, b.pose, pair_->tolerance()});
    SeparationVectorQuery vector{a, b, pair_->tolerance()};
    vector.max_work = 100'000;
    add(vector);
}

class Drivers : public testing::Test {
protected:
    /// Calls `check(drivers)` with the first driver paired with each of the others.
    template <class Check>
    void for_each_two(const Check& check) {
        const std::vector<std::string> files = manifests();
        ASSERT_GE(files.size(), 2U) << "there is nothing to compare";
        for (std::size_t i = 1; i < files.size(); ++i) {
            SCOPED_TRACE(files[0] + " and " + files[i]);
            if (second_ != files[i]) {
                TearDownTestSuite();
                drivers_.emplace(files[0], files[i]);
                second_ = files[i];
            }
            check(*drivers_);
        }
    }
    static void TearDownTestSuite() {
        if (drivers_) {
            EXPECT_EQ(drivers_->close(), std::vector<std::string>{});
        }
        drivers_.reset();
    }

    static void compare(TwoDrivers& drivers, const Pair& pair) {
        SCOPED_TRACE(describe(pair));
        std::array<Results, TwoDrivers::all.size()> results;
        for (const TwoDrivers::Which which : TwoDrivers::all) {
            Context& context = drivers.context(which);
            const PlacedPair placed(context, pair);
            const Questions questions(placed);
            const Status status = context.run(questions.batch(), results[which]);
            ASSERT_TRUE(status.ok()) << status.text();
            if (!drivers.host(which).logic_op) {
                refuse_logic_op(questions, results[which]);
            }
        }
        const PlacedPair placed(drivers.context(TwoDrivers::coarser), pair);
        const Questions questions(placed);
        compare(questions, placed, SubPixelGrids::same, results[TwoDrivers::coarser],
                results[TwoDrivers::finer_on_coarser_grid]);
        compare(questions, placed, SubPixelGrids::apart, results[TwoDrivers::coarser],
                results[TwoDrivers::finer]);
    }

private:
    /// Kept from test to test, because making the pipelines of a driver takes seconds.
    inline static std::optional<TwoDrivers> drivers_;
    inline static std::string second_;

    /// On a device without the feature these must be rejected; the stencil's answers, which must be
    /// equal, replace them.
    static void refuse_logic_op(const Questions& questions, Results& results) {
        for (std::size_t i = 0; i < results.results.size(); ++i) {
            const auto* const query =
                std::get_if<IntersectionQuery>(&questions.batch().queries()[i]);
            if (query != nullptr && query->technique == Technique::raster &&
                query->strategy == IntersectionStrategy::logic_op) {
                expect_logic_op_refused(std::get<IntersectionResult>(results.results[i]));
                results.results[i] = results.results[questions.by_stencil(i)];
            }
        }
    }

    static void compare(const Questions& questions, const PlacedPair& placed, SubPixelGrids grids,
                        const Results& one, const Results& other) {
        SCOPED_TRACE(grids == SubPixelGrids::same ? "on the same sub-pixel grid"
                                                  : "on their own sub-pixel grids");
        const std::span<const AnyQuery> queries = questions.batch().queries();
        for (std::size_t i = 0; i < queries.size(); ++i) {
            SCOPED_TRACE("query " + std::to_string(i));
            check_agreement({placed, queries[i], grids}, one.results[i], other.results[i]);
        }
    }
};

TEST_F(Drivers, AgreeOnRandomPairs) {
    for_each_two([](TwoDrivers& drivers) {
        for_each_case(drivers_seed, 10, [&](Random& random) {
            Pair pair = any_pair(random);
            if (random.whole(0, 2) == 0) {  // apart
                pair.pose_b.translation.x += random.scale(0.1, 100.0) * 10.0 * pair.tolerance;
            }
            compare(drivers, pair);
        });
    });
}

TEST_F(Drivers, AgreeOnEveryFamily) {
    for_each_two([](TwoDrivers& drivers) {
        for (const Pair& pair : family_pairs(drivers_seed)) {
            compare(drivers, pair);
        }
    });
}

TEST_F(Drivers, AgreeOnDegeneratePolygons) {
    for_each_two([](TwoDrivers& drivers) {
        const auto shapes = degenerate_shapes(drivers.context(TwoDrivers::finer), 40, drivers_seed);
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            compare(drivers,
                    {shapes[i], shapes[(i + 5) % shapes.size()], {}, {{1.3, -0.7}, 0.1}, 0.7});
        }
    });
}

TEST_F(Drivers, AgreeOnTheCorpus) {
    for_each_two([](TwoDrivers& drivers) {
        for (const CorpusCase& one : read_corpus(NEARFIELD_TEST_DATA "/corpus")) {
            compare(drivers, one.pair);
        }
    });
}

TEST_F(Drivers, AgreeOnOutlines) {
    for_each_two([](TwoDrivers& drivers) {
        const std::vector<NamedRings> outlines = read_outlines(NEARFIELD_TEST_DATA);
        ASSERT_GE(outlines.size(), 2U);
        for (std::size_t i = 0; i < outlines.size(); ++i) {
            const NamedRings& other = outlines[(i + 1) % outlines.size()];
            compare(drivers, {outlines[i], other, {}, {{60.0, 30.0}, 0.4}, 4.0});
        }
    });
}

}  // namespace
}  // namespace nearfield::test
