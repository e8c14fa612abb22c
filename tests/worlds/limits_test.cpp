#include "answers.hpp"

#include <gtest/gtest.h>
#include <tests/limits/cut.hpp>

#include <memory>
#include <string>

namespace nearfield::test {
namespace {

/// A world of stars, half of which move, and questions about it.
class Stars {
public:
    Stars() : scene_(stars()) {
        Random random(6);
        about_ = any_questions(random, {{-1.0, -1.0}, {8.0, 7.0}}, 40);
        about_.options = {};
        about_.clearances = {};
        about_.nearest_of_shape = {.count = 3};
        about_.edges_of_shape = {.count = 3};
        about_.nearest = {.count = 3};
        about_.edges = {.count = 3, .kind = NearestKind::edges};
        about_.shape = scene_.add_shape(star(random, 60, 0.5));
        about_.sweeps.clear();
        for (std::size_t i = 0; i < 40; ++i) {
            about_.sweeps.push_back({about_.poses[i], {about_.segments[i].to, 0.0}});
        }
        std::vector<InstanceHandle> all;
        for (std::size_t i = 0; i < scene_.size(); ++i) {
            all.push_back(scene_.handle(i));
        }
        about_.list_pairs(all);
        about_.moving.assign(all.begin(), all.begin() + 15);
        about_.ends.assign(about_.poses.begin(), about_.poses.begin() + 15);
    }

    [[nodiscard]] Scene& scene() { return scene_; }
    [[nodiscard]] const Questions& about() const { return about_; }
    Status ask(Question& question, const Limits& limits) {
        about_.options.limits = limits;
        return question.ask(scene_.world(), about_);
    }
    /// The numbers of the whole answer.
    Numbers answer(Question& question) {
        const Status status = ask(question, {});
        EXPECT_TRUE(status.ok()) << status.text();
        Numbers numbers;
        question.add_to(numbers);
        EXPECT_FALSE(numbers.list().empty());
        return numbers;
    }

private:
    static std::vector<Placement> stars() {
        Random random(5);
        std::vector<Placement> placements;
        placements.push_back(
            {"in the first", scaled_and_moved(star(random, 60, 0.5), 0.05, {}), {}});
        for (int i = 0; i < 30; ++i) {
            placements.push_back({"star",
                                  star(random, 60, 0.5),
                                  {{1.3 * (i % 6), 1.3 * (i / 6)}, random.between(0.0, 6.0)}});
        }
        return placements;
    }

    Scene scene_;
    Questions about_;
};

QuestionList all_questions() {
    QuestionList list = questions_but_about_found_pairs();
    for (std::unique_ptr<Question>& question : questions_about_found_pairs()) {
        list.push_back(std::move(question));
    }
    return list;
}

TEST(WorldLimits, CutEveryQuestionAtEveryStage) {
    Stars stars;
    for (std::size_t i = 0; i < all_questions().size(); ++i) {
        // Tables start anew, or there would be little to do.
        const auto question = [i] { return std::move(all_questions()[i]); };
        SCOPED_TRACE(question()->name());
        const Numbers whole = stars.answer(*question());
        const std::uint64_t cuts = cut_everywhere(dense, [&](std::uint64_t n) {
            SCOPED_TRACE("cut at checkpoint " + std::to_string(n));
            const Cut cut(n);
            const std::unique_ptr<Question> asked = question();
            const Status status = stars.ask(*asked, cut.limits());
            EXPECT_EQ(status.code(), cut.has_cut() ? StatusCode::cancelled : StatusCode::ok)
                << status.text();
            if (!cut.has_cut()) {
                Numbers numbers;
                asked->add_to(numbers);
                EXPECT_EQ(numbers.list(), whole.list());
            }
            EXPECT_EQ(stars.answer(*asked).list(), whole.list());
            return cut.has_cut() && !HasFailure();
        });
        EXPECT_GE(cuts, 12U);
    }
}

TEST(WorldLimits, OfNoTimeAnswerNothing) {
    Stars stars;
    for (const std::unique_ptr<Question>& question : all_questions()) {
        SCOPED_TRACE(question->name());
        EXPECT_EQ(stars.ask(*question, {.seconds = 0.0}).code(), StatusCode::budget_exhausted);
        EXPECT_EQ(stars.ask(*question, {.seconds = -1.0}).code(), StatusCode::invalid_settings);
    }
}

TEST(WorldLimits, CountWhatIsDone) {
    Stars stars;
    const Cut none(0);
    RayHits hits;
    ASSERT_TRUE(stars.scene()
                    .world()
                    .cast_rays(stars.about().segments, hits, {.limits = none.limits()})
                    .ok());
    EXPECT_EQ(none.count(), 40U);
    EXPECT_EQ(none.done(), 39U) << "at the last checkpoint, before the last segment";
}

}  // namespace
}  // namespace nearfield::test
