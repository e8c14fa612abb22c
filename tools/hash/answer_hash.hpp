#pragma once

#include <nearfield/nearfield.hpp>

#include <tools/hash/answer_fields.hpp>

#include <bit>
#include <concepts>
#include <cstdint>
#include <type_traits>
#include <variant>

namespace nearfield::hash {

/// A 64-bit hash of numbers in order. It differs if any bit of any number does.
class AnswerHash : public AnswerFields<AnswerHash> {
public:
    [[nodiscard]] std::uint64_t value() const { return value_; }

    using AnswerFields::add;
    void add(double number) { mix(std::bit_cast<std::uint64_t>(number)); }
    void add(float number) { mix(std::bit_cast<std::uint32_t>(number)); }
    template <class Number>
    requires(std::integral<Number> || std::is_enum_v<Number>) void add(Number number) {
        mix(static_cast<std::uint64_t>(number));
    }
    void add(const InstanceHandle& h) { add_all(h.index, h.generation); }
    void add(const InstanceLists& lists) { add_all(lists.offsets, lists.instances); }

    /// Everything that an answer states, except how it was found and how long that took.
    void add(const AnyResult& any) {
        std::visit(
            [this](const auto& result) {
                const ResultSummary& summary = result;
                add_all(summary.status.code(), summary.tolerance, summary.error_bound,
                        summary.intersects, summary.cell, summary.regions, summary.technique);
                if (summary.status.ok()) {
                    add_rest(result);
                }
            },
            any);
    }
    template <class Query>
    void add(PairTable<Query>& table) {
        for (const PairRow<Query>& row : table.rows()) {
            const typename Query::Result::Values& values = row;
            add_all(row.a, row.b, row.status, row.intersects, row.error_bound, values,
                    table.points(row));
        }
    }

private:
    template <class Result>
    void add_rest(const Result& result) {
        const typename Result::Values& values = result;
        add(values);
        if constexpr (requires { result.manifold; }) {
            add(result.manifold);
        }
        if constexpr (requires { result.points; }) {
            add(result.points);
        }
        if constexpr (requires { result.samples; }) {
            add(result.samples);
        }
    }
    void add_rest(const DistanceFieldResult& result) { add_field(result); }

    void mix(std::uint64_t word) {
        value_ = std::rotl((value_ ^ word) * 0x9E3779B97F4A7C15, 29) * 0xBF58476D1CE4E5B9;
    }

    std::uint64_t value_ = 0x6E6561726669656C;
};

}  // namespace nearfield::hash
