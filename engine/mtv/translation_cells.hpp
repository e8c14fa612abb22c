#pragma once

#include <engine/mtv/convex_piece.hpp>
#include <engine/mtv/overlap_certificates.hpp>
#include <engine/mtv/work_budget.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nearfield::mtv {

/// A square cell in the space of translations of A.
struct TranslationCell {
    geometry::Vector centre;
    double half = 0.0;       ///< half its side
    double nearest = 0.0;    ///< lower bound on the length of its separating translations
    std::uint32_t list = 0;  ///< of certificates
};

/// The state of a cell as decided by certificates.
enum class CellState : std::uint8_t {
    overlapping,  ///< the shapes overlap after all of its translations
    uniform,   ///< per piece of the rest, the shapes overlap after all translations or after none
    touching,  ///< the shapes overlap at its centre
    unknown,   ///< undecided
};

/// The undecided cells of translation space, nearest to 0 first. Reuses its memory between pairs.
///
/// Whether the shapes overlap changes only where a vertex of one crosses an edge of the other. A
/// certificate deep enough in the other shape decides a cell at once. A vertex with exactly one
/// edge of the other shape in reach (or two, around a reflex corner) decides the part of the cell
/// on one side of a line, and that part is cut off. If this holds for all vertices that have
/// anything in reach, the rest of the cell is uniform. A certificate too far outside to decide any
/// translation of a cell decides none of its parts either, so each split cell keeps a list of the
/// certificates that matter to its parts.
class TranslationSearch {
public:
    /// Starts with all translations up to `longest`. `rounding`: of both shapes; gaps up to this
    /// count as touching.
    void begin(const simd::TransformedEdges& a, const simd::TransformedEdges& b, double longest,
               double rounding, WorkBudget& work);

    [[nodiscard]] bool is_empty() const { return squares_.empty(); }
    [[nodiscard]] TranslationCell take_nearest();
    [[nodiscard]] CellState ask(const TranslationCell& square);
    /// The rest of the last cell queried. Not empty unless its state was `overlapping`.
    [[nodiscard]] const ConvexPiece& rest() const { return rest_; }
    /// The pieces of the rest, if the state was `uniform`.
    [[nodiscard]] std::span<const ConvexPiece> pieces() const {
        return std::span(pieces_).first(piece_count_);
    }
    /// Puts back the quarters of the last cell queried.
    void cut(const TranslationCell& square);

private:
    /// The answer of a certificate.
    struct Asked {
        std::uint32_t certificate = 0;
        double reach = 0.0;  ///< no translation that differs by less separates the shapes
    };
    /// Consecutive entries of asked_.
    struct List {
        std::size_t first = 0;
        std::size_t count = 0;
    };

    [[nodiscard]] bool is_of_a(std::uint32_t certificate) const { return certificate < of_a_; }
    /// The certificate's centre after a translation, in the coordinates of the other shape.
    [[nodiscard]] geometry::Vector place_of(std::uint32_t certificate,
                                            const geometry::Vector& shift) const;
    /// Cuts off the parts of a cell that vertices decide; true if the rest is uniform.
    [[nodiscard]] bool cut_off_walls(const TranslationCell& square, double radius);
    /// Cuts off the side of a line through `start` where the vertex is inside.
    void cut_off(const Asked& vertex, const TranslationCell& square,
                 const geometry::Vector& outwards, const geometry::Vector& start);
    /// Returns false if the vertex has edges in reach other than a single one, or two around a
    /// reflex corner.
    [[nodiscard]] bool cut_off_wall(const Asked& vertex, const TranslationCell& square,
                                    double radius);
    /// Splits the rest wherever a vertex may cross an edge; false if there are too many such lines.
    [[nodiscard]] bool split_rest(const TranslationCell& square, double radius);
    void split(const geometry::Vector& direction, double at);
    void add_piece(const ConvexPiece& piece);
    /// Appends a certificate to the last list, split into parts if it is a group too wide for the
    /// parts of such a cell.
    void list_parts(const Asked& asked, double half);
    void push(const TranslationCell& square);

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    WorkBudget* work_ = nullptr;
    double rounding_ = 0.0;
    std::vector<OverlapCertificate> certificates_;  // of A, then of B
    std::uint32_t of_a_ = 0;                        // number of A's certificates
    std::vector<std::uint32_t> top_;                // initial list
    std::vector<TranslationCell> squares_;          // a heap
    std::vector<Asked> asked_;
    std::vector<List> lists_;
    std::vector<Asked> left_;          // relevant certificates of the last cell queried
    ConvexPiece rest_;                 // of the last cell queried
    std::vector<ConvexPiece> pieces_;  // the first piece_count_ are in use
    std::size_t piece_count_ = 0;
    ConvexPiece beyond_;  // scratch
    ConvexPiece before_;
    std::vector<std::uint32_t> edges_;  // near one vertex; the rest is spare capacity
};

}  // namespace nearfield::mtv
