#include <engine/base/interruption.hpp>
#include <engine/base/prefetch.hpp>
#include <engine/geometry/segment.hpp>
#include <engine/world/ray_hits.hpp>
#include <engine/world/ray_queries.hpp>

#include <algorithm>
#include <bit>

namespace nearfield::world {

using geometry::Vector;

namespace {

/// The number of segments that are followed at the same time.
constexpr std::size_t slots = simd::PathLists::max_paths;
constexpr std::uint32_t fan_out = simd::AabbTree::fan_out;
constexpr std::uint32_t max_groups = simd::PathStep::max_groups;

std::uint32_t groups_of(std::uint32_t boxes) {
    return simd::AabbTree::boxes_over(boxes);
}

void test_boxes(simd::PathStep& step, const double* low_x, std::size_t stride) {
    step.low_x = low_x;
    step.stride = stride;
    step.groups = 1;
    prefetch(low_x);
    prefetch(low_x + stride);
    prefetch(low_x + 2 * stride);
    prefetch(low_x + 3 * stride);
}

void test_edges(simd::PathStep& step, const simd::EdgeArrays& edges, const simd::EdgeRange& range) {
    step.groups = 0;
    step.edges = &edges;
    step.range = range;
    prefetch(edges.start_x + range.first);
    prefetch(edges.start_y + range.first);
    prefetch(edges.end_x + range.first);
    prefetch(edges.end_y + range.first);
}

Vector start_of(const simd::Path& path) {
    return {path.from_x, path.from_y};
}

Vector end_of(const simd::Path& path) {
    return {path.to_x, path.to_y};
}

std::uint32_t first_of(std::uint32_t bits) {
    return static_cast<std::uint32_t>(std::countr_zero(bits));
}

}  // namespace

void RayQueries::begin(const Instances& instances, const WorldFilter& filter) {
    instances_ = &instances;
    filter_ = filter;
    const BoxHierarchy& boxes = instances.boxes();
    if (boxes.has_boxes()) {
        top_ = {boxes.top_level(), 1};
        while (top_.level > 0 && boxes.node_count(top_.level - 1) <= max_groups) {
            --top_.level;
            top_.groups = static_cast<std::uint32_t>(boxes.node_count(top_.level));
        }
    }
}

void RayQueries::reserve(std::size_t count) {
    if (searches_.size() < count) {
        keys_.resize(max_levels * count);
        steps_.resize(count);
        searches_.resize(count);  // last: if memory runs out before, all is done again
        for (std::size_t i = 0; i < count; ++i) {
            searches_[i].keys = &keys_[max_levels * i];
        }
    }
}

void RayQueries::start(Search& search, simd::PathStep& step, const Segment& segment,
                       std::uint32_t number) {
    step.path = {segment.from.x, segment.from.y, segment.to.x, segment.to.y};
    step.inverse = simd::PathInverse(step.path);
    // Of positions along the path.
    search.rounding = rounding_along(start_of(step.path), end_of(step.path));
    search.number = number;
    search.edges = nullptr;
    search.later_count = 0;
    search.has_found = false;
    search.level = top_.level;
    search.first = 0;
    step.margin = instances_->max_rounding() + search.rounding;
    step.bound = 1.0;
    test_boxes(step, instances_->boxes().boxes(search.level, 0).low_x, fan_out);
    step.groups = top_.groups;
    step.keys = search.keys->of.data();
    step.group_stride = BoxHierarchy::doubles_per_node;
}

inline bool RayQueries::enter(Search& search, simd::PathStep& step, std::uint32_t box) const {
    if (search.edges != nullptr) {
        if (search.level == 0) {
            test_edges(step, *search.edges, search.tree->edges_of(box));
            return true;
        }
        search.first = fan_out * box;
        const simd::BoxArrays& below = search.tree->boxes(--search.level, search.first);
        test_boxes(step, below.low_x + search.first, simd::padded(below.count));
        return true;
    }
    if (search.level > 0) {
        search.first = fan_out * box;
        test_boxes(step, instances_->boxes().boxes(--search.level, box).low_x, fan_out);
        return true;
    }
    search.instance = instances_->boxes().name(box);
    if (search.instance == BoxHierarchy::nowhere || !instances_->passes(search.instance, filter_)) {
        return false;
    }
    search.edges = &instances_->edges(search.instance);
    search.tree = &instances_->tree(search.instance);
    // Several groups of boxes at once save the levels above them.
    search.level = search.tree->top_level();
    std::uint32_t groups = 1;
    while (search.level > 0 && groups_of(search.tree->count(search.level - 1)) <= max_groups) {
        groups = groups_of(search.tree->count(--search.level));
    }
    search.first = 0;
    step.margin = search.edges->rounding + search.rounding;
    const simd::BoxArrays& top = search.tree->boxes(search.level, 0);
    for (std::uint32_t group = 1; group < groups; ++group) {
        static_cast<void>(search.tree->boxes(search.level, fan_out * group));
    }
    test_boxes(step, top.low_x, simd::padded(top.count));
    step.groups = groups;
    step.group_stride = fan_out;
    return true;
}

inline std::uint32_t RayQueries::take_later(Search& search, simd::PathStep& step) const {
    while (search.later_count > 0) {
        Later& later = search.later[search.later_count - 1];
        const auto& keys = search.keys[search.later_count - 1].of;
        std::uint32_t nearest = first_of(later.left);
        for (std::uint32_t others = later.left & (later.left - 1); others != 0;
             others &= others - 1) {
            const std::uint32_t other = first_of(others);
            nearest = keys[other] < keys[nearest] ? other : nearest;
        }
        const bool is_near = keys[nearest] <= step.bound;
        later.left &= ~(1U << nearest);
        search.later_count -= later.left == 0 || !is_near ? 1 : 0;
        if (is_near) {
            search.level = later.level;
            if (later.are_instances) {
                search.edges = nullptr;
                step.margin = instances_->max_rounding() + search.rounding;
            }
            return later.first + nearest;
        }
    }
    return BoxHierarchy::nowhere;
}

void RayQueries::take(Search& search, const Found& found) {
    if (all_) {
        all_found_.push_back(found);
    } else if (!search.has_found || found < search.found) {
        search.has_found = true;
        search.found = found;
    }
}

inline void RayQueries::use_edges(Search& search, simd::PathStep& step) {
    const simd::TransformedEdges& edges = *search.edges;
    for (std::uint32_t met = step.met; met != 0; met &= met - 1) {
        const std::uint32_t edge = step.range.first + first_of(met);
        const double parameter =
            geometry::first_meeting(start_of(step.path), end_of(step.path), edges.start(edge),
                                    edges.end(edge), edges.rounding + search.rounding);
        if (parameter <= step.bound &&
            !is_repeated_vertex(edges.start(edge), edges.end(edge), edges.placed.polygon(), edge)) {
            take(search, {parameter, instances_->number(search.instance), search.instance, edge});
            step.bound = all_ ? 1.0 : search.found.parameter;
        }
    }
}

inline std::uint32_t RayQueries::use_boxes(Search& search, const simd::PathStep& step) const {
    if (step.met == 0) {
        return BoxHierarchy::nowhere;
    }
    // Their keys are in place. No branch, which nobody could predict: if no others are left, the
    // next step takes this place.
    Later& later = search.later[search.later_count];
    later.left = step.met & ~(1U << step.nearest);
    later.first = search.first;
    later.level = search.level;
    later.are_instances = search.edges == nullptr;
    search.later_count += later.left != 0 ? 1 : 0;
    return search.first + step.nearest;
}

inline bool RayQueries::go_on(Search& search, simd::PathStep& step, std::uint32_t box) const {
    for (;;) {
        if (box == BoxHierarchy::nowhere) {
            box = take_later(search, step);
            if (box == BoxHierarchy::nowhere) {
                return false;
            }
        }
        if (enter(search, step, box)) {
            step.keys = search.keys[search.later_count].of.data();
            return true;
        }
        box = BoxHierarchy::nowhere;
    }
}

void RayQueries::write(const Search& search, const simd::Path& path, const Found& found,
                       RayHit& hit) const {
    const simd::TransformedEdges& edges = instances_->edges(found.instance);
    write_hit(start_of(path), end_of(path),
              {.start = edges.start(found.edge),
               .end = edges.end(found.edge),
               .rounding = edges.rounding + search.rounding,
               .deviation = instances_->deviation(found.instance),
               .instance = instances_->handle(found.instance),
               .edge = found.edge,
               .parameter = found.parameter},
              hit);
}

void RayQueries::find_first(std::span<const Segment> segments,
                            std::span<const std::uint32_t> numbers, std::span<RayHit> hits) {
    all_ = false;
    reserve(slots);
    if (!instances_->boxes().has_boxes()) {
        for (const std::uint32_t number : numbers) {
            checkpoint();
            hits[number] = {};
        }
        return;
    }
    std::size_t started = 0;
    const auto start_next = [&](std::size_t slot) {
        checkpoint();
        const std::uint32_t number = numbers[started++];
        // Segments that are close are not close in memory.
        const std::uint32_t later = numbers[std::min(started + slots / 2, numbers.size() - 1)];
        prefetch(&segments[later].from);
        prefetch(&segments[later].to);
        prefetch(&hits[number].instance);
        prefetch(&hits[number].edge);
        start(searches_[slot], steps_[slot], segments[number], number);
    };
    simd::PathLists next;
    for (std::uint32_t slot = 0; slot < std::min(slots, numbers.size()); ++slot) {
        start_next(slot);
        next.add(slot, steps_[slot]);
    }
    const auto follow = [&](std::uint32_t slot, std::uint32_t box) {
        Search& search = searches_[slot];
        simd::PathStep& step = steps_[slot];
        if (!go_on(search, step, box)) {
            if (search.has_found) {
                write(search, step.path, search.found, hits[search.number]);
            } else {
                hits[search.number] = {};
            }
            if (started == numbers.size()) {
                return;
            }
            start_next(slot);
        }
        next.add(slot, step);
    };
    while (!next.empty()) {
        const simd::PathLists now = next;
        next.counts = {};
        simd::kernels::take_steps(steps_, now);
        for (const std::uint32_t slot : now.of(simd::PathLists::edges)) {
            use_edges(searches_[slot], steps_[slot]);
            follow(slot, BoxHierarchy::nowhere);
        }
        for (const auto kind : {simd::PathLists::one_group, simd::PathLists::groups}) {
            for (const std::uint32_t slot : now.of(kind)) {
                follow(slot, use_boxes(searches_[slot], steps_[slot]));
            }
        }
    }
}

void RayQueries::find_all(const Segment& segment, std::vector<RayHit>& hits) {
    if (!instances_->boxes().has_boxes()) {
        return;
    }
    all_ = true;
    reserve(1);
    all_found_.clear();
    Search& search = searches_.front();
    simd::PathStep& step = steps_.front();
    start(search, step, segment, 0);
    std::uint32_t box = BoxHierarchy::nowhere;
    do {
        simd::PathLists only;
        only.add(0, step);
        simd::kernels::take_steps(steps_, only);
        if (step.groups == 0) {
            use_edges(search, step);
            box = BoxHierarchy::nowhere;
        } else {
            box = use_boxes(search, step);
        }
    } while (go_on(search, step, box));
    std::sort(all_found_.begin(), all_found_.end());
    for (const Found& found : all_found_) {
        write(search, step.path, found, hits.emplace_back());
    }
}

}  // namespace nearfield::world
