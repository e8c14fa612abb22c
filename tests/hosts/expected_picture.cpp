#include "expected_picture.hpp"

#include "examples/common/value_of.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace nearfield::test {
namespace {

using examples::Color;
using examples::View;

/// The allowed deviation of the picture from the CPU in pixels: rounding.
constexpr double slack = 0.05;

std::string to_text(const Color& color) {
    return "(" + std::to_string(color[0]) + ", " + std::to_string(color[1]) + ", " +
           std::to_string(color[2]) + ")";
}

/// The effect of the markers on a pixel: none, a colour, or undecided due to rounding.
struct MarkerPixel {
    std::optional<Color> color;
    bool undecided = false;
};

MarkerPixel marker_at(const Vector2& pixel, const std::vector<ContactPoint>& contacts,
                      const View& view) {
    MarkerPixel found;
    for (const ContactPoint& contact : contacts) {
        const Vector2 at = view.to_pixel(contact.position);
        const double distance = std::max(std::abs(at.x - pixel.x), std::abs(at.y - pixel.y));
        if (std::abs(distance - examples::marker_radius) < slack) {
            found.undecided = true;
        } else if (distance < examples::marker_radius) {
            found = {contact.inside ? examples::inside_color : examples::outside_color, false};
        }
    }
    return found;
}

/// True if the picture shows the interior of a shape or the background at this place, as it should.
bool is_fill(const Color& color, const examples::Scene& scene, const Vector2& world,
             Comparison& comparison) {
    for (std::size_t i = scene.bodies().size(); i-- > 0;) {
        if (examples::contains(scene.bodies()[i], world)) {
            ++comparison.filled.at(i);
            return color == examples::fill_colors.at(i);
        }
    }
    ++comparison.background;
    return color == examples::background_color;
}

bool is_line(const Color& color) {
    return color == examples::normal_color || color == examples::outline_colors[0] ||
           color == examples::outline_colors[1];
}

}  // namespace

examples::Scene dragged_scene(const Vector2& by) {
    examples::Scene scene;
    scene.press(examples::drag_position(by, 0));
    scene.move(examples::drag_position(by, examples::drag_steps));
    scene.release();
    return scene;
}

std::vector<ContactPoint> contacts_by_cpu(const examples::Scene& scene) {
    Context context = examples::value_of(Context::create_headless());
    ContactQuery query;
    query.a = {examples::value_of(context.add_shape(scene.bodies()[0].rings)), scene.poses()[0]};
    query.b = {examples::value_of(context.add_shape(scene.bodies()[1].rings)), scene.poses()[1]};
    query.tolerance = examples::tolerance;
    query.contact_distance = examples::contact_distance;
    query.technique = Technique::cpu;
    Batch batch;
    const auto handle = batch.add(query);
    Results results;
    const Status status = context.run(batch, results);
    if (!status.ok() || !results[handle].status.ok()) {
        throw std::runtime_error(status.text() + results[handle].status.text());
    }
    return results[handle].points;
}

Comparison compare(const Pixels& picture, const examples::Scene& scene,
                   const std::vector<ContactPoint>& contacts, const Vector2& label) {
    const View view{static_cast<double>(picture.width), static_cast<double>(picture.height)};
    Comparison comparison;
    int differences = 0;
    const auto differ = [&](int x, int y, const std::string& expected) {
        if (++differences == 1) {
            comparison.difference = "pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                                    ") is " + to_text(picture.at(x, y)) + ", not " + expected;
        }
    };
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const Vector2 centre{x + 0.5, y + 0.5};
            const Color& color = picture.at(x, y);
            const MarkerPixel marker = marker_at(centre, contacts, view);
            if (marker.undecided || (x < label.x && y > label.y)) {
                continue;
            }
            if (marker.color) {
                ++(*marker.color == examples::inside_color ? comparison.inside_markers
                                                           : comparison.outside_markers);
                if (color != *marker.color) {
                    differ(x, y, "the contact's " + to_text(*marker.color));
                }
            } else if (is_line(color)) {
                ++comparison.lines;
            } else if (!is_fill(color, scene, view.to_world(centre), comparison)) {
                differ(x, y, "as the scene has it there");
            }
        }
    }
    for (const ContactPoint& contact : contacts) {
        const Vector2 at = view.to_pixel(contact.position);
        const Vector2 middle{at.x + contact.normal.x * examples::normal_length / 2,
                             at.y - contact.normal.y * examples::normal_length / 2};
        const int x = static_cast<int>(middle.x);
        const int y = static_cast<int>(middle.y);
        const MarkerPixel marker = marker_at({x + 0.5, y + 0.5}, contacts, view);
        if (marker.color || marker.undecided) {
            continue;
        }
        ++comparison.normals;
        if (picture.at(x, y) != examples::normal_color) {
            differ(x, y, "the normal of a contact");
        }
    }
    if (differences > 1) {
        comparison.difference += "; " + std::to_string(differences) + " differences in all";
    }
    return comparison;
}

}  // namespace nearfield::test
