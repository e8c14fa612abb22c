#include "picture.hpp"

#include <algorithm>
#include <cmath>

namespace nearfield::examples {
namespace {

using Triangles = std::vector<Vertex>;

void add_triangle(Triangles& triangles, const Vector2& a, const Vector2& b, const Vector2& c,
                  const Color& color) {
    for (const Vector2& corner : {a, b, c}) {
        triangles.push_back({static_cast<float>(corner.x), static_cast<float>(corner.y), color});
    }
}

void add_quad(Triangles& triangles, const std::array<Vector2, 4>& corners, const Color& color) {
    add_triangle(triangles, corners[0], corners[1], corners[2], color);
    add_triangle(triangles, corners[0], corners[2], corners[3], color);
}

void add_line(Triangles& triangles, const Vector2& from, const Vector2& to, double width,
              const Color& color) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (length == 0.0) {
        return;
    }
    const double x = -(to.y - from.y) / length * width / 2;
    const double y = (to.x - from.x) / length * width / 2;
    add_quad(triangles,
             {{{from.x + x, from.y + y},
               {from.x - x, from.y - y},
               {to.x - x, to.y - y},
               {to.x + x, to.y + y}}},
             color);
}

/// The rings of a body in pixels.
std::vector<Ring> outline(const Body& body, const Pose& pose, const View& view) {
    std::vector<Ring> rings = body.rings;
    for (Ring& ring : rings) {
        for (Vector2& vertex : ring) {
            vertex = view.to_pixel(place(pose, vertex));
        }
    }
    return rings;
}

struct Edge {
    Vector2 top;
    Vector2 bottom;

    [[nodiscard]] double x_at(double y) const {
        return top.x + (bottom.x - top.x) * (y - top.y) / (bottom.y - top.y);
    }
};

/// Fills by the odd-even rule: between the heights of two vertices no edges cross, so the area
/// between every second pair of edges is a trapezoid.
void add_fill(Triangles& triangles, const std::vector<Ring>& rings, const Color& color) {
    std::vector<Edge> edges;
    std::vector<double> heights;
    for (const Ring& ring : rings) {
        Vector2 from = ring.back();
        for (const Vector2& to : ring) {
            heights.push_back(to.y);
            if (from.y != to.y) {
                edges.push_back(from.y < to.y ? Edge{from, to} : Edge{to, from});
            }
            from = to;
        }
    }
    std::sort(heights.begin(), heights.end());
    for (std::size_t i = 1; i < heights.size(); ++i) {
        const double top = heights[i - 1];
        const double bottom = heights[i];
        std::vector<Edge> across;
        for (const Edge& edge : edges) {
            if (top < bottom && edge.top.y <= top && edge.bottom.y >= bottom) {
                across.push_back(edge);
            }
        }
        const double middle = (top + bottom) / 2;
        std::sort(across.begin(), across.end(), [middle](const Edge& left, const Edge& right) {
            return left.x_at(middle) < right.x_at(middle);
        });
        for (std::size_t k = 0; k + 1 < across.size(); k += 2) {
            const Edge& left = across[k];
            const Edge& right = across[k + 1];
            add_quad(triangles,
                     {{{left.x_at(top), top},
                       {right.x_at(top), top},
                       {right.x_at(bottom), bottom},
                       {left.x_at(bottom), bottom}}},
                     color);
        }
    }
}

void add_outline(Triangles& triangles, const std::vector<Ring>& rings, const Color& color) {
    for (const Ring& ring : rings) {
        Vector2 from = ring.back();
        for (const Vector2& to : ring) {
            add_line(triangles, from, to, 1.5, color);
            from = to;
        }
    }
}

void add_marker(Triangles& triangles, const Vector2& at, const Color& color) {
    constexpr double r = marker_radius;
    add_quad(
        triangles,
        {{{at.x - r, at.y - r}, {at.x + r, at.y - r}, {at.x + r, at.y + r}, {at.x - r, at.y + r}}},
        color);
}

}  // namespace

std::vector<Vertex> draw(const Scene& scene, const Snapshot& snapshot, const View& view) {
    Triangles triangles;
    std::array<std::vector<Ring>, 2> outlines;
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        outlines[i] = outline(scene.bodies()[i], snapshot.poses[i], view);
        add_fill(triangles, outlines[i], fill_colors[i]);
    }
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        add_outline(triangles, outlines[i], outline_colors[i]);
    }
    for (const ContactPoint& contact : snapshot.contacts) {
        const Vector2 at = view.to_pixel(contact.position);
        const Vector2 tip{at.x + contact.normal.x * normal_length,
                          at.y - contact.normal.y * normal_length};
        add_line(triangles, at, tip, 1.5, normal_color);
    }
    for (const ContactPoint& contact : snapshot.contacts) {
        add_marker(triangles, view.to_pixel(contact.position),
                   contact.inside ? inside_color : outside_color);
    }
    return triangles;
}

}  // namespace nearfield::examples
