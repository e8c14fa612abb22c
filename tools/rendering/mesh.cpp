#include <tools/rendering/mesh.hpp>
#include <tools/rendering/triangles.hpp>

#include <variant>

namespace nearfield::tools {

void Mesh::add(const Drawing& drawing) {
    const auto first = static_cast<std::uint32_t>(indices_.size());
    Triangles triangles(vertices_, indices_);
    for (const DrawnItem& item : drawing.items()) {
        std::visit([&triangles](const auto& any) { triangles.add(any); }, item);
    }
    parts_.push_back(
        {0, 0, width_, height_, first, static_cast<std::uint32_t>(indices_.size()) - first});
}

void Mesh::add(std::span<const MeshVertex> vertices, std::span<const std::uint16_t> indices,
               std::span<const MeshPart> parts) {
    const auto base = static_cast<std::uint32_t>(vertices_.size());
    const auto first = static_cast<std::uint32_t>(indices_.size());
    vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
    for (const std::uint16_t index : indices) {
        indices_.push_back(base + index);
    }
    for (MeshPart part : parts) {
        part.first += first;
        parts_.push_back(part);
    }
}

}  // namespace nearfield::tools
