#include <tools/simulation/gear_train.hpp>
#include <tools/simulation/plane.hpp>

#include <cmath>
#include <numbers>

namespace nearfield::simulation {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double pitch_radius_by_teeth = 0.125;

double pitch_radius(std::size_t teeth) {
    return pitch_radius_by_teeth * static_cast<double>(teeth);
}

/// A gear that meshes with its driver and lies in the direction `toward` from it: it has a gap
/// where the driver has a tooth.
TrainGear driven(const std::vector<TrainGear>& train, std::size_t driver, std::size_t teeth,
                 double toward) {
    const TrainGear& before = train[driver];
    const double pitch = 2.0 * pi / static_cast<double>(teeth);
    const double past_a_tooth =
        (toward - before.angle) * static_cast<double>(before.teeth) / (2.0 * pi);
    const double part = past_a_tooth - std::floor(past_a_tooth);
    return {teeth, driver,
            simulation::operator+(
                before.place,
                simulation::polar(pitch_radius(before.teeth) + pitch_radius(teeth), toward)),
            toward + pi + (part + 0.5) * pitch};
}

}  // namespace

Ring gear_outline(std::size_t teeth) {
    constexpr double tip = 0.18;   // beyond the pitch radius
    constexpr double root = 0.28;  // inside it
    struct Corner {
        double part;  // in pitches, from the middle of the tooth
        double height;
    };
    constexpr Corner corners[] = {{-0.27, -root}, {-0.11, tip}, {0.11, tip}, {0.27, -root}};
    Ring ring;
    for (std::size_t tooth = 0; tooth < teeth; ++tooth) {
        for (const Corner& corner : corners) {
            const double turn =
                (static_cast<double>(tooth) + corner.part) / static_cast<double>(teeth);
            ring.push_back(simulation::polar(pitch_radius(teeth) + corner.height, 2.0 * pi * turn));
        }
    }
    return ring;
}

std::vector<TrainGear> gear_train() {
    std::vector<TrainGear> train{{9, 0, {}, 0.0}};
    for (std::size_t arm = 0; arm < 4; ++arm) {
        const double outward = pi / 4.0 + pi / 2.0 * static_cast<double>(arm);
        train.push_back(driven(train, 0, 8, outward));
    }
    for (std::size_t arm = 0; arm < 4; ++arm) {
        const double outward = pi / 4.0 + pi / 2.0 * static_cast<double>(arm);
        const double aside = 55.0 / 180.0 * pi;
        train.push_back(driven(train, 1 + arm, 6, outward - aside));
        train.push_back(driven(train, 1 + arm, 8, outward + aside));
    }
    return train;
}

}  // namespace nearfield::simulation
