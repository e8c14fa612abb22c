#pragma once

#include <tools/peers/problem.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nearfield::peers {

/// A library that answers some of the tasks. Shapes are identified by their index among those
/// passed to build(). Only tasks with a non-empty how() are run.
class Peer {
public:
    Peer() = default;
    virtual ~Peer() = default;
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    [[nodiscard]] virtual std::string name() const = 0;
    /// The functions that answer a task, and how the answer differs from nearfield's; empty if the
    /// task is not supported.
    [[nodiscard]] virtual std::string how(Task task) const = 0;
    /// False if an answer is an approximation without a bound.
    [[nodiscard]] virtual bool exact() const { return true; }
    /// False if a field has no sign.
    [[nodiscard]] virtual bool signed_field() const { return true; }

    /// Makes the peer's own geometries and the indices that the task can use, including indices
    /// that the library would otherwise make on first use.
    virtual void build(std::span<const PlacedShape> shapes, Task task) = 0;

    /// For vertex_penetration, boundary_penetration and, unless field() is overridden, field.
    [[nodiscard]] virtual bool is_inside(std::size_t shape, Vector2 point);
    [[nodiscard]] virtual double distance_to_boundary(std::size_t shape, Vector2 point);
    [[nodiscard]] virtual double separation(std::size_t a, std::size_t b);
    [[nodiscard]] virtual bool intersect(std::size_t a, std::size_t b);
    [[nodiscard]] virtual double common_area(std::size_t a, std::size_t b);
    virtual void field(std::size_t shape, const Grid& grid, std::vector<float>& values);
};

/// Runs all queries of a problem on a peer.
void answer(Peer& peer, const Problem& problem, std::span<const PlacedShape> shapes,
            std::vector<Answer>& answers);

[[nodiscard]] std::unique_ptr<Peer> make_geos_peer();
[[nodiscard]] std::unique_ptr<Peer> make_boost_peer();
[[nodiscard]] std::unique_ptr<Peer> make_boost_tree_peer();
[[nodiscard]] std::unique_ptr<Peer> make_cgal_peer();
[[nodiscard]] std::unique_ptr<Peer> make_clipper_peer();
[[nodiscard]] std::unique_ptr<Peer> make_opencv_peer();

}  // namespace nearfield::peers
