#include <tools/io/summary.hpp>
#include <tools/rendering/clearance_legend.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace nearfield::tools {
namespace {

using simulation::ClearanceFrame;
using simulation::ClearanceScene;

constexpr double band_height = 66.0;
constexpr double bar_height = 14.0;
constexpr double small = 12.5;
constexpr double large = 17.0;

/// The bar of colours: to the left of `zero` depths, to the right of it clearances.
struct Bar {
    double left = 0.0;
    double zero = 0.0;
    double right = 0.0;
    double top = 0.0;
    bool has_depths = true;  ///< otherwise all overlaps have the colour of contact

    [[nodiscard]] double x_at(double position) const {
        return position < 0.0 ? zero + position * (zero - left) : zero + position * (right - zero);
    }
};

void draw_bar(Drawing& drawing, const Bar& bar) {
    ColoredCells cells;
    cells.rectangle = {{bar.left, bar.top}, {bar.right, bar.top + bar_height}};
    cells.columns = static_cast<std::size_t>(bar.right - bar.left);
    cells.rows = 1;
    for (std::size_t column = 0; column < cells.columns; ++column) {
        const double x = bar.left + static_cast<double>(column) + 0.5;
        const double side = x < bar.zero ? bar.zero - bar.left : bar.right - bar.zero;
        cells.colors.push_back(
            clearance_color(x < bar.zero && !bar.has_depths ? 0.0 : (x - bar.zero) / side));
    }
    drawing.cells(std::move(cells));
}

void draw_mark(Drawing& drawing, Vector2 tip) {
    drawing.fill({{tip, {tip.x - 6.0, tip.y - 9.0}, {tip.x + 6.0, tip.y - 9.0}}}, palette::text);
}

/// 80000 as "80,000".
std::string count_text(std::size_t count) {
    std::string text = std::to_string(count);
    for (std::size_t place = text.size(); place > 3; place -= 3) {
        text.insert(place - 3, ",");
    }
    return text;
}

std::string in_thousandths(double number) {
    return short_number(std::round(1000.0 * number) / 1000.0);
}

std::string finding(const ClearanceScene& scene) {
    const Clearance& clearance = scene.frame().clearance;
    const std::string subject = scene.frame().paths > 1 ? "best path: " : "";
    if (clearance.distance > 0.0) {
        const bool beyond = clearance.distance == scene.query().max_clearance;
        return subject + "clearance " + (beyond ? "at least " : "") +
               in_thousandths(clearance.distance);
    }
    return subject + "overlap" +
           (clearance.distance < 0.0 ? ", depth " + in_thousandths(-clearance.distance) : "");
}

std::string question(const ClearanceFrame& frame) {
    if (frame.paths == 1) {
        return "coloured by its clearance from all others and the strip's edge";
    }
    return count_text(frame.free_paths) + " of " + count_text(frame.paths) + " paths are free, " +
           count_text(frame.poses) + " poses in one call";
}

}  // namespace

void draw_clearance_legend(Drawing& drawing, const ClearanceScene& scene, const Rectangle& page) {
    const ClearanceQuery query = scene.query();
    Bar bar;
    bar.has_depths = query.min_clearance < 0.0;
    bar.left = page.min.x + 26.0;
    bar.zero = bar.left + (bar.has_depths ? 170.0 : 76.0);
    bar.right = bar.zero + 170.0;
    bar.top = page.max.y - 46.0;
    drawing.cells({{{page.min.x, page.max.y - band_height}, page.max}, 1, 1, {palette::page}});
    drawing.line({{page.min.x, page.max.y - band_height}, {page.max.x, page.max.y - band_height}},
                 palette::frame, 1.0);
    draw_bar(drawing, bar);
    draw_mark(
        drawing,
        {bar.x_at(std::clamp(scene.frame().clearance.distance / query.max_clearance, -1.0, 1.0)),
         bar.top - 1.0});
    const double ticks = bar.top + bar_height + 16.0;
    const std::string most = short_number(query.max_clearance);
    drawing.text({bar.right, ticks}, most, small, palette::quiet_text, Align::center);
    drawing.text({bar.zero, ticks}, "0", small, palette::quiet_text, Align::center);
    drawing.text({0.5 * (bar.zero + bar.right), ticks}, "clearance", small, palette::quiet_text,
                 Align::center);
    if (bar.has_depths) {
        drawing.text({bar.left, ticks}, most, small, palette::quiet_text, Align::center);
    }
    drawing.text({0.5 * (bar.left + bar.zero), ticks}, bar.has_depths ? "depth" : "overlap", small,
                 palette::quiet_text, Align::center);
    const double text = bar.right + 36.0;
    drawing.text({text, bar.top + 9.0}, finding(scene), large, palette::text);
    drawing.text({text, ticks}, question(scene.frame()), small, palette::quiet_text);
}

}  // namespace nearfield::tools
