#pragma once

#include <nearfield/nearfield.hpp>

#include <tools/hash/answer_fields.hpp>

#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

/// \file
/// Answers as numbers: two of them are the same, bit for bit, if their numbers are.

namespace nearfield::test {

/// The numbers of answers, one after the other.
class Numbers : public hash::AnswerFields<Numbers> {
public:
    /// A number that stands for an instance.
    using Name = std::function<double(InstanceHandle)>;

    Numbers() = default;
    explicit Numbers(Name name) : name_(std::move(name)) {}

    [[nodiscard]] const std::vector<double>& list() const { return list_; }
    [[nodiscard]] bool operator==(const Numbers& other) const { return list_ == other.list_; }
    /// Forgets all numbers, and keeps their memory.
    void clear() { list_.clear(); }

    using AnswerFields::add;
    template <class First, class Second, class... Rest>
    void add(const First& first, const Second& second, const Rest&... rest) {
        add_all(first, second, rest...);
    }
    template <class Number>
    requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>) void add(Number number) {
        list_.push_back(static_cast<double>(number));
    }
    template <class Element>
    void add_each(std::span<Element> elements) {
        for (const auto& element : elements) {
            add(element);
        }
    }
    void add(InstanceHandle handle) {
        if (name_) {
            add(name_(handle));
        } else {
            add(handle.index, handle.generation);
        }
    }
    void add(const InstanceLists& lists) { add_lists(lists.offsets, lists.instances); }
    void add(const RayHits& hits) { add_lists(hits.offsets, hits.hits); }

    /// A row, its records and its manifold.
    template <class Query>
    void add_row(PairTable<Query>& table, const PairRow<Query>& row) {
        add(row.a, row.b, row.status, row.intersects, row.error_bound, row.index, row.point_count);
        if (row.status == StatusCode::ok) {
            add_answer(table, row);
        }
    }
    /// What a row says as the result of its query does.
    template <class Query>
    void add_answer(PairTable<Query>& table, const PairRow<Query>& row) {
        add(row.intersects, row.error_bound);
        add(static_cast<const typename Query::Result::Values&>(row));
        add_each(table.points(row));
        if constexpr (std::is_same_v<Query, ContactQuery>) {
            add_each(table.manifold(row));
        }
    }
    template <class Result>
    void add_answer(const Result& result) {
        add(result.intersects, result.error_bound);
        add(static_cast<const typename Result::Values&>(result));
        if constexpr (requires { result.samples; }) {
            add_each(std::span(result.samples));
        } else if constexpr (requires { result.points; }) {
            add_each(std::span(result.points));
        }
        if constexpr (requires { result.manifold; }) {
            add_each(std::span(result.manifold));
        }
    }

private:
    /// List by list.
    template <class Element>
    void add_lists(const std::vector<std::uint32_t>& offsets,
                   const std::vector<Element>& elements) {
        for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
            add(offsets[i + 1] - offsets[i]);
            add_each(std::span(elements).subspan(offsets[i], offsets[i + 1] - offsets[i]));
        }
    }

    Name name_;
    std::vector<double> list_;
};

/// Those of any answers.
template <class... Answers>
[[nodiscard]] std::vector<double> numbers_of(const Answers&... answers) {
    Numbers numbers;
    (numbers.add(answers), ...);
    return numbers.list();
}

/// All that the rows of a table say.
template <class Query>
[[nodiscard]] std::vector<double> rows_of(PairTable<Query>& table) {
    Numbers numbers;
    for (const PairRow<Query>& row : table.rows()) {
        numbers.add_row(table, row);
    }
    return numbers.list();
}

}  // namespace nearfield::test
