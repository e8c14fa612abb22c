#pragma once

#include "scene.hpp"

#include <nearfield/nearfield.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

/// \file All answers of a world to a set of queries, as numbers that can be compared bit for bit.

namespace nearfield::test {

/// What is asked of a world. The queries name no instances; `ignored` is filled in by ask().
struct Questions {
    std::vector<Pose> poses;
    std::vector<Vector2> points;
    std::vector<Segment> segments;
    std::vector<Sweep> sweeps;
    std::vector<Rectangle> rectangles;
    WorldOptions options;
    ClearanceQuery clearances;
    NearestQuery nearest;
    NearestQuery edges;
    ShapeNearestQuery nearest_of_shape;
    ShapeEdgeQuery edges_of_shape;
    double tolerance = 1e-3;
    double contact_distance = 0.0;
};

/// Random questions about a box.
[[nodiscard]] Questions any_questions(Random& random, const Rectangle& box, int count);

/// The answers of every kind, and where each kind begins.
class Answers {
public:
    /// Names an instance by a number that both worlds to be compared have in common.
    using Name = std::function<double(InstanceHandle)>;

    explicit Answers(Name name) : name_(std::move(name)) {}

    /// Asks everything; on a failure `status` says which call failed.
    void ask(World& world, ShapeHandle shape, const Questions& questions);

    /// Asks for the times of impact while some instances move to their ends.
    void ask_impacts(World& world, PairTable<TimeOfImpactQuery>& table,
                     std::span<const InstanceHandle> moving, std::span<const Pose> ends);

    /// Asks whether each instance shares a point with those that follow it in the list.
    void ask_pairs(World& world, std::span<const InstanceHandle> instances);

    [[nodiscard]] const Status& status() const { return status_; }
    /// Empty if both have the same bits, otherwise the first difference.
    [[nodiscard]] std::string difference_from(const Answers& other) const;
    [[nodiscard]] std::size_t size() const { return numbers_.size(); }

private:
    void begin(std::string part) { parts_.push_back({std::move(part), numbers_.size()}); }
    bool note(Status status, const char* call);
    void add(double number) { numbers_.push_back(number); }
    void add(const Vector2& v) { numbers_.insert(numbers_.end(), {v.x, v.y}); }
    void add(InstanceHandle handle) { add(name_(handle)); }
    void add(const Clearance& clearance);
    void add(const RayHit& hit);
    void add(const InstanceLists& lists);

    void ask_poses(World& world, ShapeHandle shape, const Questions& questions);
    void ask_clearances(World& world, const ClearanceQuery& query, const Questions& questions);
    void ask_nearest(World& world, const NearestQuery& query, const Questions& questions);
    void ask_edges(World& world, ShapeHandle shape, const Questions& questions);
    void ask_rays(World& world, const Questions& questions);
    void ask_casts(World& world, ShapeHandle shape, const Questions& questions);
    void ask_overlaps(World& world, ShapeHandle shape, const Questions& questions);

    struct Part {
        std::string name;
        std::size_t begin;
    };
    Name name_;
    Status status_;
    std::vector<double> numbers_;
    std::vector<Part> parts_;
};

}  // namespace nearfield::test
