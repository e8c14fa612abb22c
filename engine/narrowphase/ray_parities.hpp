#pragma once

#include <engine/simd/crossing_kernels.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace nearfield::narrowphase {

/// The parities of the crossings of many rays with one boundary: answered at once where the tree
/// tells quickly, and otherwise all together. Reuses its memory.
class RayParities {
public:
    /// Stands for an answer, which is known after answer().
    using Ticket = std::uint32_t;
    static constexpr Ticket even = 0;
    static constexpr Ticket odd = 1;
    [[nodiscard]] static Ticket known(bool is_odd) { return is_odd ? odd : even; }

    /// Forgets all rays. The tree's edges and boxes must stay as long as rays are asked for.
    void begin(const simd::AabbTree& tree);

    /// As simd::kernels::crossings_are_odd() for the ray to the right. The ticket is `even` or
    /// `odd`, or stands for an answer to come.
    [[nodiscard]] Ticket ask(double x, double y);
    /// As simd::kernels::crossings_of_others_are_odd(); the same `rounding` in all calls.
    [[nodiscard]] Ticket ask(const simd::kernels::Ray& ray, const simd::kernels::LineOfEdge& line);

    /// Answers what is still to come.
    void answer();
    /// Precondition: `ticket` was known at once, or answer() has been called since.
    [[nodiscard]] bool is_odd(Ticket ticket) const { return parities_[ticket] != 0; }

private:
    // Several times what a tree takes that divides the edges well.
    static constexpr std::uint32_t most_visits = 24;

    /// Rays of one kind.
    struct Batch {
        std::vector<double> x;
        std::vector<double> y;
        std::vector<double> along_x;  // empty for rays that start on no edge
        std::vector<double> along_y;
        std::vector<Ticket> tickets;

        void clear();
    };

    template <class Search>
    [[nodiscard]] Ticket find(const Search& search, Batch& batch, const simd::kernels::Ray& ray);
    void answer(const Batch& batch, bool upwards);

    std::optional<simd::AabbTree> tree_;
    simd::SearchTrials trials_;
    double rounding_ = 0.0;
    Batch from_points_;
    std::array<Batch, 2> from_edges_;           // to the right, upwards
    std::vector<std::uint8_t> parities_{0, 1};  // by ticket
    std::vector<std::uint8_t> found_;           // scratch
    simd::DivisionMemory division_;
};

}  // namespace nearfield::narrowphase
