#pragma once

#include <tools/peers/problem.hpp>

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nearfield::peers {

/// The functions that answer a task, and how the answer differs from nearfield's.
using Methods = std::map<Task, std::string>;

/// A library that answers the tasks that it has methods for. Shapes are identified by their index
/// among those passed to build().
class Peer {
public:
    Peer(std::string name, Methods methods)
        : name_(std::move(name)), methods_(std::move(methods)) {}
    virtual ~Peer() = default;
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const Methods& methods() const { return methods_; }
    /// How far the library's rounding displaces coordinates, if it computes in float; else 0. Its
    /// answers are compared with nearfield's answers to inputs displaced that far.
    [[nodiscard]] virtual double rounding() const { return 0.0; }

    /// Makes the peer's own geometries and the indices that the task can use, including indices
    /// that the library would otherwise make on first use. `shapes`: the placed instances of the
    /// problem, which must outlive what is asked.
    virtual void build(const Problem& problem, std::span<const PlacedShape> shapes) = 0;

    /// For vertex_penetration, boundary_penetration and field.
    [[nodiscard]] virtual bool is_inside(std::size_t shape, Vector2 point);
    [[nodiscard]] virtual double distance_to_boundary(std::size_t shape, Vector2 point);
    [[nodiscard]] virtual double separation(std::size_t a, std::size_t b);
    [[nodiscard]] virtual bool intersect(std::size_t a, std::size_t b);
    [[nodiscard]] virtual double common_area(std::size_t a, std::size_t b);
    /// Appends a number per pose (distance, or 1 if they intersect), point or segment.
    virtual void ask_world(const Problem& problem, std::vector<double>& numbers);

private:
    std::string name_;
    Methods methods_;
};

/// Runs all queries of a problem on a peer.
void answer(Peer& peer, const Problem& problem, std::span<const PlacedShape> shapes,
            std::vector<Answer>& answers);

[[nodiscard]] std::unique_ptr<Peer> make_geos_peer();
[[nodiscard]] std::unique_ptr<Peer> make_boost_peer();
[[nodiscard]] std::unique_ptr<Peer> make_boost_tree_peer();
[[nodiscard]] std::unique_ptr<Peer> make_cgal_peer();
[[nodiscard]] std::unique_ptr<Peer> make_clipper_peer();
[[nodiscard]] std::unique_ptr<Peer> make_box2d_peer();

}  // namespace nearfield::peers
