#include <tools/cli/open_context.hpp>
#include <tools/common/device_pair_runner.hpp>
#include <tools/common/library_error.hpp>
#include <tools/io/world_technique.hpp>

#include <iostream>

namespace nearfield::tools {

AskedTechniques techniques_of(const Scene& scene) {
    AskedTechniques asked;
    for (const SceneQuery& query : scene.queries) {
        if (!query.problem.empty()) {
            continue;
        }
        if (is_for_device_pairs(query)) {
            asked.add(Technique::compute);
        } else if (!query.world) {
            asked.add(query.request);
        } else if (technique_problem(*query.world).empty()) {
            asked.add(answering_technique(*query.world));
        }
    }
    return asked;
}

Context open_context(Settings settings, const AskedTechniques& asked) {
    const bool automatic = asked.has(Technique::automatic);
    const bool raster = asked.has(Technique::raster);
    const bool compute = asked.has(Technique::compute);
    if (!automatic && !raster && !compute) {
        return take(Context::create_cpu(settings));
    }
    settings.techniques = {.raster = automatic || raster, .compute = automatic || compute};
    settings.pipelines_on_demand = true;
    Expected<Context> context = Context::create_headless({}, settings);
    const StatusCode code = context.error().code();
    if ((code == StatusCode::no_device || code == StatusCode::unsupported_device) && !raster &&
        !compute) {
        std::cerr << "nearfield: without a device, by the CPU alone: " << context.error().text()
                  << '\n';
        return take(Context::create_cpu(settings));
    }
    return take(std::move(context));
}

}  // namespace nearfield::tools
