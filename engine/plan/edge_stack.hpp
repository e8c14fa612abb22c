#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// \file
/// What can be nearest in a box, sorted out with vectors: compiled for several instruction sets of
/// which the best that the machine has is chosen at run time. In single precision, relative to a
/// place nearby.

namespace nearfield::plan {

/// Edges on a stack, an array for each number. Keeps its memory.
class EdgeStack {
public:
    enum Number : std::uint8_t {
        start_x,
        start_y,
        along_x,  ///< from the start to the end
        along_y,
        inverse,  ///< of the squared length; 0 for an edge of no length
    };
    static constexpr std::size_t numbers = 5;

    void clear() { count_ = 0; }
    void push(const std::array<float, numbers>& edge, std::uint32_t index);
    /// Appends edges first, ..., end - 1 of another stack.
    void append(const EdgeStack& other, std::size_t first, std::size_t end);
    /// Drops all from `count` on.
    void shrink(std::size_t count) { count_ = count; }
    [[nodiscard]] std::size_t size() const { return count_; }

    [[nodiscard]] const float* number(std::size_t number) const { return numbers_[number].data(); }
    [[nodiscard]] float* number(std::size_t number) { return numbers_[number].data(); }
    /// What an edge was pushed with.
    [[nodiscard]] const std::uint32_t* indices() const { return indices_.data(); }
    [[nodiscard]] std::uint32_t* indices() { return indices_.data(); }

    /// Room for so many on top, and for a vector more.
    void reserve(std::size_t more);

private:
    std::array<std::vector<float>, numbers> numbers_;
    std::vector<std::uint32_t> indices_;
    std::size_t count_ = 0;
};

/// A box around its centre.
struct EdgeNode {
    float x = 0.0F;
    float y = 0.0F;
    float half_width = 0.0F;
    float half_height = 0.0F;
};

/// Pushes, of the edges first, ..., end - 1, those that can be nearest somewhere in a box, in the
/// same order. At least one edge. `slack`: what the distances of two edges may be off together.
///
/// The distance to an edge is a convex function: it lies above its tangent at the centre, and what
/// another one exceeds a linear function by is largest at a corner. So an edge whose tangent lies
/// above the distance to some other one at all four corners is nearest nowhere in the box. Held
/// against it are the edges nearest to the centre and to each corner.
void push_near(EdgeStack& edges, std::size_t first, std::size_t end, const EdgeNode& node,
               float slack);

}  // namespace nearfield::plan
