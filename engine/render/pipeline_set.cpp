#include <engine/render/pipeline_set.hpp>

#include <algorithm>
#include <cstddef>

namespace nearfield::render {

ExportPipelines::ExportPipelines(const gpu::Device& device, const graph::ComputeLayout& layout)
    : copy_back(device), field(device, layout), records(device, layout), samples(device, layout) {}

const passes::PairSearch& PipelineSet::pair_search(const device_input::PairSearchKind& kind) const {
    const auto found = std::find(device_input::pair_search_kinds.begin(),
                                 device_input::pair_search_kinds.end(), kind);
    auto& search =
        pair_searches_[static_cast<std::size_t>(found - device_input::pair_search_kinds.begin())];
    if (search) {
        return *search;
    }
    const passes::FoundPairShaders* const finding =
        kind.are_given() ? nullptr : &made(found_pair_shaders_, &instance_shaders());
    return made(search, &made(search_shaders_), finding, kind);
}

const passes::WorldQueries& PipelineSet::world_queries(device_input::WorldQuestion question) const {
    return made(world_queries_[static_cast<std::size_t>(question)], &instance_shaders(), question);
}

void PipelineSet::make(const DeviceTechniques& techniques) const {
    static_cast<void>(exports());
    if (techniques.compute) {
        static_cast<void>(masks());
        static_cast<void>(fields());
        static_cast<void>(pair_poses());
        static_cast<void>(export_pairs());
        for (const device_input::PairSearchKind& kind : device_input::pair_search_kinds) {
            static_cast<void>(pair_search(kind));
        }
        for (std::size_t question = 0; question < device_input::world_questions; ++question) {
            static_cast<void>(world_queries(static_cast<device_input::WorldQuestion>(question)));
        }
    }
}

}  // namespace nearfield::render
