#include <tests/query/check.hpp>
#include <tests/query/corpus.hpp>
#include <tests/query/query_test.hpp>

namespace nearfield::test {
namespace {

/// Pairs for which a query once gave a wrong answer; every query must answer them correctly.
class Corpus : public QueryTest {};

TEST_F(Corpus, EveryQueryIsRight) {
    const std::vector<CorpusCase> cases = read_corpus(NEARFIELD_TEST_DATA "/corpus");
    EXPECT_FALSE(cases.empty());
    for (const CorpusCase& one : cases) {
        SCOPED_TRACE(one.name);
        const PlacedPair placed(context(), one.pair);
        for (const auto points : {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
            check_penetration(placed, points, run_alone(context(), placed.penetration(points)));
        }
        for (const auto kind :
             {IntersectionKind::boundary_boundary, IntersectionKind::boundary_volume,
              IntersectionKind::volume_volume}) {
            check_intersection(placed, kind, run_alone(context(), placed.intersection(kind)));
        }
        const SeparationResult separation = run_alone(context(), placed.separation());
        check_separation(placed, separation);
        check_same(separation, run_alone(context(), placed.closest_point()));
        check_contacts(placed, one.contact_distance,
                       run_alone(context(), placed.contacts(one.contact_distance)));
        DistanceFieldQuery field;
        field.technique = Technique::raster;
        field.b = placed.instance_b();
        field.tolerance = placed.tolerance();
        field.rectangle = placed.b().box();
        check_field(placed.b(), placed.tolerance(), run_alone(context(), field), 2000);
    }
}

}  // namespace
}  // namespace nearfield::test
