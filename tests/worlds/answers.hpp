#pragma once

#include "scene.hpp"

#include <nearfield/nearfield.hpp>

#include <tests/support/numbers.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// \file All questions that a world is asked, and their answers as numbers that can be compared bit
/// for bit.

namespace nearfield::test {

/// What questions are about.
struct Questions {
    ShapeHandle shape;  ///< at the poses, and along the sweeps
    std::vector<Pose> poses;
    std::vector<Vector2> points;
    std::vector<Segment> segments;
    std::vector<Sweep> sweeps;
    std::vector<Rectangle> rectangles;
    WorldOptions options;
    ClearanceQuery clearances;
    NearestQuery nearest;
    NearestQuery edges = {.kind = NearestKind::edges};
    ShapeNearestQuery nearest_of_shape;
    ShapeEdgeQuery edges_of_shape;
    double tolerance = 1e-3;
    double contact_distance = 0.0;
    std::vector<InstanceHandle> a;  ///< of pairs that are listed
    std::vector<InstanceHandle> b;
    std::vector<InstanceHandle> moving;  ///< while times of impact are asked for
    std::vector<Pose> ends;
    std::size_t more_room = 0;  ///< for answers than there are; modulo 2^64

    /// The same about one input of each kind alone, as far as there are as many.
    [[nodiscard]] Questions about(std::size_t input) const;
    /// Lists each of some instances with the three that follow it.
    void list_pairs(const std::vector<InstanceHandle>& instances);
};

/// Random questions about a box, which name no shape and no instance.
[[nodiscard]] Questions any_questions(Random& random, const Rectangle& box, int count);

/// One kind of question, and the room for its answers, which stays.
class Question {
public:
    enum class Input { poses, points, segments, sweeps, rectangles, pairs };

    Question(std::string name, Input input) : name_(std::move(name)), input_(input) {}
    virtual ~Question() = default;
    Question(const Question&) = delete;
    Question& operator=(const Question&) = delete;

    /// The function that is called and, after a comma, for what.
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] std::string call() const { return name_.substr(0, name_.find(',')); }
    [[nodiscard]] Input input() const { return input_; }
    [[nodiscard]] bool has_shape() const {
        return input_ == Input::poses || input_ == Input::sweeps;
    }

    virtual Status ask(World& world, const Questions& about) = 0;
    /// Adds what was answered, input by input.
    virtual void add_to(Numbers& numbers) = 0;
    /// True if the caller makes the room for the answers.
    [[nodiscard]] virtual bool has_room() const { return false; }
    /// How many pairs of a table were not answered anew.
    [[nodiscard]] virtual std::uint32_t kept() const { return 0; }

private:
    std::string name_;
    Input input_;
};
using QuestionList = std::vector<std::unique_ptr<Question>>;

/// About poses, points, segments, sweeps and rectangles.
[[nodiscard]] QuestionList questions_about_inputs();
/// These, and tables of pairs that are listed, and of those that move.
[[nodiscard]] QuestionList questions_but_about_found_pairs();
/// Calls `visit(name, query, reach)` for each kind of query that a table is asked of pairs that a
/// world finds.
template <class Visit>
void for_each_query_of_pairs(const Visit& visit) {
    visit("penetrations", PenetrationQuery{.tolerance = 0.05}, 0.0);
    visit("vertices", PenetrationQuery{.tolerance = 0.05, .points = PenetrationPoints::vertices},
          0.0);
    visit("contacts", ContactQuery{.tolerance = 0.05, .contact_distance = 0.1}, 0.1);
    visit("intersections", IntersectionQuery{.tolerance = 0.05}, 0.0);
    visit("closest points", ClosestPointQuery{.tolerance = 0.05}, 0.5);
    visit("separations", SeparationQuery{.tolerance = 0.05}, 0.5);
    visit("tests", IntersectionTestQuery{}, 0.0);
    visit("separation vectors", SeparationVectorQuery{.tolerance = 0.1, .max_work = 20'000}, 0.0);
    visit("containment", ContainmentQuery{}, 0.0);
}
/// Tables of these, with all pairs or with hits alone.
[[nodiscard]] QuestionList questions_about_found_pairs();

/// Answers to questions, by their name.
class Answers {
public:
    /// `name`: an instance's, by what the worlds to be compared have in common.
    explicit Answers(Numbers::Name name) : name_(std::move(name)) {}
    /// Instances are named by their position in a scene.
    explicit Answers(const Scene& scene);

    /// Asks all; on a failure `status` says which call failed. The answers follow those before.
    void ask(const QuestionList& list, World& world, const Questions& about);
    /// Those about inputs.
    void ask(World& world, const Questions& about) { ask(questions_about_inputs(), world, about); }

    [[nodiscard]] const Status& status() const { return status_; }
    /// Empty if both have the same bits, otherwise the first difference.
    [[nodiscard]] std::string difference_from(const Answers& other) const;
    [[nodiscard]] std::size_t size() const;

private:
    struct Part {
        std::string name;
        Numbers numbers;
    };

    Numbers& part(const std::string& name);

    Numbers::Name name_;
    Status status_;
    std::vector<Part> parts_;
};

/// The answers to all questions about inputs, which succeed.
[[nodiscard]] Answers answers_of(Scene& scene, const Questions& about);

}  // namespace nearfield::test
