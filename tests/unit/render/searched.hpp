#pragma once

#include <engine/render/pair_outputs.hpp>
#include <engine/render/search_parts.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace nearfield::render {

/// Parts that nothing is known of.
inline PairParts parts_of(const device_input::PairQuestion& question) {
    const device_input::PairSearchKind kind = question.kind();
    return {kind, first_capacities(kind, {}), question.on_device};
}

inline bool is_within(const PairCounts& counts, const PairCounts& most) {
    return std::equal(counts.begin(), counts.end(), most.begin(), std::less_equal<>());
}

/// The instances of a world, by what a search counts of each. It is asked like a device.
class Searched {
public:
    Searched(const device_input::PairQuestion& question, std::vector<PairCounts> instances)
        : question_(question), instances_(std::move(instances)) {}

    [[nodiscard]] std::uint32_t size() const {
        return static_cast<std::uint32_t>(instances_.size());
    }
    [[nodiscard]] std::vector<PairCounts>& instances() { return instances_; }

    [[nodiscard]] PairCounts counts(std::uint32_t first, std::uint32_t end) const {
        PairCounts all{};
        for (std::uint32_t i = first; i < end; ++i) {
            all = sum(all, instances_[i]);
        }
        return all;
    }
    [[nodiscard]] PairCounts counts(const PairPart& part) const {
        return counts(part.first, part.end);
    }

    [[nodiscard]] PairBytes bytes(const PairCounts& capacities) const {
        shaders::SearchPush push{};
        return place_pair_arrays(question_.kind(), size(), capacities, push);
    }
    /// Of the results of a search that stay on the device.
    [[nodiscard]] PairBytes resident_bytes(const PairCounts& capacities) const {
        if (!question_.on_device) {
            return {};
        }
        return {0, PairOutputs::bytes_of_records(capacities[shaders::record_total]),
                PairOutputs::bytes_of_pairs(capacities[shaders::row_total])};
    }
    /// Of all that is there while the parts are searched.
    [[nodiscard]] std::uint64_t bytes(const PairParts& parts) const {
        std::uint64_t scratch = 0;
        std::uint64_t found = 0;
        for (std::size_t i = 0; i < parts.count(); ++i) {
            const PairBytes own = bytes(parts[i].capacities);
            const PairBytes resident = resident_bytes(parts[i].capacities);
            scratch = std::max(scratch, own.scratch);
            found += own.found() + resident.found();
        }
        return scratch + found;
    }

    /// What a device counts in a part: what follows a stage without room is a share of it, and
    /// nothing but the items follows pairs without room.
    [[nodiscard]] PairCounts counted(const PairPart& part) const {
        PairCounts counts = counts_in_order(part);
        if (counts[shaders::pair_total] > part.capacities[shaders::pair_total]) {
            const PairCounts all = counts;
            counts = {};
            counts[shaders::pair_total] = all[shaders::pair_total];
            counts[shaders::item_total] = all[shaders::item_total];
        }
        return counts;
    }

    /// Searches until there is room for everything. Returns how often.
    int search(PairParts& parts, const PairLimits& limits) const {
        static_cast<void>(parts.set_instances(size()));
        for (int times = 1;; ++times) {
            parts.fit(limits);
            expect_all(parts, limits);
            bool had_room = true;
            for (std::size_t i = 0; i < parts.count(); ++i) {
                const PairCounts own = counted(parts[i]);
                if (is_within(own, parts[i].capacities)) {
                    parts.note(i, own);
                } else {
                    parts.grow(i, own, 1.0);
                    had_room = false;
                }
            }
            if (had_room || times == 100) {
                EXPECT_TRUE(had_room) << "there is no end";
                return times;
            }
        }
    }

    /// The parts have each instance once, and fit.
    void expect_all(const PairParts& parts, const PairLimits& limits) const {
        std::uint32_t end = 0;
        PairBytes residents;
        for (std::size_t i = 0; i < parts.count(); ++i) {
            ASSERT_EQ(parts[i].first, end);
            ASSERT_LT(parts[i].first, parts[i].end);
            end = parts[i].end;
            EXPECT_TRUE(is_within(parts[i].needed, parts[i].capacities)) << "part " << i;
            EXPECT_TRUE(is_countable(parts[i].capacities)) << "part " << i;
            EXPECT_LE(bytes(parts[i].capacities).largest(), limits.reach) << "part " << i;
            const PairBytes own = resident_bytes(parts[i].capacities);
            residents.records += own.records;
            residents.rows += own.rows;
        }
        EXPECT_EQ(end, size());
        EXPECT_LE(residents.largest(), limits.reach);
        EXPECT_LE(bytes(parts), limits.memory);
    }

private:
    [[nodiscard]] PairCounts counts_in_order(const PairPart& part) const {
        const PairCounts all = counts(part);
        PairCounts counts{};
        double share = 1.0;
        for (const auto stage : {shaders::pair_total, shaders::item_total, shaders::edge_total,
                                 shaders::point_total, shaders::record_total, shaders::row_total}) {
            counts[stage] = static_cast<std::uint32_t>(share * all[stage]);
            if (counts[stage] > part.capacities[stage]) {
                share *= 1.0 * part.capacities[stage] / counts[stage];
            }
        }
        return counts;
    }

    device_input::PairQuestion question_;
    std::vector<PairCounts> instances_;
};

}  // namespace nearfield::render
