#include <clipper.hpp>
#include <tools/peers/peer.hpp>

#include <cmath>

namespace nearfield::peers {
namespace {

/// Clipper uses integer coordinates: this many per unit.
constexpr double clipper_scale = 1e6;

class Clipper final : public Peer {
public:
    Clipper()
        : Peer("Clipper",
               {{Task::intersection_test,
                 "whether the intersection has an area; touching does not count"},
                {Task::common_area,
                 "area of the intersection, exact for coordinates rounded to a millionth"}}) {}

    void build(const Problem& /*problem*/, std::span<const PlacedShape> shapes) override {
        shapes_.clear();
        for (const PlacedShape& placed : shapes) {
            ClipperLib::Paths& paths = shapes_.emplace_back();
            for (const Ring& ring : placed.rings) {
                ClipperLib::Path& path = paths.emplace_back();
                for (const Vector2& vertex : ring) {
                    path.emplace_back(std::llround(vertex.x * clipper_scale),
                                      std::llround(vertex.y * clipper_scale));
                }
            }
        }
    }
    bool intersect(std::size_t a, std::size_t b) override { return common_area(a, b) > 0.0; }
    double common_area(std::size_t a, std::size_t b) override {
        ClipperLib::Clipper clipper;
        clipper.AddPaths(shapes_[a], ClipperLib::ptSubject, true);
        clipper.AddPaths(shapes_[b], ClipperLib::ptClip, true);
        ClipperLib::Paths common;
        clipper.Execute(ClipperLib::ctIntersection, common, ClipperLib::pftEvenOdd,
                        ClipperLib::pftEvenOdd);
        double area = 0.0;
        for (const ClipperLib::Path& path : common) {
            area += ClipperLib::Area(path);
        }
        return area / (clipper_scale * clipper_scale);
    }

private:
    std::vector<ClipperLib::Paths> shapes_;
};

}  // namespace

std::unique_ptr<Peer> make_clipper_peer() {
    return std::make_unique<Clipper>();
}

}  // namespace nearfield::peers
