#include <tools/simulation/plane.hpp>
#include <tools/simulation/responses.hpp>
#include <tools/simulation/world.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace nearfield::simulation {

World::World(Context& context, Scene scene, Response response, Technique technique)
    : scene_(std::move(scene)),
      proximity_(context, scene_.bodies, scene_.tolerance, technique),
      response_(response) {
    if (response == Response::backtracking) {
        const std::vector<double>& distances = proximity_.distances(proximity_.near_pairs(0.0));
        if (std::find(distances.begin(), distances.end(), 0.0) != distances.end()) {
            throw std::invalid_argument(
                "the scene starts with bodies that touch or overlap; backtracking has no state "
                "without contact to go back to");
        }
    }
}

void World::apply_surroundings() {
    const Surroundings& surroundings = scene_.surroundings;
    for (const std::unique_ptr<Body>& body : scene_.bodies) {
        body->pull(surroundings.gravity +
                   surroundings.attraction * (surroundings.middle - body->center()));
        if (surroundings.drag > 0.0) {
            body->slow_down(surroundings.drag);
        }
    }
}

void World::step(double time, FrameReport& report) {
    if (scene_.act) {
        scene_.act(time_);
    }
    apply_surroundings();
    if (response_ == Response::penalty) {
        const PenaltyReport penalty = push_apart(proximity_, scene_);
        report.contacts += penalty.points;
        report.worst_penetration = std::max(report.worst_penetration, penalty.deepest);
    }
    for (const std::unique_ptr<Body>& body : scene_.bodies) {
        body->accelerate(time);
    }
    if (response_ == Response::penalty) {
        for (const std::unique_ptr<Body>& body : scene_.bodies) {
            body->move(time);
            body->settle();
        }
    } else {
        const BacktrackingReport moved = move_without_penetration(proximity_, scene_, time);
        report.contacts += moved.contacts;
        report.events += moved.events;
        report.stopped += moved.stopped;
    }
    time_ += time;
}

Energies World::energies() const {
    Energies energies;
    const Surroundings& surroundings = scene_.surroundings;
    for (const std::unique_ptr<Body>& body : scene_.bodies) {
        const Inventory inventory = body->inventory();
        const Vector2 place = body->center();
        const Vector2 arm = place - surroundings.middle;
        energies.kinetic += inventory.kinetic_energy;
        energies.elastic += inventory.elastic_energy;
        energies.potential += inventory.mass * (0.5 * surroundings.attraction * dot(arm, arm) -
                                                dot(surroundings.gravity, place));
    }
    return energies;
}

FrameReport World::advance() {
    FrameReport report;
    proximity_.reset_count();
    const double time = scene_.frame_time / scene_.steps;
    for (unsigned i = 0; i < scene_.steps; ++i) {
        step(time, report);
    }
    report.queries = proximity_.count();
    report.time = time_;
    report.energies = energies();
    // Diagnostics at the end of the frame; not part of the simulation.
    const std::vector<Proximity::Overlap>& overlaps = proximity_.overlaps();
    for (const Proximity::Overlap& overlap : overlaps) {
        for (const PenetrationResult* result : {overlap.first_in_second, overlap.second_in_first}) {
            report.worst_penetration = std::max(report.worst_penetration, result->deepest.depth);
        }
    }
    report.energies.contact = stored_energy(overlaps, scene_.touch);
    return report;
}

}  // namespace nearfield::simulation
