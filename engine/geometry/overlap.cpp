#include <engine/base/interruption.hpp>
#include <engine/geometry/chain_writer.hpp>
#include <engine/geometry/containment.hpp>
#include <engine/geometry/hierarchy.hpp>
#include <engine/geometry/overlap.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace nearfield::geometry {
namespace {

/// Refinement stops once this many pairs of boxes still overlap. Smaller boxes do not separate
/// boundaries this entangled, and neither time nor memory may grow with the square of the edges.
/// The chains are then coarser, but still valid.
constexpr std::size_t max_pairs = std::size_t{1} << 18U;

/// A node of A and the range of its list of overlapping nodes of B. A node with no overlap is
/// settled: it is not refined any further.
struct Candidate {
    Node node;
    std::size_t list_begin = 0;
    std::size_t list_end = 0;

    [[nodiscard]] bool settled() const { return list_begin == list_end; }
};

/// One level of both trees.
struct Level {
    std::vector<Candidate> candidates;  ///< of A, in order along its rings, settled ones included
    std::vector<Node> nodes;            ///< of B
    std::vector<std::uint32_t> lists;   ///< indices into `nodes`

    void clear() {
        candidates.clear();
        nodes.clear();
        lists.clear();
    }
};

/// The working memory of a descent. Kept per thread, so that the steady state allocates nothing;
/// max_pairs bounds its size.
struct Scratch {
    Level level;
    Level next;
    /// The range of a B node's halves among the nodes of the next level.
    struct Halves {
        std::uint32_t begin = 0;
        std::uint32_t count = 0;
    };
    std::vector<Halves> halves;
    std::vector<Candidate> of_b;  // the same for B, if both are requested
    std::vector<Candidate> unordered;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order;  // first edge, index above
    Containment containment;
};

Scratch& thread_scratch() {
    thread_local Scratch scratch;
    return scratch;
}

/// The result of a descent for one boundary.
struct Boundary {
    const std::vector<Candidate>& candidates;  ///< all of it, in order
    const TransformedPolygon& own;
    const TransformedPolygon& other;
    Box box_of_other;
    double margin = 0.0;

    [[nodiscard]] bool near_other(const Box& box) const {
        return boxes_meet(box, box_of_other, margin);
    }
};

/// Descends both trees together, level by level, so that no box is computed twice.
class Descent {
public:
    Descent(const TransformedPolygon& a, const TransformedPolygon& b, const OverlapOptions& options)
        : volume_(options.volume),
          tree_a_(a, options.height, options.volume),
          tree_b_(b, options.height, options.volume),
          root_a_(tree_a_.root()),
          root_b_(tree_b_.root()),
          level_(thread_scratch().level),
          next_(thread_scratch().next),
          halves_(thread_scratch().halves) {
        // A settled chain is then clear of B's boundary by more than rounding, so one of its
        // vertices decides for the whole chain.
        margin_ =
            options.grow + placement_rounding(a, root_a_.box) + placement_rounding(b, root_b_.box);
        level_.clear();
        level_.nodes.push_back(root_b_);
        if (volumes_meet(root_a_, root_b_, margin_, volume_)) {
            level_.lists.push_back(0);
        } else {
            ++pairs_rejected_;
        }
        level_.candidates.push_back({root_a_, 0, level_.lists.size()});
    }

    /// Refines while some node splits and the number of pairs allows it. `both_ways`: also keeps
    /// the candidates of B, as box overlap is symmetric.
    void run(bool both_ways) {
        std::vector<Candidate>& found = thread_scratch().unordered;
        found.clear();
        while (level_.lists.size() <= max_pairs && split_nodes()) {
            for (std::size_t i = 0; both_ways && i < level_.nodes.size(); ++i) {
                if (halves_[i].count == 0) {
                    found.push_back({level_.nodes[i], 0, 0});
                }
            }
            split_candidates();
            std::swap(level_, next_);
        }
        if (!both_ways) {
            return;
        }
        const std::size_t settled = found.size();
        for (const Node& node : level_.nodes) {
            found.push_back({node, 0, 0});
        }
        for (const std::uint32_t index : level_.lists) {
            found[settled + index].list_end = 1;
        }
        order_of_b();
    }

    /// The resulting boundary of A, in order.
    [[nodiscard]] Boundary of_a() const {
        return {level_.candidates, tree_a_.polygon(), tree_b_.polygon(), root_b_.box, margin_};
    }
    /// The same for B. Precondition: run(true).
    [[nodiscard]] Boundary of_b() const {
        return {thread_scratch().of_b, tree_b_.polygon(), tree_a_.polygon(), root_a_.box, margin_};
    }
    [[nodiscard]] Effort effort() const {
        return {tree_a_.nodes_evaluated() + tree_b_.nodes_evaluated(), pairs_rejected_};
    }

private:
    /// Creates the next level's nodes of B from those that still overlap a candidate. Returns false
    /// if nothing on either side splits any more.
    bool split_nodes() {
        next_.clear();
        bool any = false;
        halves_.assign(level_.nodes.size(), {});
        for (const Candidate& candidate : level_.candidates) {
            any = any || (!candidate.settled() && tree_a_.splits(candidate.node));
        }
        for (const std::uint32_t index : level_.lists) {
            Scratch::Halves& halves = halves_[index];
            if (halves.count != 0) {
                continue;
            }
            halves.begin = static_cast<std::uint32_t>(next_.nodes.size());
            const Node& node = level_.nodes[index];
            if (tree_b_.splits(node)) {
                const std::array<Node, 2> both = tree_b_.halves(node);
                next_.nodes.insert(next_.nodes.end(), both.begin(), both.end());
                halves.count = 2;
                any = true;
            } else {
                next_.nodes.push_back(node);
                halves.count = 1;
            }
        }
        return any;
    }

    /// Sorts the candidates of B by edge: they arrive level by level.
    static void order_of_b() {
        Scratch& scratch = thread_scratch();
        scratch.order.clear();
        for (const Candidate& candidate : scratch.unordered) {
            scratch.order.emplace_back(candidate.node.first,
                                       static_cast<std::uint32_t>(scratch.order.size()));
        }
        std::sort(scratch.order.begin(), scratch.order.end());
        scratch.of_b.clear();
        for (const auto& [first, place] : scratch.order) {
            scratch.of_b.push_back(scratch.unordered[place]);
        }
    }

    void split_candidates() {
        SparseCheckpoint<64> checkpoint;
        for (const Candidate& candidate : level_.candidates) {
            checkpoint.step();
            if (candidate.settled()) {
                next_.candidates.push_back({candidate.node, 0, 0});
            } else if (tree_a_.splits(candidate.node)) {
                for (const Node& half : tree_a_.halves(candidate.node)) {
                    pass_on(candidate, half);
                }
            } else {
                pass_on(candidate, candidate.node);
            }
        }
    }

    /// Adds a candidate to the next level, with the halves of its parent's nodes that it overlaps.
    void pass_on(const Candidate& parent, const Node& node) {
        const std::size_t list_begin = next_.lists.size();
        for (std::size_t i = parent.list_begin; i < parent.list_end; ++i) {
            const Scratch::Halves halves = halves_[level_.lists[i]];
            for (std::uint32_t n = halves.begin; n < halves.begin + halves.count; ++n) {
                if (volumes_meet(node, next_.nodes[n], margin_, volume_)) {
                    next_.lists.push_back(n);
                } else {
                    ++pairs_rejected_;
                }
            }
        }
        next_.candidates.push_back({node, list_begin, next_.lists.size()});
    }

    BoundingVolume volume_;
    Hierarchy tree_a_;
    Hierarchy tree_b_;
    Node root_a_;
    Node root_b_;
    Level& level_;
    Level& next_;
    std::vector<Scratch::Halves>& halves_;
    double margin_ = 0.0;
    std::uint64_t pairs_rejected_ = 0;
};

/// Determines whether settled chains lie inside the other shape, in order along a boundary. The
/// answer can change only where the boundaries may cross, so it carries over from one chain to the
/// next. A first walk collects the points to test; all are tested together; a second walk reads the
/// answers.
class SettledChains {
public:
    explicit SettledChains(const Boundary& boundary)
        : boundary_(boundary), containment_(thread_scratch().containment) {
        containment_.clear();
    }

    /// Call where a chain that may cross the other boundary precedes the next settled one.
    void forget() { known_ = false; }

    void ask(std::uint32_t ring, std::uint32_t first, const Box& box) {
        if (is_new(ring) && boundary_.near_other(box)) {
            containment_.ask(boundary_.own.vertex(first));
        }
    }

    /// Call between the two walks.
    void answer() {
        containment_.answer(boundary_.other);
        known_ = false;
    }

    bool inside(std::uint32_t ring, const Box& box) {
        if (is_new(ring)) {
            inside_ = boundary_.near_other(box) && containment_.inside(asked_++);
        }
        return inside_;
    }

private:
    /// True if the chain before does not determine the answer.
    bool is_new(std::uint32_t ring) {
        const bool is_new = !known_ || ring != ring_;
        ring_ = ring;
        known_ = true;
        return is_new;
    }

    const Boundary& boundary_;
    Containment& containment_;
    std::size_t asked_ = 0;
    std::uint32_t ring_ = 0;
    bool known_ = false;
    bool inside_ = false;
};

/// Calls `use(ring, first, count, box)` for each ring's part of a node. A node of several rings
/// remains where the rings are all clear of B, or where refinement stopped early.
template <class Use>
void for_each_part(const Node& node, const TransformedPolygon& a, const Use& use) {
    if (node.rings == 1) {
        use(node.ring, node.first, node.count, node.box);
        return;
    }
    const Polygon& polygon = a.polygon();
    for (std::uint32_t ring = node.ring; ring < node.ring + node.rings; ++ring) {
        const std::uint32_t first = polygon.ring_begin(ring);
        const std::uint32_t count = polygon.ring_end(ring) - first;
        use(ring, first, count, a.chain_box(ring, first, count));
    }
}

/// Appends the chains of a boundary that may lie inside the other shape.
void append_chains_in_volume(const Boundary& boundary, std::vector<Chain>& chains) {
    SettledChains settled(boundary);
    const auto walk = [&](const auto& use_open, const auto& use_settled) {
        for (const Candidate& candidate : boundary.candidates) {
            if (!candidate.settled()) {
                settled.forget();
                for_each_part(candidate.node, boundary.own, use_open);
            } else if (candidate.node.rings == 1 || boundary.near_other(candidate.node.box)) {
                for_each_part(candidate.node, boundary.own, use_settled);
            }
        }
    };
    walk([](auto...) {}, [&](std::uint32_t ring, std::uint32_t first, std::uint32_t,
                             const Box& box) { settled.ask(ring, first, box); });
    settled.answer();
    ChainWriter writer(boundary.own.polygon(), chains);
    walk([&](auto... part) { writer.append(part...); },
         [&](std::uint32_t ring, std::uint32_t first, std::uint32_t count, const Box& box) {
             if (settled.inside(ring, box)) {
                 writer.append(ring, first, count, box);
             }
         });
    writer.finish_ring();
}

}  // namespace

Effort chains_near_boundary(const TransformedPolygon& a, const TransformedPolygon& b,
                            const OverlapOptions& options, std::vector<Chain>& chains) {
    Descent descent(a, b, options);
    descent.run(false);
    ChainWriter writer(a.polygon(), chains);
    for (const Candidate& candidate : descent.of_a().candidates) {
        if (!candidate.settled()) {
            for_each_part(candidate.node, a, [&](auto... part) { writer.append(part...); });
        }
    }
    writer.finish_ring();
    return descent.effort();
}

Effort chains_in_volume(const TransformedPolygon& a, const TransformedPolygon& b,
                        const OverlapOptions& options, std::vector<Chain>& chains) {
    Descent descent(a, b, options);
    descent.run(false);
    append_chains_in_volume(descent.of_a(), chains);
    return descent.effort();
}

Effort chains_in_each_other(const TransformedPolygon& a, const TransformedPolygon& b,
                            const OverlapOptions& options, std::vector<Chain>& of_a,
                            std::vector<Chain>& of_b) {
    Descent descent(a, b, options);
    descent.run(true);
    append_chains_in_volume(descent.of_a(), of_a);
    append_chains_in_volume(descent.of_b(), of_b);
    return descent.effort();
}

}  // namespace nearfield::geometry
