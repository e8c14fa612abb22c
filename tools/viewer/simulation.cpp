#include <tools/common/library.hpp>
#include <tools/io/input_error.hpp>
#include <tools/simulation/simulation_choice.hpp>
#include <tools/viewer/simulation.hpp>

#include <stdexcept>
#include <utility>

namespace nearfield::viewer {
namespace {

Context make_context(const HostDevice& host, Settings settings, const Choices& choices) {
    settings.timestamps = true;  // the panel shows the passes
    settings.hierarchy_height = choices.hierarchy_height;
    settings.pipelines_on_demand = true;
    return tools::take(Context::create(host, settings));
}

}  // namespace

Simulation::Simulation(const HostDevice& host, const Settings& settings, const Choices& choices)
    : host_(host),
      settings_(settings),
      choices_(choices),
      context_(make_context(host, settings, choices)) {
    restart();
}

void Simulation::begin(simulation::Scene scene, double time) {
    world_.reset();
    begun_at_ = time;
    scene.tolerance = choices_.tolerance > 0.0 ? choices_.tolerance : own_tolerance_;
    // A world counts its time from 0; the scene's own time continues.
    scene.act = [this](double since) {
        if (act_) {
            act_(begun_at_ + since);
        }
        drag_.pull(world_->scene());
    };
    world_.emplace(*context_, std::move(scene), choices_.response, choices_.technique);
}

const Rectangle& Simulation::view() const {
    return clearances_ ? clearances_->view() : scene().view;
}

double Simulation::time() const {
    return clearances_ ? clearances_->frame().time : begun_at_ + world_->time();
}

void Simulation::grab(Vector2 point) {
    if (clearances_) {
        clearances_->grab(point);
    } else {
        drag_.grab(scene(), point);
    }
}

void Simulation::drag_to(Vector2 point) {
    if (clearances_) {
        clearances_->drag(point);
    } else {
        drag_.move(point);
    }
}

void Simulation::release() {
    if (clearances_) {
        clearances_->release();
    } else {
        drag_.release();
    }
}

void Simulation::restart() {
    drag_.release();
    clearances_.reset();
    if (const auto* const named = tools::find_clearance_scene(choices_.scene)) {
        world_.reset();
        clearances_ = named->make(*context_);
        return;
    }
    simulation::Scene scene = tools::make_scene(choices_.scene, std::nullopt);
    act_ = std::move(scene.act);
    own_tolerance_ = scene.tolerance;
    try {
        begin(std::move(scene), 0.0);
    } catch (const std::invalid_argument& error) {
        throw tools::InputError("backtracking: " + choices_.scene + ": " + error.what());
    }
}

void Simulation::choose(const Choices& choices) {
    if (choices == choices_) {
        return;
    }
    std::optional<Context> other;
    if (choices.hierarchy_height != choices_.hierarchy_height) {
        other = make_context(host_, settings_, choices);
    }
    const bool overlaps = world_ && choices.response == simulation::Response::backtracking &&
                          !world_->proximity().overlaps().empty();
    const bool anew = choices.scene != choices_.scene || clearances_ || overlaps;
    const Choices former = std::exchange(choices_, choices);
    double time = 0.0;
    simulation::Scene scene;
    if (!anew) {
        time = this->time();
        scene = std::move(world_->scene());
    }
    world_.reset();
    clearances_.reset();
    if (other) {
        context_ = std::move(other);
    }
    if (!anew) {
        begin(std::move(scene), time);
        return;
    }
    try {
        restart();
    } catch (const tools::InputError&) {
        choices_ = former;
        restart();
        throw;
    }
}

}  // namespace nearfield::viewer
