#pragma once

#include "answers.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace nearfield::test {

/// A world to which things happen, and a record of what should be in it. Nothing is read from the
/// world except answers.
class History {
public:
    /// `questions`: what is asked; the world's own stay, as does what they keep.
    History(std::uint64_t seed, std::function<QuestionList()> questions,
            const Settings& settings = {});

    /// Something happens: an addition, a move, another form, a removal, a trim...
    void step();
    /// Empty if all answers equal those of a new context and world, otherwise what differs.
    [[nodiscard]] std::string compare();
    /// What has happened, one letter per step.
    [[nodiscard]] const std::string& log() const { return log_; }
    /// How many pairs of tables were not answered anew, in all comparisons.
    [[nodiscard]] std::uint32_t kept() const { return kept_; }

private:
    struct KnownShape {
        ShapeHandle handle;
        Rings rings;
        bool is_present = true;
    };
    struct Member {
        InstanceHandle handle;
        std::size_t shape;
        WorldInstance instance;
        std::optional<Pose> end = {};  ///< where it moves to while times of impact are asked for
    };
    [[nodiscard]] Rings any_rings();
    [[nodiscard]] Pose any_pose();
    [[nodiscard]] std::size_t any(std::size_t count);
    void add();
    void add_shape();
    void move_one();
    void move_many();
    void deform();
    void replace();
    void remove();
    void remove_shape();
    void set_filter();
    void set_end();
    void glance();
    void check_members();
    void require(const Status& status, const char* call);

    Random random_;
    std::optional<Context> context_;
    std::optional<World> world_;
    std::vector<KnownShape> shapes_;
    std::vector<Member> members_;  // in the order of adding
    Rings asked_;
    ShapeHandle asked_shape_;
    std::function<QuestionList()> make_questions_;
    QuestionList questions_;
    std::uint32_t kept_ = 0;
    bool on_grid_;
    std::string log_;
    std::string failure_;
};

}  // namespace nearfield::test
