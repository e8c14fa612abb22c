#pragma once

#include <engine/exact/convex_piece.hpp>
#include <engine/exact/placed_edges.hpp>
#include <engine/exact/witnesses.hpp>
#include <engine/exact/work_meter.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::exact {

/// A square of translations of A.
struct ShiftSquare {
    geometry::Vector centre;
    double half = 0.0;       ///< of its side
    double nearest = 0.0;    ///< no translation in it that is shorter separates the shapes
    std::uint32_t list = 0;  ///< of witnesses
};

/// What witnesses say of a square.
enum class ShiftWord : std::uint8_t {
    meet,     ///< after all of its translations the shapes share a point
    alike,    ///< after all translations of a piece of what is left they do, or after none
    touched,  ///< they share one at its centre
    nothing,  ///< nothing
};

/// Squares of translations that have not been settled, the nearest to 0 first. Keeps its memory
/// from pair to pair.
///
/// Whether the shapes share a point changes only where a vertex of one crosses an edge of the
/// other. A witness deep enough in the other shape settles a square at once. A vertex that has just
/// one edge of the other shape in reach (or two, around a corner that points inwards) says it of
/// the part of the square on one side of a line, and that is cut off. If all vertices that have
/// anything in reach are such, nothing changes any more in what is left: it is all alike. A witness
/// that is so far outside that it says nothing of any translation of a square says nothing of its
/// parts either, so each square that is cut leaves a list of the witnesses that its parts have to
/// ask.
class ShiftCover {
public:
    /// All translations up to `longest`. `rounding`: of both shapes; so much apart is touching.
    void begin(const PlacedEdges& a, const PlacedEdges& b, double longest, double rounding,
               WorkMeter& work);

    [[nodiscard]] bool is_empty() const { return squares_.empty(); }
    [[nodiscard]] ShiftSquare take_nearest();
    [[nodiscard]] ShiftWord ask(const ShiftSquare& square);
    /// What is left of the square asked about last. Not empty, unless the word was that they meet.
    [[nodiscard]] const ConvexPiece& rest() const { return rest_; }
    /// And the pieces it is in, after the word that they are alike.
    [[nodiscard]] std::span<const ConvexPiece> pieces() const {
        return std::span(pieces_).first(piece_count_);
    }
    /// Puts back the quarters of that square.
    void cut(const ShiftSquare& square);

private:
    /// What a witness said.
    struct Asked {
        std::uint32_t witness = 0;
        double reach = 0.0;  ///< no translation separates the shapes that differs by less
    };
    /// Consecutive entries of asked_.
    struct List {
        std::size_t first = 0;
        std::size_t count = 0;
    };

    [[nodiscard]] bool is_of_a(std::uint32_t witness) const { return witness < of_a_; }
    /// Where it is after a translation, as the other shape sees it.
    [[nodiscard]] geometry::Vector place_of(std::uint32_t witness,
                                            const geometry::Vector& shift) const;
    /// Cuts off what vertices say of a square; true where nothing changes in what is left.
    [[nodiscard]] bool cut_off_walls(const ShiftSquare& square, double radius);
    /// Cuts off the side of a line through `start` where the vertex is inside.
    void cut_off(const Asked& vertex, const ShiftSquare& square, const geometry::Vector& outwards,
                 const geometry::Vector& start);
    /// False where it has other edges in reach than one, or two around a corner that points
    /// inwards.
    [[nodiscard]] bool cut_off_wall(const Asked& vertex, const ShiftSquare& square, double radius);
    /// Splits what is left wherever a vertex may cross an edge; false where that is in too many
    /// places.
    [[nodiscard]] bool split_rest(const ShiftSquare& square, double radius);
    void split(const geometry::Vector& direction, double at);
    void add_piece(const ConvexPiece& piece);
    /// Appends a witness to the last list, by parts where it is a group too wide for the parts of
    /// such a square.
    void list_parts(const Asked& asked, double half);
    void push(const ShiftSquare& square);

    const PlacedEdges* a_ = nullptr;
    const PlacedEdges* b_ = nullptr;
    WorkMeter* work_ = nullptr;
    double rounding_ = 0.0;
    std::vector<Witness> witnesses_;    // of A, then of B
    std::uint32_t of_a_ = 0;            // how many are A's
    std::vector<std::uint32_t> top_;    // those to begin with
    std::vector<ShiftSquare> squares_;  // a heap
    std::vector<Asked> asked_;
    std::vector<List> lists_;
    std::vector<Asked> left_;          // of the square asked about last
    ConvexPiece rest_;                 // likewise
    std::vector<ConvexPiece> pieces_;  // the first piece_count_ of them; the others keep memory
    std::size_t piece_count_ = 0;
    ConvexPiece beyond_;  // scratch
    ConvexPiece before_;
    std::vector<std::uint32_t> edges_;  // near one vertex; the rest is room
};

}  // namespace nearfield::exact
