#pragma once

#include <engine/mtv/convex_piece.hpp>
#include <engine/mtv/crossing_certificates.hpp>
#include <engine/mtv/overlap_certificates.hpp>
#include <engine/mtv/work_budget.hpp>
#include <engine/simd/edge_subset.hpp>
#include <engine/simd/transformed_edges.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace nearfield::mtv {

/// A rectangular cell in the space of translations of A.
struct TranslationCell {
    geometry::Vector centre;
    geometry::Vector half;   ///< half its sides
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
/// on one side of a line, and that part is cut off; so are, on demand, the translations for which
/// two given edges cross. What is left is split along the lines of the other vertices and edges in
/// reach, if they are few, into pieces that are uniform.
///
/// A depth changes no faster than the translation, so a certificate's last answer bounds the next:
/// each cell asks those that may decide it, most promising first, and passes the answers on.
///
/// Lines of aligned shapes coincide up to rounding. A piece thinner than the margin between such
/// lines counts as touching, so cells overlap by more than that: what is thin at the border of one
/// cell is not in the next.
class TranslationSearch {
public:
    /// Starts with all translations up to `longest`. `rounding`: of both shapes; gaps up to this
    /// count as touching. `margin`: see ConvexPiece; several times the rounding.
    void begin(const simd::TransformedEdges& a, const simd::TransformedEdges& b, double longest,
               double rounding, double margin, WorkBudget& work);

    [[nodiscard]] bool is_empty() const { return cells_.empty(); }
    [[nodiscard]] TranslationCell take_nearest();
    /// True if a certificate decides the cell. Otherwise all of it is the rest.
    [[nodiscard]] bool overlaps(const TranslationCell& cell);
    /// Cuts off what walls decide of a cell that the certificates did not decide.
    [[nodiscard]] CellState ask(const TranslationCell& cell);
    /// The rest of the last cell queried. Empty if its state was `overlapping`.
    [[nodiscard]] const ConvexPiece& rest() const { return rest_; }
    /// The pieces of the rest, if the state was `uniform`.
    [[nodiscard]] std::span<const ConvexPiece> pieces() const {
        return std::span(pieces_).first(piece_count_);
    }
    /// Cuts a crossing's translations off the rest of the last cell queried, if what is left is
    /// convex; true if that is less than before.
    [[nodiscard]] bool cut_off(const CrossingCertificate& crossing);
    /// Puts back the parts of the last cell queried.
    void cut(const TranslationCell& cell);
    /// Puts back what two parallel sides of a crossing's translations leave of the rest; false if
    /// they do not divide it.
    [[nodiscard]] bool divide(const TranslationCell& cell, const CrossingCertificate& crossing);

private:
    /// Depths are off by less than this many roundings.
    static constexpr double roundings_of_depth = 4.0;
    /// Marks an entry of a list without meaning.
    static constexpr std::uint32_t dropped = std::numeric_limits<std::uint32_t>::max();

    /// The last answer of a certificate.
    struct Asked {
        std::uint32_t certificate = 0;
        std::uint32_t edge = 0;  ///< of the other shape, near the certificate's centre
        double depth = 0.0;      ///< of the centre in the other shape, when asked
        double moved = 0.0;      ///< the most that the centre has moved since
        double most = 0.0;       ///< of the certificate

        /// At most this is certified.
        [[nodiscard]] double bound() const { return most + depth + moved; }
    };
    /// Consecutive entries of asked_ and of crossings_asked_, for cells in a cell.
    struct List {
        std::size_t first = 0;
        std::size_t count = 0;
        std::size_t first_crossing = 0;
        std::size_t crossings = 0;
        geometry::Vector centre;   ///< of that cell
        bool in_vain = false;      ///< walls were looked for in that cell, and none found
        geometry::Vector normals;  ///< as normals_, of that cell
    };
    /// A line of translations, normal . translation = at, where a vertex comes to an edge.
    struct Line {
        geometry::Vector normal;
        double at = 0.0;
    };
    /// A rectangle of translations.
    struct Focus {
        geometry::Vector centre;
        geometry::Vector half;
    };

    /// The translations that a crossing certifies, between two parallel sides.
    struct Sides {
        geometry::Vector across;  ///< unit normal of the sides
        double low = 0.0;         ///< coordinates of the sides along it
        double high = 0.0;
        bool before = false;     ///< the rest of the last cell queried has a part before the sides
        bool beyond = false;     ///< and one beyond
        bool are_whole = false;  ///< between the sides, all of the rest is certified
    };

    [[nodiscard]] Sides sides_of(const CrossingCertificate& crossing) const;
    [[nodiscard]] bool is_of_a(std::uint32_t certificate) const { return certificate < of_a_; }
    /// The shape that a certificate is about.
    [[nodiscard]] const simd::TransformedEdges& other_of(std::uint32_t certificate) const {
        return is_of_a(certificate) ? *b_ : *a_;
    }
    /// The unit vector to the left of an edge of that shape; 0 if the edge has no length.
    [[nodiscard]] const geometry::Vector& normal_of(std::uint32_t certificate,
                                                    std::uint32_t edge) const {
        return is_of_a(certificate) ? normals_b_[edge] : normals_a_[edge];
    }
    /// The certificate's centre after a translation, in the coordinates of the other shape.
    [[nodiscard]] geometry::Vector place_of(std::uint32_t certificate,
                                            const geometry::Vector& shift) const;
    void ask_depth(Asked& asked, const geometry::Vector& shift);
    /// The certificates of an expanded group go to the end of left_.
    void append_parts(const Asked& asked, std::vector<Asked>& parts) const;
    /// True if a crossing of edges decides the cell.
    [[nodiscard]] bool cross_throughout(const TranslationCell& cell, const geometry::Vector& half);
    /// True if a certificate decides the cell. Fills left_ with those that matter.
    [[nodiscard]] bool overlap_throughout(const TranslationCell& cell, double radius);
    /// Writes the edges of the other shape that intersect a rectangle to edges_; returns their
    /// number.
    [[nodiscard]] std::uint32_t find_edges_in(std::uint32_t certificate,
                                              const geometry::Vector& centre,
                                              const geometry::Vector& half);
    /// The box of the rest, a little larger.
    [[nodiscard]] Focus focus_of_rest() const;
    /// Cuts off the parts of a cell that vertices decide; lists the lines of the other vertices in
    /// lines_, and groups in undecided_. False if there are too many.
    [[nodiscard]] bool cut_off_walls(const TranslationCell& cell);
    /// What a vertex decides: nothing in reach and outside; nothing in reach and inside; a part was
    /// cut off; or not known.
    enum class Wall : std::uint8_t { none, all, cut, undecided };
    [[nodiscard]] Wall cut_off_wall(const Asked& vertex, const TranslationCell& cell,
                                    const Focus& focus);
    /// For the two edges in edges_.
    [[nodiscard]] Wall cut_off_corner(const Asked& vertex, const Focus& focus, bool inside);
    /// Cuts off the side of an edge where the vertex is inside. `inside`: it is so at the focus.
    void cut_off_side(const Asked& vertex, const Focus& focus, bool inside, std::uint32_t edge);
    /// Replaces a group by its parts if an edge is in reach of any of them.
    [[nodiscard]] Wall expand(std::uint32_t index, const TranslationCell& cell, const Focus& focus);
    [[nodiscard]] bool is_inside(const Asked& vertex, const TranslationCell& cell,
                                 const geometry::Vector& shift);
    /// Of the first edges in edges_, adds the lines where the vertex may come to them from outside.
    void add_lines(const Asked& vertex, const Focus& focus, std::uint32_t count);
    /// Cuts off the side of a line through `start` where the vertex is inside.
    void cut_off(const Asked& vertex, const Focus& focus, const geometry::Vector& outwards,
                 const geometry::Vector& start);
    /// Splits the rest wherever a vertex may cross an edge; false if there are too many such lines.
    [[nodiscard]] bool split_rest();
    /// True if the line has something on both sides.
    [[nodiscard]] bool split(const geometry::Vector& direction, double at);
    void add_piece(const ConvexPiece& piece);
    /// Keeps what certificates answered for the parts of the last cell queried; returns the list.
    [[nodiscard]] std::uint32_t keep_answers(const TranslationCell& cell);
    /// Puts back the box of a piece of the last cell queried.
    void push_piece(const ConvexPiece& piece, double nearest, std::uint32_t list);
    void push(const TranslationCell& cell);

    const simd::TransformedEdges* a_ = nullptr;
    const simd::TransformedEdges* b_ = nullptr;
    WorkBudget* work_ = nullptr;
    double rounding_ = 0.0;
    double margin_ = 0.0;
    std::vector<OverlapCertificate> certificates_;  // of A, then of B
    std::uint32_t of_a_ = 0;                        // number of A's certificates
    std::vector<std::uint32_t> top_;                // initial list
    std::vector<geometry::Vector> normals_a_;       // of the edges of A
    std::vector<geometry::Vector> normals_b_;
    simd::EdgeSubset in_reach_of_a_;  // edges of B that A comes to; unset if B is not small
    simd::EdgeSubset in_reach_of_b_;
    CrossingCertificates crossing_finder_;
    std::vector<CrossingCertificate> crossings_;
    std::vector<TranslationCell> cells_;  // a heap
    std::vector<Asked> asked_;
    std::vector<std::uint32_t> crossings_asked_;
    std::vector<List> lists_;
    std::vector<Asked> left_;  // relevant certificates of the last cell queried
    std::vector<std::uint32_t> crossings_left_;
    geometry::Vector normals_ = geometry::Vector::Zero();  // of walls in reach, absolute values
    std::vector<std::uint32_t> undecided_;                 // groups of vertices
    bool in_vain_ = false;  // as of a list, for the last cell queried
    bool has_cut_ = false;  // walls of it
    std::vector<Line> lines_;
    ConvexPiece rest_;                 // of the last cell queried
    std::vector<ConvexPiece> pieces_;  // the first piece_count_ are in use
    std::size_t piece_count_ = 0;
    ConvexPiece beyond_;  // scratch
    ConvexPiece before_;
    std::vector<std::uint32_t> edges_;  // near one vertex; the rest is spare capacity
};

}  // namespace nearfield::mtv
