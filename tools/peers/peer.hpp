#pragma once

#include <tools/peers/problem.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nearfield::peers {

/// A library that answers some of the tasks. Shapes are named by their place among those that it
/// was built from. What a peer does not answer (how() is empty) is not asked of it.
class Peer {
public:
    Peer() = default;
    virtual ~Peer() = default;
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    [[nodiscard]] virtual std::string name() const = 0;
    /// By which of its functions it answers a task, and how that differs from what nearfield
    /// answers; empty: it does not.
    [[nodiscard]] virtual std::string how(Task task) const = 0;
    /// False where an answer is an approximation without a bound.
    [[nodiscard]] virtual bool exact() const { return true; }
    /// False where a field has no sign.
    [[nodiscard]] virtual bool signed_field() const { return true; }

    /// Makes geometries of its own and what indices the task can use. Indices that a library makes
    /// when they are first asked are made then.
    virtual void build(std::span<const PlacedShape> shapes, Task task) = 0;

    /// Of vertex_penetration, boundary_penetration and, unless field() is another, field.
    [[nodiscard]] virtual bool is_inside(std::size_t shape, Vector2 point);
    [[nodiscard]] virtual double distance_to_boundary(std::size_t shape, Vector2 point);
    [[nodiscard]] virtual double separation(std::size_t a, std::size_t b);
    [[nodiscard]] virtual bool intersect(std::size_t a, std::size_t b);
    [[nodiscard]] virtual double common_area(std::size_t a, std::size_t b);
    virtual void field(std::size_t shape, const Grid& grid, std::vector<float>& values);
};

/// Has a peer answer all queries of a problem.
void answer(Peer& peer, const Problem& problem, std::span<const PlacedShape> shapes,
            std::vector<Answer>& answers);

[[nodiscard]] std::unique_ptr<Peer> make_geos_peer();
[[nodiscard]] std::unique_ptr<Peer> make_boost_peer();
[[nodiscard]] std::unique_ptr<Peer> make_boost_tree_peer();
[[nodiscard]] std::unique_ptr<Peer> make_cgal_peer();
[[nodiscard]] std::unique_ptr<Peer> make_clipper_peer();
[[nodiscard]] std::unique_ptr<Peer> make_opencv_peer();

}  // namespace nearfield::peers
