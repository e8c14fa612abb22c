#include <tools/peers/convex_pieces.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace nearfield::peers {
namespace {

/// The vertices of a polygon, counter-clockwise, by their indices in the ring.
using Piece = std::vector<std::size_t>;

/// Twice the area of a triangle: above 0 if it is counter-clockwise.
double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool holds(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& point) {
    return turn(a, b, point) >= 0.0 && turn(b, c, point) >= 0.0 && turn(c, a, point) >= 0.0;
}

/// All vertices of the ring, counter-clockwise.
Piece whole(const Ring& ring) {
    Piece piece(ring.size());
    std::iota(piece.begin(), piece.end(), std::size_t{0});
    double area = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        area += turn({}, ring[i], ring[(i + 1) % ring.size()]);
    }
    if (area < 0.0) {
        std::reverse(piece.begin(), piece.end());
    }
    return piece;
}

/// True if the triangle at a vertex of the piece lies in its interior.
bool is_ear(const Ring& ring, const Piece& piece, std::size_t at) {
    const std::size_t n = piece.size();
    const std::size_t before = piece[(at + n - 1) % n];
    const std::size_t after = piece[(at + 1) % n];
    const std::size_t tip = piece[at];
    return turn(ring[before], ring[tip], ring[after]) > 0.0 &&
           std::none_of(piece.begin(), piece.end(), [&](std::size_t other) {
               return other != before && other != tip && other != after &&
                      holds(ring[before], ring[tip], ring[after], ring[other]);
           });
}

std::vector<Piece> triangles_of(const Ring& ring) {
    std::vector<Piece> triangles;
    Piece rest = whole(ring);
    while (rest.size() > 3) {
        std::size_t ear = 0;
        while (ear < rest.size() && !is_ear(ring, rest, ear)) {
            ++ear;
        }
        if (ear == rest.size()) {
            throw std::runtime_error("a ring that crosses itself has no triangles");
        }
        const std::size_t n = rest.size();
        triangles.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back(rest);
    return triangles;
}

bool is_convex(const Ring& ring, const Piece& piece) {
    const std::size_t n = piece.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (turn(ring[piece[i]], ring[piece[(i + 1) % n]], ring[piece[(i + 2) % n]]) < 0.0) {
            return false;
        }
    }
    return true;
}

/// Two pieces without the edge that they share; nothing if they share none.
std::optional<Piece> joined(const Piece& a, const Piece& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::size_t end = a[(i + 1) % a.size()];
        const auto other = std::find(b.begin(), b.end(), end);
        const auto at = static_cast<std::size_t>(other - b.begin());
        if (other == b.end() || b[(at + 1) % b.size()] != a[i]) {
            continue;
        }
        Piece piece;
        for (std::size_t k = 0; k < a.size(); ++k) {
            piece.push_back(a[(i + 1 + k) % a.size()]);
        }
        for (std::size_t k = 2; k < b.size(); ++k) {
            piece.push_back(b[(at + k) % b.size()]);
        }
        return piece;
    }
    return std::nullopt;
}

/// Joins a piece with one of the later ones, which disappears; false if none fits.
bool join_one(const Ring& ring, std::vector<Piece>& pieces, std::size_t first,
              std::size_t max_vertices) {
    for (std::size_t second = first + 1; second < pieces.size(); ++second) {
        const std::optional<Piece> piece = joined(pieces[first], pieces[second]);
        if (piece && piece->size() <= max_vertices && is_convex(ring, *piece)) {
            pieces[first] = *piece;
            pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(second));
            return true;
        }
    }
    return false;
}

}  // namespace

std::vector<Ring> convex_pieces(const Ring& ring, std::size_t max_vertices) {
    std::vector<Piece> pieces = triangles_of(ring);
    for (std::size_t first = 0; first < pieces.size(); ++first) {
        while (join_one(ring, pieces, first, max_vertices)) {
        }
    }
    std::vector<Ring> rings;
    for (const Piece& piece : pieces) {
        Ring& polygon = rings.emplace_back();
        for (const std::size_t vertex : piece) {
            polygon.push_back(ring[vertex]);
        }
    }
    return rings;
}

}  // namespace nearfield::peers
