#include "answers.hpp"

#include <gtest/gtest.h>
#include <tests/support/pair_tables.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace nearfield::test {
namespace {

using Input = Question::Input;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
const double bad_numbers[] = {nan_value, infinity, -infinity, 1.1 * largest_coordinate,
                              -1.1 * largest_coordinate};

/// Two squares, one of which is in the way of an item.
class WorldRefusals : public testing::Test {
protected:
    WorldRefusals() : scene_(unit_squares({{0, 0}, {3, 0}})) {
        Random random(1);
        about_ = any_questions(random, {{-1.0, -1.0}, {5.0, 3.0}}, 20);
        about_.shape = item_ = scene_.add_shape(rectangle({0, 0}, {1, 1}));
        about_.list_pairs({scene_.handle(0), scene_.handle(1)});
        before_.emplace(answers_of(scene_, about_));
    }

    World& world() { return scene_.world(); }

    /// The call failed as it should, said which it was, and changed nothing.
    void expect(const Status& status, StatusCode code, const std::string& words) {
        EXPECT_EQ(status.code(), code) << status.text();
        EXPECT_NE(status.message().find(words), std::string::npos)
            << "'" << status.message() << "' does not say '" << words << "'";
        EXPECT_EQ(world().size(), 2U);
        EXPECT_EQ(answers_of(scene_, about_).difference_from(*before_), "");
    }
    /// All questions for which `is_asked` are refused, once `change(questions)` has spoiled what
    /// they are about.
    template <class IsAsked, class Change>
    void expect_refused(const IsAsked& is_asked, const Change& change, StatusCode code,
                        const std::string& words) {
        Questions wrong = about_;
        change(wrong);
        int refused = 0;
        for (const std::unique_ptr<Question>& question : questions_) {
            if (is_asked(*question)) {
                SCOPED_TRACE(question->name());
                const Status status = question->ask(world(), wrong);
                EXPECT_EQ(status.message().find(question->call() + ": "), 0U) << status.text();
                expect(status, code, words);
                ++refused;
            }
        }
        EXPECT_GT(refused, 0);
    }
    template <class Change>
    void expect_refused(Input input, const Change& change, StatusCode code,
                        const std::string& words) {
        expect_refused([input](const Question& question) { return question.input() == input; },
                       change, code, words);
    }
    template <class Change>
    void expect_refused(const char* name, const Change& change, const std::string& words) {
        expect_refused([name](const Question& question) { return question.name() == name; }, change,
                       StatusCode::invalid_query, words);
    }

    Scene scene_;
    ShapeHandle item_;
    Questions about_;
    QuestionList questions_ = questions_but_about_found_pairs();
    std::optional<Answers> before_;
};

constexpr StatusCode invalid = StatusCode::invalid_query;

TEST_F(WorldRefusals, OfInputsNameTheFirst) {
    for (const double bad : bad_numbers) {
        for (const Pose& pose : {Pose{{bad, 0.0}, 0.0}, Pose{{0.0, bad}, 0.0},
                                 Pose{{0.0, 0.0}, std::isfinite(bad) ? nan_value : bad}}) {
            expect_refused(
                Input::poses, [&](Questions& q) { q.poses[1] = q.poses[3] = pose; }, invalid,
                "(number 1)");
            for (const Sweep& sweep : {Sweep{pose, {}}, Sweep{{}, pose}}) {
                expect_refused(
                    Input::sweeps, [&](Questions& q) { q.sweeps[1] = sweep; }, invalid,
                    "(number 1)");
            }
            expect(world().add({item_, pose}).error(), invalid, "add: ");
            expect(world().move(scene_.handle(0), pose), invalid, "move: ");
            const InstanceHandle both[] = {scene_.handle(1), scene_.handle(0)};
            const Pose poses[] = {{{9.0, 9.0}, 1.0}, pose};
            expect(world().move(both, poses), invalid, "move: ");
        }
        for (const Vector2& point : {Vector2{bad, 0.0}, Vector2{0.0, bad}}) {
            expect_refused(
                Input::points, [&](Questions& q) { q.points[1] = q.points[2] = point; }, invalid,
                "point 1 ");
            for (const Segment& segment : {Segment{point, {}}, Segment{{}, point}}) {
                expect_refused(
                    Input::segments, [&](Questions& q) { q.segments[2] = segment; }, invalid,
                    "segment 2 ");
            }
            for (const Rectangle& rectangle :
                 {Rectangle{point, {1.0, 1.0}}, Rectangle{{}, point}}) {
                expect_refused(
                    Input::rectangles, [&](Questions& q) { q.rectangles[1] = rectangle; }, invalid,
                    "rectangle 1 ");
            }
        }
    }
    for (const Rectangle& reversed :
         {Rectangle{{1.0, 0.0}, {0.0, 1.0}}, Rectangle{{0.0, 1.0}, {1.0, 0.0}}}) {
        expect_refused(
            Input::rectangles, [&](Questions& q) { q.rectangles[0] = reversed; }, invalid,
            "rectangle 0 ");
    }
}

TEST_F(WorldRefusals, OfSpansOfDifferentLength) {
    const auto has_room = [](const Question& question) { return question.has_room(); };
    for (const int more : {-1, 1}) {
        const auto change = [more](Questions& q) { q.more_room = static_cast<std::size_t>(more); };
        expect_refused(has_room, change, invalid, "there are ");
        const std::vector<InstanceHandle> handles(static_cast<std::size_t>(3 + more),
                                                  scene_.handle(0));
        expect(world().move(handles, std::vector<Pose>(3)), invalid, "3 poses");
    }
    expect_refused(
        Input::pairs, [](Questions& q) { q.a.pop_back(), q.moving.assign(2, q.b.front()); },
        invalid, " instances ");
}

TEST_F(WorldRefusals, OfNumbersInQueries) {
    const char* const nearest[] = {"find_nearest, of points", "find_nearest, edges of points",
                                   "find_nearest, of a shape", "find_nearest, edges of a shape"};
    for (const char* const name : nearest) {
        const auto for_all = [](Questions& q, const auto& change) {
            change(q.nearest);
            change(q.edges);
            change(q.nearest_of_shape);
            change(q.edges_of_shape);
        };
        const auto count_none = [&](Questions& q) {
            for_all(q, [](auto& query) { query.count = 0; });
        };
        expect_refused(name, count_none, "0 hits");
        expect_refused(
            name, [&](Questions& q) { count_none(q), q.points.clear(), q.poses.clear(); },
            "0 hits");
        for (const double bad : {-1.0, nan_value, -infinity}) {
            expect_refused(
                name,
                [&](Questions& q) { for_all(q, [&](auto& query) { query.max_distance = bad; }); },
                "at least 0");
        }
    }
    expect_refused(
        "find_nearest, of points",
        [](Questions& q) { q.nearest.kind = static_cast<NearestKind>(7); }, "kind");
    const double ranges[][2] = {{0.0, -1.0},         {1.0, 1.0},       {2.0, 1.0},
                                {nan_value, 1.0},    {0.0, nan_value}, {-2.0, -1.0},
                                {infinity, infinity}};
    for (const auto& range : ranges) {
        expect_refused(
            "find_clearances, within limits",
            [&](Questions& q) {
                q.clearances = {{}, range[0], range[1]};
            },
            "the clearances from");
    }
    for (const double bad : {0.0, -1.0, nan_value, infinity, 2.0 * largest_coordinate}) {
        expect_refused(
            "cast_shape", [&](Questions& q) { q.tolerance = bad; }, "tolerance");
    }
    for (const double bad : {-1.0, nan_value, infinity, 2.0 * largest_coordinate}) {
        expect_refused(
            "cast_shape", [&](Questions& q) { q.contact_distance = bad; }, "contact distance");
    }
}

TEST_F(WorldRefusals, OfShapesThatAreNotThere) {
    const ShapeHandle removed = scene_.add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_TRUE(scene_.context().remove_shape(removed).ok());
    const ShapeHandle successor = scene_.add_shape(rectangle({0, 0}, {1, 1}));
    ASSERT_EQ(successor.index, removed.index);
    for (const ShapeHandle shape : {removed, ShapeHandle(), ShapeHandle{77, 0}}) {
        expect(world().add({shape, {}}).error(), StatusCode::unknown_shape, "add: ");
        expect_refused([](const Question& question) { return question.has_shape(); },
                       [shape](Questions& q) { q.shape = shape; }, StatusCode::unknown_shape, "");
    }
}

TEST_F(WorldRefusals, OfInstancesThatAreNotThere) {
    const InstanceHandle removed = *world().add({item_, {}});
    ASSERT_TRUE(world().remove(removed).ok());
    const InstanceHandle successor = *world().add({item_, {{50.0, 0.0}}});
    EXPECT_EQ(successor.index, removed.index);
    EXPECT_FALSE(successor == removed);
    ASSERT_TRUE(world().remove(successor).ok());
    const Pose pose{{9.0, 9.0}, 0.0};
    for (const InstanceHandle handle :
         {removed, successor, InstanceHandle(), InstanceHandle{99, 0}}) {
        constexpr StatusCode code = StatusCode::unknown_instance;
        expect(world().move(handle, pose), code, "move");
        const InstanceHandle both[] = {scene_.handle(0), handle};
        const Pose poses[] = {pose, pose};
        expect(world().move(both, poses), code, "move");
        expect(world().set_filter(handle, 2, 2), code, "set_filter");
        expect(world().remove(handle), code, "remove");
        expect(world().instance(handle).error(), code, "instance");
        const InstanceHandle good[] = {scene_.handle(0), scene_.handle(1)};
        for (const bool is_first : {true, false}) {
            expect_refused(
                Input::pairs,
                [&](Questions& q) {
                    (is_first ? q.a : q.b).back() = handle;
                    q.moving = {handle};
                    q.ends = {{}};
                },
                code, "");
        }
        PairTable penetrations(PenetrationQuery{.tolerance = 0.1}, of_list);
        expect(world().submit(penetrations, {.a = good, .b = both}), code, "submit");
    }
}

TEST_F(WorldRefusals, OfHandlesOfAnotherWorld) {
    Scene other(unit_squares({{0, 0}}));
    const InstanceHandle foreign = other.handle(0);
    ASSERT_EQ(foreign.index, scene_.handle(0).index);
    ASSERT_EQ(foreign.generation, scene_.handle(0).generation);
    const std::string words = ": the instance of index 0 is of another world";
    constexpr StatusCode code = StatusCode::unknown_instance;
    expect(world().move(foreign, {}), code, "move" + words);
    expect(world().set_filter(foreign, 2, 2), code, "set_filter" + words);
    expect(world().remove(foreign), code, "remove" + words);
    expect(world().instance(foreign).error(), code, "instance" + words);
    // Of pairs, or to ignore, which would otherwise be another one here.
    expect_refused([](const Question& /*any*/) { return true; },
                   [foreign](Questions& q) {
                       q.a.back() = foreign;
                       q.moving = {foreign};
                       q.ends = {{}};
                       q.options.filter.ignored = foreign;
                   },
                   code, words);
    // The shapes of another context, in a world of this one.
    expect(world().add({other.add_shape(rectangle({0, 0}, {1, 1})), {}}).error(),
           StatusCode::unknown_shape, "is of another context");
}

TEST_F(WorldRefusals, NothingIsAskedOfNothing) {
    Questions nothing = about_.about(1000);
    nothing.a = nothing.b = {};
    for (const std::unique_ptr<Question>& question : questions_) {
        SCOPED_TRACE(question->name());
        EXPECT_TRUE(question->ask(world(), about_).ok());
        EXPECT_TRUE(question->ask(world(), nothing).ok());
        Numbers numbers;
        question->add_to(numbers);
        EXPECT_TRUE(numbers.list().empty());
    }
    EXPECT_TRUE(world().move(std::span<const InstanceHandle>(), {}).ok());
    EXPECT_EQ(answers_of(scene_, about_).difference_from(*before_), "");
}

TEST_F(WorldRefusals, AnEmptyWorldAnswers) {
    ASSERT_TRUE(world().remove(scene_.handle(0)).ok());
    ASSERT_TRUE(world().remove(scene_.handle(1)).ok());
    EXPECT_EQ(world().size(), 0U);
    const Answers empty = answers_of(scene_, about_);
    Scene nothing({});
    about_.shape = nothing.add_shape(rectangle({0, 0}, {1, 1}));
    EXPECT_EQ(empty.difference_from(answers_of(nothing, about_)), "");
}

/// A shape that is removed takes its instances out of all answers; they can only be removed.
TEST_F(WorldRefusals, RemovedShapesTakeTheirInstancesAlong) {
    ASSERT_TRUE(scene_.context().remove_shape(scene_.shape(0)).ok());
    Scene other(unit_squares({{3, 0}}));
    Questions about = about_;
    about.shape = other.add_shape(rectangle({0, 0}, {1, 1}));
    Answers expected([&](InstanceHandle handle) { return handle == other.handle(0) ? 1.0 : -1.0; });
    expected.ask(other.world(), about);
    EXPECT_EQ(answers_of(scene_, about_).difference_from(expected), "");
    // Nor does a shape that takes the removed one's place bring them back.
    const ShapeHandle successor = scene_.add_shape(rectangle({0, 0}, {9, 9}));
    ASSERT_EQ(successor.index, scene_.shape(0).index);
    EXPECT_EQ(answers_of(scene_, about_).difference_from(expected), "");
    EXPECT_TRUE(world().remove(scene_.handle(0)).ok());
    EXPECT_EQ(world().size(), 1U);
    EXPECT_EQ(answers_of(scene_, about_).difference_from(expected), "");
}

}  // namespace
}  // namespace nearfield::test
