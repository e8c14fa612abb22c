#include <tests/query/query_test.hpp>

#include <string>
#include <vector>

namespace nearfield::test {
namespace {

const std::vector<Ring> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// Handles of a second context, or of what is gone, are refused and not taken for others.
class Handles : public testing::Test {
protected:
    Handles() : here_(*Context::create_cpu()), there_(*Context::create_cpu()) {
        own_ = *here_.add_shape(square);
        foreign_ = *there_.add_shape(square);
    }

    /// The call failed as it should and said which it was.
    static void expect(const Status& status, StatusCode code, const std::string& words) {
        EXPECT_EQ(status.code(), code) << status.text();
        EXPECT_NE(status.message().find(words), std::string::npos) << status.text();
    }

    Context here_;
    Context there_;
    ShapeHandle own_;
    ShapeHandle foreign_;
};

TEST_F(Handles, OfShapesOfAnotherContextAreRefused) {
    ASSERT_EQ(own_.index, foreign_.index);
    ASSERT_EQ(own_.generation, foreign_.generation);
    EXPECT_FALSE(own_ == foreign_);
    constexpr StatusCode code = StatusCode::unknown_shape;
    const std::string words = "shape of index 0 is of another context";
    expect(here_.update_shape(foreign_, square), code, words);
    expect(here_.remove_shape(foreign_), code, words);
    const Instance instances[] = {{own_, {}}, {foreign_, {}}};
    const Status pairs = here_.find_overlapping_boxes(instances, 0.0).error();
    expect(pairs, code, words);
    expect(pairs, code, "instance 1");
    const Status first = run_alone(here_, SeparationQuery{instances[1], instances[0], 0.01}).status;
    expect(first, code, words);
    expect(first, code, "shape A");
    expect(run_alone(here_, IntersectionTestQuery{instances[0], instances[1]}).status, code,
           "shape B");
    EXPECT_TRUE(run_alone(here_, IntersectionTestQuery{instances[0], instances[0]}).intersects);
    EXPECT_TRUE(there_.remove_shape(foreign_).ok());
}

TEST_F(Handles, OfShapesThatAreGoneAreRefused) {
    ASSERT_TRUE(here_.remove_shape(own_).ok());
    const ShapeHandle successor = *here_.add_shape(square);
    ASSERT_EQ(successor.index, own_.index);
    constexpr StatusCode code = StatusCode::unknown_shape;
    EXPECT_FALSE(successor == own_);
    expect(here_.update_shape(own_, square), code, "was removed");
    expect(here_.remove_shape(own_), code, "was removed");
    expect(here_.remove_shape({}), code, "names no shape");
    expect(run_alone(here_, IntersectionTestQuery{{own_, {}}, {successor, {}}}).status, code,
           "shape A: the shape of index 0 was removed");
}

TEST_F(Handles, OfShapesOfAFormerContextAreRefused) {
    Expected<Context> brief = Context::create_cpu();
    const ShapeHandle stale = *brief->add_shape(square);
    brief = Context::create_cpu();  // may lie at the same address
    const ShapeHandle fresh = *brief->add_shape(square);
    ASSERT_EQ(stale.index, fresh.index);
    expect(brief->remove_shape(stale), StatusCode::unknown_shape, "of another context");
}

TEST_F(Handles, TicketsOfAnotherContextAreRefused) {
    Batch batch;
    batch.add(IntersectionTestQuery{{own_, {}}, {own_, {}}});
    Batch other;
    other.add(IntersectionTestQuery{{foreign_, {}}, {foreign_, {}}});
    const Ticket own = *here_.submit(batch);
    const Ticket foreign = *there_.submit(other);
    ASSERT_EQ(own.number, foreign.number);
    Results results;
    constexpr StatusCode code = StatusCode::unknown_ticket;
    expect(here_.collect(foreign, results), code, "ticket 1 is of another context");
    expect(here_.collect({}, results), code, "names no batch");
    EXPECT_TRUE(here_.collect(own, results).ok());
    expect(here_.collect(own, results), code, "ticket 1 was collected already");
    EXPECT_TRUE(there_.collect(foreign, results).ok());
}

TEST_F(Handles, OfQueriesBelongToOneFillingOfABatch) {
    Batch batch;
    const IntersectionTestQuery query{{own_, {}}, {own_, {}}};
    const auto former = batch.add(query);
    Batch other;
    const auto foreign = other.add(query);
    batch.clear();
    const auto handle = batch.add(query);
    Results results;
    ASSERT_TRUE(here_.run(batch, results).ok());
    constexpr StatusCode code = StatusCode::invalid_query;
    expect(results[former].status, code, "before it was cleared");
    expect(results[foreign].status, code, "of another batch");
    EXPECT_TRUE(results[handle].intersects);
    // Later queries of the same filling, copies, and the batch cleared after it was submitted.
    const auto later = batch.add(query);
    const Batch copy = batch;
    const Ticket ticket = *here_.submit(copy);
    batch.clear();
    ASSERT_TRUE(here_.collect(ticket, results).ok());
    EXPECT_TRUE(results[handle].intersects && results[later].intersects);
    // A handle made from a position alone is one of any batch.
    EXPECT_TRUE(results[QueryHandle<IntersectionTestQuery>{1}].intersects);
    // Results of another batch are not taken for those of this one.
    ASSERT_TRUE(here_.run(other, results).ok());
    expect(results[handle].status, code, "of another batch");
    EXPECT_TRUE(results[foreign].intersects);
}

}  // namespace
}  // namespace nearfield::test
