#pragma once

#include <engine/base/interruption.hpp>
#include <engine/localize/lazy_tree.hpp>

#include <cstdint>

namespace nearfield::localize {

/// Branch and bound over pairs of nodes of two trees with the same kind of volume: visits the
/// nearer pair first, and skips pairs whose boxes are farther apart than the best distance so far.
///
/// `Leaves` defines the leaf operations:
///   double squared_bound()                      pairs farther apart than this are irrelevant
///   bool is_leaf(const LazyTree&, index)        true if a node is not to be split
///   void use(index_a, index_b, squared)         a pair of leaves, their boxes that far apart
template <class Leaves>
class PairSearch {
public:
    PairSearch(LazyTree& a, LazyTree& b, Leaves& leaves) : a_(a), b_(b), leaves_(leaves) {}

    void run() { visit(LazyTree::root, LazyTree::root, distance(LazyTree::root, LazyTree::root)); }

    /// The number of node pairs that were pruned.
    [[nodiscard]] std::uint64_t pairs_rejected() const { return pairs_rejected_; }

private:
    [[nodiscard]] double distance(std::uint32_t a, std::uint32_t b) const {
        return squared_distance(a_[a], b_[b], a_.volume());
    }

    void visit(std::uint32_t a, std::uint32_t b, double squared) {
        checkpoint_.step();
        if (squared > leaves_.squared_bound()) {
            ++pairs_rejected_;
            return;
        }
        const bool leaf_a = leaves_.is_leaf(a_, a);
        const bool leaf_b = leaves_.is_leaf(b_, b);
        if (leaf_a && leaf_b) {
            leaves_.use(a, b, squared);
            return;
        }
        // Split the larger node first: both shrink together.
        if (leaf_b || (!leaf_a && a_[a].count >= b_[b].count)) {
            const std::uint32_t half = a_.first_half(a);
            visit_nearer_first(half, b, half + 1, b);
        } else {
            const std::uint32_t half = b_.first_half(b);
            visit_nearer_first(a, half, a, half + 1);
        }
    }

    void visit_nearer_first(std::uint32_t a1, std::uint32_t b1, std::uint32_t a2,
                            std::uint32_t b2) {
        const double first = distance(a1, b1);
        const double second = distance(a2, b2);
        if (first <= second) {
            visit(a1, b1, first);
            visit(a2, b2, second);
        } else {
            visit(a2, b2, second);
            visit(a1, b1, first);
        }
    }

    LazyTree& a_;
    LazyTree& b_;
    Leaves& leaves_;
    std::uint64_t pairs_rejected_ = 0;
    SparseCheckpoint<256> checkpoint_;
};

}  // namespace nearfield::localize
