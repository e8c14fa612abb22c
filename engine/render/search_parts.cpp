#include <engine/base/status_exception.hpp>
#include <engine/render/instance_buffers.hpp>
#include <engine/render/pair_outputs.hpp>
#include <engine/render/search_memory.hpp>
#include <engine/render/search_parts.hpp>

#include <string>
#include <utility>

namespace nearfield::render {
namespace {

/// Sums end at 2^30 (shaders/sums.glsl), and a thread has a number of 32 bits.
constexpr std::uint32_t max_counted = 1U << 29U;

constexpr PairCounts first_of_points{16384, 16384, 4096, 4096, 1024, 1024};
constexpr PairCounts first_of_tests{16384, 0, 0, 4096, 4096, 1024};

/// Of each stage, where there is no memory for the usual ones.
constexpr std::uint32_t least_capacity = 64;

[[noreturn]] void refuse(const std::string& what, std::uint64_t bytes, const std::string& limit,
                         std::uint64_t most) {
    throw StatusException({StatusCode::too_large, what + " need " + std::to_string(bytes) +
                                                      " bytes on the device" + limit +
                                                      std::to_string(most)});
}

std::uint32_t size_of(const PairPart& part) {
    return part.end - part.first;
}

/// So that not every motion needs more.
PairCounts with_little_more(PairCounts counts) {
    for (std::uint32_t& count : counts) {
        count += count / 8;
    }
    return counts;
}

PairCounts with_more(PairCounts counts) {
    for (std::uint32_t& count : counts) {
        count += count / 4;
    }
    return counts;
}

/// What `few` of `all` have on average.
PairCounts share(PairCounts counts, std::uint32_t few, std::uint32_t all) {
    for (std::uint32_t& count : counts) {
        count = static_cast<std::uint32_t>((std::uint64_t{count} * few + all - 1) / all);
    }
    return counts;
}

}  // namespace

PairCounts sum(const PairCounts& a, const PairCounts& b) {
    PairCounts both{};
    for (std::size_t i = 0; i < both.size(); ++i) {
        both[i] = a[i] + b[i];
    }
    return both;
}

PairCounts first_capacities(const device_input::PairSearchKind& kind,
                            const PairTableCounts& reserve) {
    PairCounts counts =
        kind.goal == device_input::PairGoal::tests ? first_of_tests : first_of_points;
    const auto keep = [&](std::uint32_t stage, std::uint32_t wanted, std::uint64_t otherwise) {
        const std::uint64_t room = wanted > 0 ? wanted : otherwise;
        if (counts[stage] > 0) {
            counts[stage] = static_cast<std::uint32_t>(
                std::clamp<std::uint64_t>(room, counts[stage], max_counted));
        }
    };
    keep(shaders::pair_total, reserve.pairs, 0);
    keep(shaders::record_total, reserve.points, 0);
    keep(shaders::row_total, reserve.rows, 0);
    keep(shaders::item_total, reserve.edge_groups, 4 * std::uint64_t{reserve.pairs});
    keep(shaders::edge_total, reserve.edges, 8 * std::uint64_t{reserve.pairs});
    keep(shaders::point_total, reserve.tested_points, 4 * std::uint64_t{reserve.points});
    if (kind.points == device_input::FoundPoints::compared) {
        counts[shaders::record_total] = 0;
    }
    return counts;
}

bool is_countable(const PairCounts& counts) {
    return counts[shaders::pair_total] < shaders::max_pairs &&
           std::all_of(counts.begin(), counts.end(),
                       [](std::uint32_t count) { return count <= max_counted; });
}

void require_searchable(const PairCounts& counts) {
    if (counts[shaders::pair_total] == shaders::too_many_pairs) {
        throw StatusException(
            {StatusCode::too_large,
             "the world has an instance whose box overlaps with those of some 50,000 others, or "
             "whose pairs have 2^27 edges"});
    }
}

PairCounts grown(const PairCounts& counts, const PairCounts& capacities, double headroom) {
    PairCounts larger = capacities;
    double growth = 1.0;
    for (const auto stage : {shaders::pair_total, shaders::item_total, shaders::edge_total,
                             shaders::point_total, shaders::record_total, shaders::row_total}) {
        const double expected = headroom * growth * counts[stage];
        const double most = headroom == 1.0 && stage == shaders::row_total
                                ? counts[shaders::pair_total]
                                : max_counted;
        if (expected > capacities[stage]) {
            const double least = headroom == 1.0 ? capacities[stage] : 2.0 * capacities[stage];
            const double room = std::min(std::max(least, 1.25 * expected), most);
            larger[stage] = std::max(capacities[stage], static_cast<std::uint32_t>(room));
        }
        if (stage != shaders::pair_total) {
            growth *= std::max(1.0, 1.0 * counts[stage] / std::max(capacities[stage], 1U));
        }
    }
    return larger;
}

Status overflow(const PairCounts& counts, const PairCounts& capacities) {
    constexpr std::array<const char*, shaders::stages_of_pairs> names{
        "edges", "points", "points near or inside", "pairs", "groups of edges", "rows"};
    std::vector<std::string> reasons;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > capacities[i]) {
            reasons.push_back(std::to_string(counts[i]) + ' ' + names[i] + ", and room for " +
                              std::to_string(capacities[i]));
        }
    }
    return {StatusCode::overflow,
            "the recorded commands found more than there was room for; the next ones will have "
            "room for as many, if they are recorded anew",
            std::move(reasons)};
}

std::uint64_t bytes_of_pair_rows(std::uint32_t rows) {
    return (std::uint64_t{rows} + 1) * sizeof(shaders::PairRowData) +
           std::uint64_t{rows} * sizeof(std::uint32_t);
}

std::uint64_t bytes_of_pair_records(const device_input::PairSearchKind& kind,
                                    const PairCounts& capacities) {
    return std::max(kind.reads_points() ? capacities[shaders::record_total] : 0, 1U) *
           sizeof(shaders::FoundPointData);
}

PairBytes place_pair_arrays(const device_input::PairSearchKind& kind, std::uint32_t instances,
                            const PairCounts& capacities, shaders::SearchPush& push) {
    const auto [edges, points, found, pairs, items, rows] = capacities;
    push.instances = instances;
    ScratchLayout layout;
    const std::uint32_t found_pairs = kind.are_given() ? 0 : pairs;
    push.boxes = layout.units(units_of_boxes(instances));
    push.lists = layout.units(shaders::units_of_list * std::uint64_t{instances});
    push.pairs = layout.words(2 * std::uint64_t{found_pairs});
    push.directions = layout.units(shaders::units_of_direction * std::uint64_t{pairs});
    push.summaries = layout.units(2 * std::uint64_t{pairs});
    push.verdicts = layout.words(found_pairs);
    push.frames = layout.units(found_pairs);
    push.first_directions = layout.sums(items);
    // Two sums for each block of instances, which begin whole units.
    constexpr std::uint64_t more = std::uint64_t{8} * shaders::search_block;
    const std::uint64_t both = 2 * std::uint64_t{instances} + more;
    layout.add_stages(items, edges, points, std::max<std::uint64_t>(pairs, both), push);
    return {layout.bytes(), bytes_of_pair_records(kind, capacities), bytes_of_pair_rows(rows)};
}

PairParts::PairParts(const device_input::PairSearchKind& kind, const PairCounts& first,
                     bool is_resident)
    : kind_(kind), is_resident_(is_resident), first_capacities_(first), parts_(1) {
    PairPart& all = parts_.front();
    all.capacities = first_capacities_;
    for (std::size_t i = 0; i < all.needed.size(); ++i) {
        all.needed[i] = std::min(least_capacity, first_capacities_[i]);
    }
}

bool PairParts::set_instances(std::uint32_t count) {
    if (parts_.back().end == count) {
        return false;
    }
    while (parts_.size() > 1 && parts_.back().first >= count) {
        parts_.pop_back();
    }
    PairPart& last = parts_.back();
    if (count < last.end) {
        last.needed = share(last.needed, count - last.first, size_of(last));
        last.counted = {};
    }
    last.end = count;
    return true;
}

bool PairParts::set_given(const PairCounts& counts, const PairCounts& room) {
    const std::uint32_t end = counts[shaders::pair_total];
    bool are_others = parts_.back().end != end;
    if (parts_.size() > 1) {
        if (!are_others) {
            return false;
        }
        PairPart all = parts_.front();
        for (std::size_t i = 1; i < parts_.size(); ++i) {
            all.needed = sum(all.needed, parts_[i].needed);
        }
        all.needed = share(all.needed, end, parts_.back().end);
        all.capacities = with_much_more(all.needed);
        parts_.assign(1, all);
    }
    PairPart& part = parts_.front();
    part.end = end;
    part.counted = counts;
    for (std::size_t stage = 0; stage < counts.size(); ++stage) {
        part.needed[stage] = std::max(part.needed[stage], counts[stage]);
        const std::uint32_t least = std::max(counts[stage], room[stage]);
        are_others = are_others || part.capacities[stage] < least;
        part.capacities[stage] = std::max(part.capacities[stage], least);
    }
    return are_others;
}

void PairParts::grow(std::size_t i, const PairCounts& counts, double headroom) {
    PairPart& part = parts_[i];
    for (std::size_t stage = 0; stage < counts.size(); ++stage) {
        part.needed[stage] = std::max(part.needed[stage], counts[stage]);
    }
    part.counted = counts;
    part.capacities = grown(counts, part.capacities, headroom);
}

PairBytes PairParts::bytes_of(const PairCounts& capacities) const {
    shaders::SearchPush push{};
    return place_pair_arrays(kind_, parts_.back().end, capacities, push);
}

PairBytes PairParts::bytes_of_all() const {
    PairBytes all;
    for (const PairPart& part : parts_) {
        const PairBytes own = bytes_of(part.capacities);
        all.scratch = std::max(all.scratch, own.scratch);
        all.records += own.records;
        all.rows += own.rows;
    }
    return all;
}

PairBytes PairParts::bytes_of_residents(const PairCounts& capacities) const {
    if (!is_resident_) {
        return {};
    }
    return {0, PairOutputs::bytes_of_records(capacities[shaders::record_total]),
            PairOutputs::bytes_of_pairs(capacities[shaders::row_total])};
}

PairBytes PairParts::bytes_of_all_residents() const {
    PairBytes all;
    for (const PairPart& part : parts_) {
        const PairBytes own = bytes_of_residents(part.capacities);
        all.records += own.records;
        all.rows += own.rows;
    }
    return all;
}

bool PairParts::fits(const PairCounts& capacities, const PairLimits& limits) const {
    return is_countable(capacities) && bytes_of(capacities).largest() <= limits.reach;
}

/// Also room for what is not known yet.
PairCounts PairParts::with_much_more(const PairCounts& counts) const {
    PairCounts more = with_more(counts);
    for (std::size_t i = 0; i < more.size(); ++i) {
        more[i] = std::max(more[i], first_capacities_[i]);
    }
    return more;
}

bool PairParts::join(const PairLimits& limits) {
    if (parts_.size() < 2) {
        return false;
    }
    const auto with_next = [this](std::size_t i) {
        return sum(parts_[i].needed, parts_[i + 1].needed);
    };
    std::size_t least = 0;
    for (std::size_t i = 1; i + 1 < parts_.size(); ++i) {
        const bool is_less = bytes_of(with_next(i)).scratch < bytes_of(with_next(least)).scratch;
        least = is_less ? i : least;
    }
    const PairCounts both = with_next(least);
    const PairCounts twice = sum(both, both);
    const PairBytes all = bytes_of_all();
    const PairBytes more = bytes_of(twice);
    const std::uint64_t memory = std::max(all.scratch, more.scratch) + all.found() + more.found() +
                                 bytes_of_all_residents().found() +
                                 bytes_of_residents(twice).found();
    if (!fits(twice, limits) || memory > limits.memory) {
        return false;
    }
    parts_[least] = {parts_[least].first, parts_[least + 1].end, with_much_more(both), both, both};
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(least) + 1);
    return true;
}

/// Makes as few pieces of a part as should fit. The pairs of instances may be uneven: pieces that
/// do not fit are divided again, once they were counted.
void PairParts::divide(std::size_t i, const PairLimits& limits) {
    const PairPart whole = parts_[i];
    const std::uint32_t size = size_of(whole);
    if (size == 1) {
        const PairBytes bytes = bytes_of(whole.needed);
        refuse(kind_.are_given() ? "the points of one query" : "the pairs of one instance",
               bytes.largest(), " in one buffer, of which shaders reach ", limits.reach);
    }
    std::uint32_t pieces = 2;
    while (pieces < size && !fits(with_more(share(whole.needed, 1, pieces)), limits)) {
        pieces = std::min(pieces + pieces / 2, size);
    }
    const PairCounts needed = share(whole.needed, 1, pieces);
    std::vector<PairPart> all;
    for (std::uint32_t piece = 0; piece < pieces; ++piece) {
        const auto end_of = [&](std::uint64_t pieces_before) {
            return whole.first + static_cast<std::uint32_t>(pieces_before * size / pieces);
        };
        all.push_back({end_of(piece), end_of(piece + 1), with_much_more(needed), needed, {}});
    }
    const auto place = parts_.begin() + static_cast<std::ptrdiff_t>(i);
    parts_.insert(parts_.erase(place), all.begin(), all.end());
}

/// Leaves each part no more than `room(needed)`. Returns whether any had more.
template <class Room>
bool PairParts::shrink(const Room& room) {
    bool had_more = false;
    for (PairPart& part : parts_) {
        const PairCounts most = room(part.needed);
        for (std::size_t stage = 0; stage < most.size(); ++stage) {
            had_more = had_more || part.capacities[stage] > most[stage];
            part.capacities[stage] = std::min(part.capacities[stage], most[stage]);
        }
    }
    return had_more;
}

/// Leaves each part the needs that are certain. Returns whether any had others.
bool PairParts::forget_estimates() {
    bool had_others = false;
    for (PairPart& part : parts_) {
        had_others = had_others || part.needed != part.counted;
        part.needed = part.counted;
    }
    return had_others;
}

void PairParts::fit(const PairLimits& limits) {
    for (std::size_t i = 0; i < parts_.size();) {
        PairPart& part = parts_[i];
        if (!fits(part.capacities, limits)) {
            part.capacities = with_little_more(part.needed);
        }
        if (size_of(part) == 1 && !fits(part.capacities, limits)) {
            part.capacities = part.needed;
        }
        if (size_of(part) == 1 && !fits(part.capacities, limits)) {
            part.capacities = part.needed = part.counted;
        }
        if (fits(part.capacities, limits)) {
            ++i;
        } else {
            divide(i, limits);
        }
    }
    fit_memory(limits);
}

/// Smaller parts need less scratch memory, and leave as much as larger ones.
void PairParts::fit_memory(const PairLimits& limits) {
    for (;;) {
        const PairBytes all = bytes_of_all();
        const PairBytes residents = bytes_of_all_residents();
        const std::uint64_t found = all.found() + residents.found();
        const bool is_reached = residents.largest() <= limits.reach;
        if (is_reached && all.scratch + found <= limits.memory) {
            return;
        }
        if (shrink(with_little_more)) {
            continue;
        }
        const auto largest = std::max_element(
            parts_.begin(), parts_.end(), [this](const PairPart& a, const PairPart& b) {
                return bytes_of(a.capacities).scratch < bytes_of(b.capacities).scratch;
            });
        const std::uint64_t least_scratch = bytes_of({}).scratch;
        if (is_reached && size_of(*largest) > 1 && least_scratch + found <= limits.memory) {
            divide(static_cast<std::size_t>(largest - parts_.begin()), limits);
        } else if (shrink([](const PairCounts& needed) { return needed; }) || forget_estimates()) {
            continue;
        } else if (!is_reached) {
            refuse("the pairs that stay", residents.largest(),
                   " in one buffer, of which shaders reach ", limits.reach);
        } else {
            refuse(kind_.are_given() ? "the points of the batch" : "the pairs of the world",
                   all.scratch + found, "; Settings::memory_limit is ", limits.memory);
        }
    }
}

}  // namespace nearfield::render
