#include <engine/geometry/gathered_rings.hpp>
#include <engine/geometry/ring_check.hpp>

#include <cstddef>
#include <string>

namespace nearfield::geometry {
namespace {

std::size_t vertex_count(const RingView& view) {
    return (view.count() + view.stride() - 1) / view.stride();
}

void require_pairs(std::size_t ring, const RingView& view) {
    const auto refuse = [ring](const std::string& why) {
        refuse_shape("ring " + std::to_string(ring) + ": " + why);
    };
    if (view.stride() < 2) {
        refuse("its stride is " + std::to_string(view.stride()) +
               "; a vertex takes at least 2 numbers");
    }
    if (view.count() % view.stride() == 1) {
        refuse("it has " + std::to_string(view.count()) + " numbers at a stride of " +
               std::to_string(view.stride()) + "; the last vertex lacks its y");
    }
    // Said here, with the stride: one in bytes leaves too few.
    if (vertex_count(view) < 3) {
        refuse(std::to_string(view.count()) + " numbers at a stride of " +
               std::to_string(view.stride()) + " numbers are fewer than three different vertices");
    }
}

template <class Number>
void read(const Number* numbers, const RingView& view, Ring& ring) {
    ring.resize(vertex_count(view));
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Number* const vertex = numbers + i * view.stride();
        ring[i] = {static_cast<double>(vertex[0]), static_cast<double>(vertex[1])};
    }
}

}  // namespace

std::span<const Ring> GatheredRings::gather(std::span<const RingView> views) {
    if (rings_.size() < views.size()) {
        rings_.resize(views.size());
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
        require_pairs(i, views[i]);
        if (views[i].floats() != nullptr) {
            read(views[i].floats(), views[i], rings_[i]);
        } else {
            read(views[i].doubles(), views[i], rings_[i]);
        }
    }
    return std::span(rings_).first(views.size());
}

}  // namespace nearfield::geometry
