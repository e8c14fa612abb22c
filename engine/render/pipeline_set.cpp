#include <engine/render/pipeline_set.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace nearfield::render {

ExportPipelines::ExportPipelines(const gpu::Device& device, const graph::ComputeLayout& layout)
    : copy_back(device),
      copy_header(device),
      field(device, layout),
      records(device, layout),
      samples(device, layout) {}

const passes::PairSearch& PipelineSet::pair_search(const device_input::PairSearchKind& kind) const {
    const auto found = std::find(device_input::pair_search_kinds.begin(),
                                 device_input::pair_search_kinds.end(), kind);
    auto& search =
        pair_searches_[static_cast<std::size_t>(found - device_input::pair_search_kinds.begin())];
    if (search) {
        return *search;
    }
    const passes::FoundPairShaders* const finding =
        kind.are_given() ? nullptr : &found_pair_shaders();
    return made(search, &made(search_shaders_), finding, kind);
}

const passes::WorldQueries& PipelineSet::world_queries(device_input::WorldQuestion question) const {
    return made(world_queries_[static_cast<std::size_t>(question)], &instance_shaders(), question);
}

void PipelineSet::make(const DeviceTechniques& techniques, Jobs& jobs,
                       const std::function<void()>& others) const {
    std::vector<std::function<void()>> parts;
    const auto add = [&parts](auto make_part) {
        parts.emplace_back([make_part] { static_cast<void>(make_part()); });
    };
    const auto make_parts = [&] {
        const auto count =
            static_cast<std::uint32_t>(std::min<std::size_t>(parts.size(), jobs.count()));
        jobs.run(count, [&](std::uint32_t job) {
            for (std::size_t i = job; i < parts.size(); i += count) {
                parts[i]();
            }
        });
        parts.clear();
    };
    parts.push_back(others);
    add([this] { return &exports(); });
    if (techniques.compute) {
        add([this] { return &found_pair_shaders(); });
        add([this] { return &made(search_shaders_); });
        add([this] { return &fields(); });
        add([this] { return &masks(); });
        add([this] { return &pair_poses(); });
        add([this] { return &export_pairs(); });
    }
    make_parts();
    if (techniques.compute) {  // of what was made above
        for (const device_input::PairSearchKind& kind : device_input::pair_search_kinds) {
            add([this, kind] { return &pair_search(kind); });
        }
        for (std::size_t i = 0; i < device_input::world_questions; ++i) {
            add([this, i] { return &world_queries(static_cast<device_input::WorldQuestion>(i)); });
        }
        make_parts();
    }
}

}  // namespace nearfield::render
