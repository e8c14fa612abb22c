#include <tools/hash/answer_hash.hpp>
#include <tools/hash/sections.hpp>
#include <tools/simulation/scenes.hpp>
#include <tools/simulation/world.hpp>

#include <algorithm>
#include <cstddef>

namespace nearfield::hash {
namespace {

void add_frames(Context& context, simulation::Scene scene, simulation::Response response,
                AnswerHash& hash) {
    constexpr int frames = 120;
    simulation::World world(context, std::move(scene), response, Technique::cpu);
    for (int i = 0; i < frames; ++i) {
        const simulation::FrameReport report = world.advance();
        const simulation::Energies& energies = report.energies;
        for (const double number : {energies.kinetic, energies.potential, energies.elastic,
                                    energies.contact, report.worst_penetration}) {
            hash.add(number);
        }
        hash.add(report.contacts);
        hash.add(report.events);
        for (const auto& body : world.scene().bodies) {
            hash.add(body->pose());
            if (body->deforms()) {
                for (const Ring& ring : body->rings()) {
                    hash.add(std::span<const Vector2>(ring));
                }
            }
        }
    }
}

}  // namespace

std::uint64_t hash_simulation(const MakeContext& make_context, std::size_t scene) {
    const auto make_scene = simulation::paper_scenes()[scene].make;
    AnswerHash hash;
    Context context = make_context({});
    add_frames(context, make_scene(), simulation::Response::penalty, hash);
    const simulation::Scene again = make_scene();
    const bool rigid = std::none_of(again.bodies.begin(), again.bodies.end(),
                                    [](const auto& body) { return body->deforms(); });
    if (rigid) {
        Context fresh = make_context({});
        add_frames(fresh, make_scene(), simulation::Response::backtracking, hash);
    }
    return hash.value();
}

}  // namespace nearfield::hash
