#include <tools/drawing/contour.hpp>

#include <array>
#include <utility>

namespace nearfield::tools {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// Marching squares. A crossing is identified by its lattice edge: the edge from node n to the
/// right is 2n, the edge to the next row 2n + 1. Each crossing is linked to at most two others, one
/// in each cell beside its edge.
class Tracer {
public:
    Tracer(const Lattice& lattice, double level)
        : lattice_(lattice),
          level_(level),
          links_(2 * lattice.width * lattice.height, {none, none}) {}

    std::vector<std::vector<Vector2>> trace() {
        for (std::size_t row = 0; row + 1 < lattice_.height; ++row) {
            for (std::size_t column = 0; column + 1 < lattice_.width; ++column) {
                link_cell(column, row);
            }
        }
        // Open lines first, from an end; the remaining lines are closed.
        for (const bool closed : {false, true}) {
            for (std::size_t crossing = 0; crossing < links_.size(); ++crossing) {
                if (links_[crossing][0] != none && (closed || links_[crossing][1] == none)) {
                    follow(crossing);
                }
            }
        }
        return std::move(lines_);
    }

private:
    [[nodiscard]] bool above(std::size_t column, std::size_t row) const {
        return lattice_.at(column, row) >= level_;
    }

    void link(std::size_t from, std::size_t to) {
        links_[from][links_[from][0] == none ? 0 : 1] = to;
        links_[to][links_[to][0] == none ? 0 : 1] = from;
    }

    void link_cell(std::size_t column, std::size_t row) {
        const bool corners[4] = {above(column, row), above(column + 1, row),
                                 above(column + 1, row + 1), above(column, row + 1)};
        const std::size_t node = row * lattice_.width + column;
        const std::size_t edges[4] = {2 * node, 2 * (node + 1) + 1, 2 * (node + lattice_.width),
                                      2 * node + 1};
        std::size_t crossed[4] = {};
        std::size_t count = 0;
        for (std::size_t side = 0; side < 4; ++side) {
            if (corners[side] != corners[(side + 1) % 4]) {
                crossed[count++] = edges[side];
            }
        }
        if (count == 2) {
            link(crossed[0], crossed[1]);
        } else if (count == 4) {
            // A saddle: the value at the centre decides which two opposite corners are connected.
            const double middle =
                (lattice_.at(column, row) + lattice_.at(column + 1, row) +
                 lattice_.at(column + 1, row + 1) + lattice_.at(column, row + 1)) /
                4.0;
            const bool first_corner_alone = (middle >= level_) != corners[0];
            link(edges[0], edges[first_corner_alone ? 3 : 1]);
            link(edges[2], edges[first_corner_alone ? 1 : 3]);
        }
    }

    [[nodiscard]] Vector2 point(std::size_t crossing) const {
        const std::size_t node = crossing / 2;
        const std::size_t column = node % lattice_.width;
        const std::size_t row = node / lattice_.width;
        const bool down = crossing % 2 == 1;
        const double from = lattice_.at(column, row);
        const double to = lattice_.at(column + (down ? 0 : 1), row + (down ? 1 : 0));
        const double along = (level_ - from) / (to - from);
        return {static_cast<double>(column) + (down ? 0.0 : along),
                static_cast<double>(row) + (down ? along : 0.0)};
    }

    /// Follows the links from crossing to crossing and removes them.
    void follow(std::size_t crossing) {
        std::vector<Vector2> line;
        std::size_t next = crossing;
        while (next != none) {
            const std::size_t here = next;
            line.push_back(point(here));
            next = links_[here][0] != none ? links_[here][0] : links_[here][1];
            if (next != none) {
                unlink(here, next);
                unlink(next, here);
            }
        }
        lines_.push_back(std::move(line));
    }

    void unlink(std::size_t from, std::size_t to) {
        auto& [first, second] = links_[from];
        if (first == to) {
            first = second;
        }
        second = none;
    }

    const Lattice& lattice_;
    double level_;
    std::vector<std::array<std::size_t, 2>> links_;
    std::vector<std::vector<Vector2>> lines_;
};

}  // namespace

std::vector<std::vector<Vector2>> contour_lines(const Lattice& lattice, double level) {
    return Tracer(lattice, level).trace();
}

}  // namespace nearfield::tools
