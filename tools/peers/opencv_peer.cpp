#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <tools/peers/peer.hpp>

#include <cmath>

namespace nearfield::peers {
namespace {

/// OpenCV works on pixels: it fills the shape and computes each pixel's distance to the nearest
/// pixel on the other side, so the boundary is known to about half a pixel.
class OpenCv final : public Peer {
public:
    OpenCv() { cv::setNumThreads(1); }

    [[nodiscard]] std::string name() const override { return "OpenCV"; }
    [[nodiscard]] std::string how(Task task) const override {
        return task == Task::field
                   ? "fillPoly and distanceTransform (precise), inside and outside: distance to "
                     "the "
                     "nearest pixel of the other side less half a pixel, not to an edge"
                   : "";
    }
    [[nodiscard]] bool exact() const override { return false; }
    void build(std::span<const PlacedShape> shapes, Task /*task*/) override {
        shapes_.assign(shapes.begin(), shapes.end());
    }
    void field(std::size_t shape, const Grid& grid, std::vector<float>& values) override;

private:
    void fill(const std::vector<Ring>& rings, const Grid& grid);

    std::vector<PlacedShape> shapes_;
    std::vector<std::vector<cv::Point>> polygons_;
    cv::Mat inside_;
    cv::Mat outside_;
    cv::Mat to_outside_;
    cv::Mat to_inside_;
};

void OpenCv::fill(const std::vector<Ring>& rings, const Grid& grid) {
    constexpr int shift = 8;
    constexpr double steps = 1 << shift;
    polygons_.clear();
    for (const Ring& ring : rings) {
        std::vector<cv::Point>& polygon = polygons_.emplace_back();
        for (const Vector2& vertex : ring) {
            // Pixel centres have integer coordinates.
            const double x = (vertex.x - grid.origin.x) / grid.cell - 0.5;
            const double y = (vertex.y - grid.origin.y) / grid.cell - 0.5;
            polygon.emplace_back(static_cast<int>(std::lround(x * steps)),
                                 static_cast<int>(std::lround(y * steps)));
        }
    }
    inside_.create(static_cast<int>(grid.height), static_cast<int>(grid.width), CV_8U);
    inside_.setTo(0);
    cv::fillPoly(inside_, polygons_, cv::Scalar(255), cv::LINE_8, shift);
}

void OpenCv::field(std::size_t shape, const Grid& grid, std::vector<float>& values) {
    fill(shapes_[shape].rings, grid);
    cv::bitwise_not(inside_, outside_);
    cv::distanceTransform(inside_, to_outside_, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    cv::distanceTransform(outside_, to_inside_, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    values.resize(grid.width * grid.height);
    const auto cell = static_cast<float>(grid.cell);
    const float* const in = to_outside_.ptr<float>();
    const float* const out = to_inside_.ptr<float>();
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = in[i] > 0.0F ? (0.5F - in[i]) * cell : (out[i] - 0.5F) * cell;
    }
}

}  // namespace

std::unique_ptr<Peer> make_opencv_peer() {
    return std::make_unique<OpenCv>();
}

}  // namespace nearfield::peers
