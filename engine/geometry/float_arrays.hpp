#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace nearfield::geometry {

/// A stack of items, each with `kinds` single-precision numbers and an index, as a structure of
/// arrays for SIMD kernels. Allocates one extra vector beyond the last item. Reuses its memory.
template <std::size_t kinds>
class FloatArrays {
public:
    static constexpr std::size_t numbers = kinds;

    void clear() { count_ = 0; }
    void push(const std::array<float, kinds>& item, std::uint32_t index) {
        reserve(1);
        for (std::size_t i = 0; i < kinds; ++i) {
            numbers_[i][count_] = item[i];
        }
        indices_[count_] = index;
        ++count_;
    }
    /// Appends items first, ..., end - 1 of another stack.
    void append(const FloatArrays& other, std::size_t first, std::size_t end) {
        const std::size_t count = end - first;
        reserve(count);
        for (std::size_t i = 0; i < kinds; ++i) {
            std::memcpy(number(i) + count_, other.number(i) + first, count * sizeof(float));
        }
        std::memcpy(indices() + count_, other.indices() + first, count * sizeof(std::uint32_t));
        count_ += count;
    }
    /// Drops items from the top, or adds items already written to the arrays.
    void resize(std::size_t count) { count_ = count; }
    /// Allocates space for `more` items on top plus one vector.
    void reserve(std::size_t more) {
        constexpr std::size_t longest_vector = 16;
        const std::size_t wanted = count_ + more + longest_vector;
        if (wanted > capacity()) {
            const std::size_t larger = wanted + wanted / 2;
            for (std::vector<float>& number : numbers_) {
                number.resize(larger);
            }
            indices_.resize(larger);
        }
    }

    [[nodiscard]] std::size_t size() const { return count_; }
    /// Capacity of each array, in items.
    [[nodiscard]] std::size_t capacity() const { return indices_.size(); }
    [[nodiscard]] const float* number(std::size_t number) const { return numbers_[number].data(); }
    [[nodiscard]] float* number(std::size_t number) { return numbers_[number].data(); }
    /// The index each item was pushed with.
    [[nodiscard]] const std::uint32_t* indices() const { return indices_.data(); }
    [[nodiscard]] std::uint32_t* indices() { return indices_.data(); }

private:
    std::array<std::vector<float>, kinds> numbers_;
    std::vector<std::uint32_t> indices_;
    std::size_t count_ = 0;
};

}  // namespace nearfield::geometry
