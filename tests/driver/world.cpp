#include <gtest/gtest.h>
#include <tests/driver/world.hpp>
#include <tests/query/all_numbers.hpp>
#include <tests/support/allocations.hpp>

namespace nearfield::test {
namespace {

constexpr double first_cells = 4.0;
constexpr double larger_cells = 50.0;

const std::vector<Ring> rings_a{{{0, 0}, {3, 0}, {3, 2}, {2, 1}, {1, 2}, {0, 2}}};
const std::vector<Ring> rings_b{{{0, 0}, {2, 0.2}, {2.5, 1.5}, {1, 2.5}, {-0.5, 1}}};
const std::vector<Vector2> field_points{{1.1, 1.2}, {1.6, 1.4}};

/// Of any query of a batch.
Status first_error(const Results& results) {
    for (const AnyResult& any : results.results) {
        Status status = std::visit([](const auto& result) { return result.status; }, any);
        if (!status.ok()) {
            return status;
        }
    }
    return {};
}

}  // namespace

Status World::take(Step step) {
    switch (step) {
        case Step::create:
            return create();
        case Step::add_shapes:
            return add_shapes();
        case Step::submit_first:
            return submit(first_cells);
        case Step::submit_larger:
        case Step::submit_last:
            return submit(larger_cells);
        case Step::collect_first:
        case Step::collect_larger:
            return collect();
        case Step::destroy:
            context_.reset();
            return {};
    }
    return {};
}

void World::take_all_before(Step step) {
    for (const Step earlier : steps) {
        if (earlier == step) {
            return;
        }
        const Status status = take(earlier);
        ASSERT_TRUE(status.ok()) << to_string(earlier) << ": " << status.text();
    }
}

Status World::create() {
    Expected<Context> made = Context::create(driver_.host());
    if (made.ok()) {
        context_.emplace(std::move(*made));
    }
    return made.status();
}

Status World::add_shapes() {
    const Expected<ShapeHandle> a = context_->add_shape(rings_a);
    if (!a.ok()) {
        return a.status();
    }
    const Expected<ShapeHandle> b = context_->add_shape(rings_b);
    if (!b.ok()) {
        return b.status();
    }
    a_ = *a;
    b_ = *b;
    return {};
}

Status World::submit(double cells) {
    Batch queries;
    {
        const test_support::UnwatchedAllocations here;
        queries = batch(cells, technique_);
    }
    const Expected<Ticket> ticket = context_->submit(queries);
    if (ticket.ok()) {
        ticket_ = *ticket;
    }
    return ticket.status();
}

Status World::collect() {
    static_cast<void>(context_->is_ready(ticket_));
    Results results;
    Status status = context_->collect(ticket_, results);
    return status.ok() ? first_error(results) : status;
}

Status World::answer(std::vector<double>& numbers) {
    Results results;
    if (Status status = context_->run(batch(larger_cells, technique_), results); !status.ok()) {
        return status;
    }
    if (Status status = first_error(results); !status.ok()) {
        return status;
    }
    if (Status status = context_->run(batch(first_cells, Technique::cpu), results); !status.ok()) {
        return status;
    }
    numbers = all_numbers(results);
    return first_error(results);
}

std::vector<double> World::undisturbed(Technique technique) {
    World world(technique);
    world.take_all_before(Step::submit_first);
    std::vector<double> numbers;
    const Status status = world.answer(numbers);
    EXPECT_TRUE(status.ok()) << status.text();
    EXPECT_GT(numbers.size(), 100U);
    return numbers;
}

Batch World::batch(double cells, Technique technique) const {
    const double tolerance = 1.0 / cells;
    const Instance here{a_, {}};
    const Instance there{b_, {{1.2, 0.4}, 0.3}};
    const Instance apart{b_, {{4.5, 0.4}, 0.3}};
    Batch batch;
    for (const PenetrationPoints points :
         {PenetrationPoints::boundary, PenetrationPoints::vertices}) {
        batch.add(PenetrationQuery{here, there, tolerance, points, true, technique});
    }
    for (const ContactNormals normals : {ContactNormals::analytic, ContactNormals::gradient}) {
        batch.add(ContactQuery{here, there, tolerance, 0.1, normals, true, technique});
    }
    batch.add(ClosestPointQuery{here, apart, tolerance, technique});
    batch.add(SeparationQuery{here, apart, tolerance, technique});
    batch.add(IntersectionTestQuery{here, there});
    batch.add(TimeOfImpactQuery{here, apart, there.pose, apart.pose, tolerance});
    batch.add(SeparationVectorQuery{here, there, tolerance});
    for (const IntersectionKind kind :
         {IntersectionKind::boundary_boundary, IntersectionKind::boundary_volume,
          IntersectionKind::volume_volume}) {
        batch.add(IntersectionQuery{here, there, tolerance, kind, true,
                                    IntersectionStrategy::stencil, technique});
    }
    for (std::size_t i = 0; i < intersection_strategies; ++i) {
        batch.add(IntersectionQuery{here, there, tolerance, IntersectionKind::volume_volume, true,
                                    static_cast<IntersectionStrategy>(i), technique});
    }
    DistanceFieldQuery field{here, there, tolerance};
    field.features = field.gradients = true;
    field.points = field_points;
    field.technique = technique;
    for (const SignEncoding sign :
         {SignEncoding::stencil, SignEncoding::color, SignEncoding::feature_bit}) {
        field.sign = sign;
        batch.add(field);
    }
    if (technique == Technique::raster) {
        field.gradient = GradientMethod::blended;
        batch.add(field);
    }
    return batch;
}

const char* to_string(World::Step step) {
    switch (step) {
        case World::Step::create:
            return "create";
        case World::Step::add_shapes:
            return "add shapes";
        case World::Step::submit_first:
            return "submit the first batch";
        case World::Step::collect_first:
            return "collect the first batch";
        case World::Step::submit_larger:
            return "submit a larger batch";
        case World::Step::collect_larger:
            return "collect a larger batch";
        case World::Step::submit_last:
            return "submit the last batch";
        case World::Step::destroy:
            return "destroy";
    }
    return "";
}

}  // namespace nearfield::test
