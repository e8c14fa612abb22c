#include "answers.hpp"

#include <gtest/gtest.h>
#include <tests/support/pair_tables.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <sstream>

namespace nearfield::test {

Questions any_questions(Random& random, const Rectangle& box, int count) {
    Questions questions;
    const double width = box.max.x - box.min.x;
    const double height = box.max.y - box.min.y;
    const auto point = [&]() -> Vector2 {
        const Vector2 at{box.min.x + random.between(-0.1, 1.1) * width,
                         box.min.y + random.between(-0.1, 1.1) * height};
        // Whole numbers are where squares of whole numbers tie.
        return random.whole(0, 3) == 0 ? Vector2{std::round(at.x), std::round(at.y)} : at;
    };
    for (int i = 0; i < count; ++i) {
        questions.poses.push_back({point(), random.whole(0, 3) * random.between(-1.0, 1.0)});
        questions.points.push_back(point());
        questions.segments.push_back({point(), point()});
        const Vector2 low = point();
        questions.rectangles.push_back(
            {low, {low.x + random.scale(1e-3, 2.0), low.y + random.scale(1e-3, 2.0)}});
        if (i % 8 == 0) {
            const Pose start{point(), random.between(0.0, 3.0)};
            questions.sweeps.push_back({start, {point(), start.angle + random.whole(0, 1)}});
        }
    }
    if (random.whole(0, 3) == 0) {
        questions.options.filter.mask = static_cast<std::uint32_t>(random.whole(1, 15));
    }
    questions.clearances.min_clearance = random.whole(0, 1) == 0 ? 0.0 : -random.scale(1e-3, 1.0);
    questions.clearances.max_clearance = random.scale(1e-3, 3.0);
    questions.nearest.count = static_cast<std::uint32_t>(random.whole(1, 6));
    questions.edges.count = static_cast<std::uint32_t>(random.whole(1, 9));
    questions.nearest_of_shape.count = static_cast<std::uint32_t>(random.whole(1, 6));
    questions.edges_of_shape.count = questions.edges.count;
    if (random.whole(0, 1) == 0) {
        questions.nearest.max_distance = random.scale(1e-2, 5.0);
        questions.edges.max_distance = random.scale(1e-2, 5.0);
        questions.nearest_of_shape.max_distance = random.scale(1e-2, 5.0);
        questions.edges_of_shape.max_distance = questions.edges.max_distance;
    }
    questions.contact_distance = random.whole(0, 1) == 0 ? 0.0 : random.scale(1e-3, 0.5);
    return questions;
}

Questions Questions::about(std::size_t input) const {
    Questions one = *this;
    const auto keep = [input](auto& inputs) {
        inputs = input < inputs.size() ? std::vector{inputs[input]}
                                       : std::vector<std::decay_t<decltype(inputs[0])>>();
    };
    keep(one.poses);
    keep(one.points);
    keep(one.segments);
    keep(one.sweeps);
    keep(one.rectangles);
    return one;
}

void Questions::list_pairs(const std::vector<InstanceHandle>& instances) {
    for (std::size_t i = 0; i < instances.size(); ++i) {
        for (std::size_t j = i + 1; j < std::min(i + 4, instances.size()); ++j) {
            a.push_back(instances[i]);
            b.push_back(instances[j]);
        }
    }
}

namespace {

using Input = Question::Input;

/// Of as many answers as `count(questions)` says, for which there is room.
template <class Answer, class Count, class Call>
class QuestionWithRoom final : public Question {
public:
    QuestionWithRoom(const char* name, Input input, Count count, Call call)
        : Question(name, input), count_(count), call_(call) {}

    Status ask(World& world, const Questions& about) override {
        answers_.resize(count_(about) + about.more_room);
        return call_(world, about, std::span(answers_));
    }
    void add_to(Numbers& numbers) override { numbers.add_each(std::span(answers_)); }
    [[nodiscard]] bool has_room() const override { return true; }

private:
    Count count_;
    Call call_;
    std::vector<Answer> answers_;
};

/// Of lists that grow as the answers need it.
template <class Lists, class Call>
class QuestionForLists final : public Question {
public:
    QuestionForLists(const char* name, Input input, Call call)
        : Question(name, input), call_(call) {}

    Status ask(World& world, const Questions& about) override {
        return call_(world, about, lists_);
    }
    void add_to(Numbers& numbers) override {
        ASSERT_FALSE(lists_.offsets.empty());
        EXPECT_EQ(lists_.offsets.front(), 0U);
        EXPECT_TRUE(std::is_sorted(lists_.offsets.begin(), lists_.offsets.end()));
        numbers.add(lists_);
    }

private:
    Call call_;
    Lists lists_;
};

/// Of a table of pairs.
template <class Query>
class QuestionAboutPairs final : public Question {
public:
    QuestionAboutPairs(const std::string& name, const Query& query, const PairTableOptions& options)
        : Question("update, " + name, Input::pairs), table_(query, options) {}

    Status ask(World& world, const Questions& about) override {
        PairTableInput input;
        if (table_.options().listed) {
            input = {.a = about.a, .b = about.b};
        } else if constexpr (std::is_same_v<Query, TimeOfImpactQuery>) {
            input = {.moving = about.moving, .ends = about.ends};
        }
        Status status = world.update(table_, input, about.options.limits);
        if (!status.ok()) {
            EXPECT_TRUE(table_.rows().empty());
            EXPECT_EQ(table_.size(), 0U);
            EXPECT_EQ(table_.candidates(), 0U);
        }
        return status;
    }
    void add_to(Numbers& numbers) override {
        for (const PairRow<Query>& row : table_.rows()) {
            numbers.add_row(table_, row);
        }
    }
    [[nodiscard]] std::uint32_t kept() const override {
        return table_.candidates() - table_.left_to_cpu();
    }

private:
    PairTable<Query> table_;
};

/// Adds to a list of questions.
struct Adding {
    QuestionList& list;

    template <class Answer, class Count, class Call>
    void with_room(const char* name, Input input, Count count, Call call) const {
        list.push_back(
            std::make_unique<QuestionWithRoom<Answer, Count, Call>>(name, input, count, call));
    }
    template <class Lists, class Call>
    void for_lists(const char* name, Input input, Call call) const {
        list.push_back(std::make_unique<QuestionForLists<Lists, Call>>(name, input, call));
    }
    template <class Query>
    void about_pairs(const std::string& name, const Query& query,
                     const PairTableOptions& options) const {
        list.push_back(std::make_unique<QuestionAboutPairs<Query>>(name, query, options));
    }
};

template <class Query>
Query with_shape(Query query, const Questions& about) {
    query.shape = about.shape;
    return query;
}

}  // namespace

QuestionList questions_about_inputs() {
    using Q = const Questions&;
    QuestionList list;
    const Adding add{list};
    const auto of_poses = [](Q q) { return q.poses.size(); };
    add.with_room<std::uint8_t>("test_poses", Input::poses, of_poses,
                                [](World& world, Q q, auto answers) {
                                    return world.test_poses(q.shape, q.poses, answers, q.options);
                                });
    add.with_room<Clearance>(
        "find_clearances", Input::poses, of_poses, [](World& world, Q q, auto answers) {
            return world.find_clearances({q.shape}, q.poses, answers, q.options);
        });
    add.with_room<Clearance>("find_clearances, within limits", Input::poses, of_poses,
                             [](World& world, Q q, auto answers) {
                                 return world.find_clearances(with_shape(q.clearances, q), q.poses,
                                                              answers, q.options);
                             });
    add.with_room<Clearance>(
        "find_nearest, of a shape", Input::poses,
        [](Q q) { return q.poses.size() * q.nearest_of_shape.count; },
        [](World& world, Q q, auto answers) {
            return world.find_nearest(with_shape(q.nearest_of_shape, q), q.poses, answers,
                                      q.options);
        });
    add.with_room<ShapeEdgeHit>(
        "find_nearest, edges of a shape", Input::poses,
        [](Q q) { return q.poses.size() * q.edges_of_shape.count; },
        [](World& world, Q q, auto answers) {
            return world.find_nearest(with_shape(q.edges_of_shape, q), q.poses, answers, q.options);
        });
    add.with_room<NearestHit>(
        "find_nearest, of points", Input::points,
        [](Q q) { return q.points.size() * q.nearest.count; },
        [](World& world, Q q, auto answers) {
            return world.find_nearest(q.nearest, q.points, answers, q.options);
        });
    add.with_room<NearestHit>(
        "find_nearest, edges of points", Input::points,
        [](Q q) { return q.points.size() * q.edges.count; },
        [](World& world, Q q, auto answers) {
            return world.find_nearest(q.edges, q.points, answers, q.options);
        });
    add.with_room<RayHit>(
        "cast_rays, first hits", Input::segments, [](Q q) { return q.segments.size(); },
        [](World& world, Q q, auto answers) {
            return world.cast_rays(q.segments, answers, q.options);
        });
    add.for_lists<RayHits>("cast_rays, all hits", Input::segments,
                           [](World& world, Q q, RayHits& hits) {
                               return world.cast_rays(q.segments, hits, q.options);
                           });
    add.with_room<ShapeCastHit>(
        "cast_shape", Input::sweeps, [](Q q) { return q.sweeps.size(); },
        [](World& world, Q q, auto answers) {
            return world.cast_shape({q.shape, q.tolerance, q.contact_distance}, q.sweeps, answers,
                                    q.options);
        });
    add.for_lists<InstanceLists>("find_overlaps, of rectangles", Input::rectangles,
                                 [](World& world, Q q, InstanceLists& lists) {
                                     return world.find_overlaps(q.rectangles, lists, q.options);
                                 });
    add.for_lists<InstanceLists>("find_overlaps, of points", Input::points,
                                 [](World& world, Q q, InstanceLists& lists) {
                                     return world.find_overlaps(q.points, lists, q.options);
                                 });
    add.for_lists<InstanceLists>("find_overlaps, of a shape", Input::poses,
                                 [](World& world, Q q, InstanceLists& lists) {
                                     return world.find_overlaps(q.shape, q.poses, lists, q.options);
                                 });
    return list;
}

QuestionList questions_but_about_found_pairs() {
    QuestionList list = questions_about_inputs();
    const Adding add{list};
    add.about_pairs("listed tests", IntersectionTestQuery{}, of_list);
    add.about_pairs(
        "listed vertices",
        PenetrationQuery{
            .tolerance = 0.05, .points = PenetrationPoints::vertices, .summary_only = true},
        of_list);
    add.about_pairs("listed penetrations", PenetrationQuery{.tolerance = 0.05}, of_list);
    add.about_pairs("listed contacts", ContactQuery{.tolerance = 0.05, .contact_distance = 0.05},
                    of_list);
    add.about_pairs("times of impact", TimeOfImpactQuery{.tolerance = 1e-3, .max_steps = 50}, {});
    add.about_pairs("impacts within a distance",
                    TimeOfImpactQuery{.tolerance = 1e-3, .max_steps = 50, .contact_distance = 0.1},
                    {.hits_only = true});
    return list;
}

QuestionList questions_about_found_pairs() {
    QuestionList list;
    const Adding add{list};
    for_each_query_of_pairs([&](const std::string& name, const auto& query, double reach) {
        add.about_pairs(name, query, {.reach = reach});
        add.about_pairs("hits of " + name, query, {.reach = reach, .hits_only = true});
    });
    return list;
}

Answers::Answers(const Scene& scene)
    : Answers([&scene](InstanceHandle handle) {
          const auto position = scene.position(handle);
          if (position || handle == InstanceHandle()) {
              return position ? static_cast<double>(*position) : -1.0;
          }
          return 1000.0 + handle.index;
      }) {}

Numbers& Answers::part(const std::string& name) {
    const auto found = std::find_if(parts_.begin(), parts_.end(),
                                    [&](const Part& part) { return part.name == name; });
    return found != parts_.end() ? found->numbers
                                 : parts_.emplace_back(Part{name, Numbers(name_)}).numbers;
}

void Answers::ask(const QuestionList& list, World& world, const Questions& about) {
    for (const std::unique_ptr<Question>& question : list) {
        Status status = question->ask(world, about);
        Numbers& numbers = part(question->name());
        if (status.ok()) {
            question->add_to(numbers);
        } else if (status_.ok()) {
            status_ = std::move(status);
        }
    }
}

std::size_t Answers::size() const {
    std::size_t size = 0;
    for (const Part& part : parts_) {
        size += part.numbers.list().size();
    }
    return size;
}

std::string Answers::difference_from(const Answers& other) const {
    if (parts_.size() != other.parts_.size()) {
        return "other questions";
    }
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        const std::vector<double>& own = parts_[k].numbers.list();
        const std::vector<double>& theirs = other.parts_[k].numbers.list();
        std::ostringstream text;
        text.precision(17);
        text << parts_[k].name << ", ";
        for (std::size_t i = 0; i < std::min(own.size(), theirs.size()); ++i) {
            if (std::bit_cast<std::uint64_t>(own[i]) != std::bit_cast<std::uint64_t>(theirs[i])) {
                text << "number " << i << ": " << own[i] << " and " << theirs[i];
                return text.str();
            }
        }
        if (own.size() != theirs.size()) {
            text << own.size() << " numbers and " << theirs.size();
            return text.str();
        }
    }
    return {};
}

Answers answers_of(Scene& scene, const Questions& about) {
    Answers answers(scene);
    answers.ask(scene.world(), about);
    EXPECT_TRUE(answers.status().ok()) << answers.status().text();
    return answers;
}

}  // namespace nearfield::test
