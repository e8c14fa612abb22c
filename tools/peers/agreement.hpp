#pragma once

#include <tools/common/scene_runner.hpp>
#include <tools/peers/peer.hpp>
#include <tools/peers/race.hpp>

#include <span>

namespace nearfield::peers {

/// Compares the answers of a peer that is built from `shapes` with nearfield's results, each within
/// the error bound that the result states (plus rounding: a millionth of d), and keeps the largest
/// difference. Throws std::runtime_error where they differ.
/// - vertices: the count, and the greatest depth;
/// - boundary: the greatest depth within the bound, because the samples differ; and every record of
///   nearfield's, by asking the peer about the same point;
/// - separation: the distance;
/// - intersection test: the same answer;
/// - area: within the area of a band as wide as the bound along the boundary of the intersection,
///   whose length is bounded by the lengths of both boundaries near it;
/// - field: each value.
void compare(Peer& peer, const Problem& problem, std::span<const PlacedShape> shapes,
             std::span<const tools::SceneAnswer> results, std::span<const Answer> answers,
             PeerTimes& times);

/// The same of a world: each number to a billionth. A peer that computes in float may differ by as
/// much as nearfield's answers to inputs that are displaced by its rounding do, and one answer in
/// ten thousand may be another: in float, rays can pass between two edges at their common vertex.
void compare_world(const Peer& peer, const Problem& problem, Context& context,
                   const std::vector<double>& numbers, PeerTimes& times);

}  // namespace nearfield::peers
