// Shows where the time of a frame goes, as tables in Markdown: times by stage and by pass, and the
// counted calls to the device; for comparison the time of an empty submission.

#include <engine/gpu/device.hpp>
#include <engine/gpu/headless.hpp>
#include <engine/gpu/submission.hpp>
#include <nearfield/vulkan.hpp>

#include <tests/bench/bench.hpp>
#include <tests/support/fake_loader.hpp>
#include <tests/support/outlines.hpp>
#include <tests/support/polygons.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace {

using nearfield::bench::require;
using nearfield::bench::take;

using nearfield::Batch;
using nearfield::Context;
using nearfield::Technique;

constexpr int warm_up = 3;
constexpr int frames = 15;

// The calls to the device in a frame. Entry points carry no user data, so this is global.
struct Counts {
    std::uint64_t submissions = 0, render_passes = 0, draws = 0, triangles = 0, dispatches = 0;
    std::uint64_t groups = 0, state_changes = 0, barriers = 0;
    /// By buffer and bound range: a range shared by several passes counts once.
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint64_t> bytes_by_part;
};
Counts counts;

/// The driver's own entry point with this name.
template <class Function>
Function below(const char* name) {
    return reinterpret_cast<Function>(nearfield::test_support::true_device_function(name));
}

VkResult VKAPI_CALL submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                           VkFence fence) {
    ++counts.submissions;
    static const auto next = below<PFN_vkQueueSubmit>("vkQueueSubmit");
    return next(queue, count, infos, fence);
}
void VKAPI_CALL begin_render_pass(VkCommandBuffer commands, const VkRenderPassBeginInfo* info,
                                  VkSubpassContents contents) {
    ++counts.render_passes;
    static const auto next = below<PFN_vkCmdBeginRenderPass>("vkCmdBeginRenderPass");
    next(commands, info, contents);
}
void VKAPI_CALL draw(VkCommandBuffer commands, std::uint32_t vertices, std::uint32_t instances,
                     std::uint32_t first, std::uint32_t first_instance) {
    ++counts.draws;
    counts.triangles += vertices / 3;
    static const auto next = below<PFN_vkCmdDraw>("vkCmdDraw");
    next(commands, vertices, instances, first, first_instance);
}
void VKAPI_CALL dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y,
                         std::uint32_t z) {
    ++counts.dispatches;
    counts.groups += std::uint64_t{x} * y * z;
    static const auto next = below<PFN_vkCmdDispatch>("vkCmdDispatch");
    next(commands, x, y, z);
}
void VKAPI_CALL bind_pipeline(VkCommandBuffer commands, VkPipelineBindPoint point,
                              VkPipeline pipeline) {
    ++counts.state_changes;
    static const auto next = below<PFN_vkCmdBindPipeline>("vkCmdBindPipeline");
    next(commands, point, pipeline);
}
void VKAPI_CALL push_constants(VkCommandBuffer commands, VkPipelineLayout layout,
                               VkShaderStageFlags stages, std::uint32_t offset, std::uint32_t size,
                               const void* values) {
    ++counts.state_changes;
    static const auto next = below<PFN_vkCmdPushConstants>("vkCmdPushConstants");
    next(commands, layout, stages, offset, size, values);
}
void VKAPI_CALL set_scissor(VkCommandBuffer commands, std::uint32_t first, std::uint32_t count,
                            const VkRect2D* scissors) {
    ++counts.state_changes;
    static const auto next = below<PFN_vkCmdSetScissor>("vkCmdSetScissor");
    next(commands, first, count, scissors);
}
void VKAPI_CALL set_viewport(VkCommandBuffer commands, std::uint32_t first, std::uint32_t count,
                             const VkViewport* viewports) {
    ++counts.state_changes;
    static const auto next = below<PFN_vkCmdSetViewport>("vkCmdSetViewport");
    next(commands, first, count, viewports);
}
void VKAPI_CALL barrier(VkCommandBuffer commands, VkPipelineStageFlags from,
                        VkPipelineStageFlags to, VkDependencyFlags flags,
                        std::uint32_t memory_count, const VkMemoryBarrier* memory,
                        std::uint32_t buffer_count, const VkBufferMemoryBarrier* buffers,
                        std::uint32_t image_count, const VkImageMemoryBarrier* images) {
    ++counts.barriers;
    static const auto next = below<PFN_vkCmdPipelineBarrier>("vkCmdPipelineBarrier");
    next(commands, from, to, flags, memory_count, memory, buffer_count, buffers, image_count,
         images);
}
void VKAPI_CALL update_sets(VkDevice device, std::uint32_t count, const VkWriteDescriptorSet* sets,
                            std::uint32_t copy_count, const VkCopyDescriptorSet* copies) {
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t j = 0; sets[i].pBufferInfo != nullptr && j < sets[i].descriptorCount;
             ++j) {
            const VkDescriptorBufferInfo& part = sets[i].pBufferInfo[j];
            counts.bytes_by_part[{reinterpret_cast<std::uint64_t>(part.buffer), part.offset}] =
                part.range;
        }
    }
    static const auto next = below<PFN_vkUpdateDescriptorSets>("vkUpdateDescriptorSets");
    next(device, count, sets, copy_count, copies);
}

template <class Function>
PFN_vkVoidFunction erased(Function function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

nearfield::test_support::Lies counting() {
    nearfield::test_support::Lies lies;
    lies.entry_points = {
        {"vkQueueSubmit", erased(&submit)},
        {"vkCmdBeginRenderPass", erased(&begin_render_pass)},
        {"vkCmdDraw", erased(&draw)},
        {"vkCmdDispatch", erased(&dispatch)},
        {"vkCmdBindPipeline", erased(&bind_pipeline)},
        {"vkCmdPushConstants", erased(&push_constants)},
        {"vkCmdSetScissor", erased(&set_scissor)},
        {"vkCmdSetViewport", erased(&set_viewport)},
        {"vkCmdPipelineBarrier", erased(&barrier)},
        {"vkUpdateDescriptorSets", erased(&update_sets)},
    };
    return lies;
}

nearfield::Settings with_timestamps() {
    nearfield::Settings settings;
    settings.timestamps = true;
    return settings;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + frames / 2, values.end());
    return values[frames / 2];
}

/// A batch and the technique that answers it.
struct Scene {
    std::string name;
    Batch (*batch)(Context& context, Technique technique);
};

std::vector<nearfield::Ring> outline(const char* name) {
    return nearfield::test::read_outline(std::filesystem::path(NEARFIELD_TEST_DATA) / name).rings;
}

template <class Query>
Query coast_lines(Context& context, Technique technique) {
    Query query;
    query.a = {take(context.add_shape(outline("iceland_10m.geojson"))), {}};
    query.b = {take(context.add_shape(outline("ireland_10m.geojson"))), {{120.0, 20.0}, 0.5236}};
    query.tolerance = 0.8;
    query.technique = technique;
    return query;
}

Batch penetration(Context& context, Technique technique) {
    Batch batch;
    batch.add(coast_lines<nearfield::PenetrationQuery>(context, technique));
    return batch;
}

Batch intersection(Context& context, Technique technique) {
    Batch batch;
    auto query = coast_lines<nearfield::IntersectionQuery>(context, technique);
    query.summary_only = true;
    batch.add(query);
    return batch;
}

Batch field(Context& context, Technique technique) {
    Batch batch;
    batch.add(coast_lines<nearfield::DistanceFieldQuery>(context, technique));
    return batch;
}

/// 1,000 pairs of stars of 50 vertices, 32 x 32 cells each.
template <class Query>
Batch pairs(Context& context, Technique technique, void (*fill)(Query&)) {
    Batch batch;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        nearfield::test::Random random(i);
        Query query;
        query.a = {take(context.add_shape(nearfield::test::star(random, 50, 0.5))), {}};
        query.b = {take(context.add_shape(nearfield::test::star(random, 50, 0.5))),
                   {{0.9, 0.2}, random.between(0.0, 6.0)}};
        query.tolerance = 1.4 / 32.0 / 1.414;
        query.technique = technique;
        fill(query);
        batch.add(query);
    }
    return batch;
}

Batch penetration_pairs(Context& context, Technique technique) {
    return pairs<nearfield::PenetrationQuery>(
        context, technique, [](nearfield::PenetrationQuery& query) { query.summary_only = true; });
}

Batch field_pairs(Context& context, Technique technique) {
    return pairs<nearfield::DistanceFieldQuery>(
        context, technique, [](nearfield::DistanceFieldQuery& query) {
            query.rectangle = nearfield::Rectangle{{-0.7, -0.7}, {0.69, 0.69}};
            query.b.pose = {};
        });
}

void print_counts() {
    std::uint64_t bytes = 0;
    for (const auto& [part, range] : counts.bytes_by_part) {
        bytes += range;
    }
    std::printf("| %llu | %llu | %llu | %llu | %llu | %llu | %llu | %llu | %.2f |",
                static_cast<unsigned long long>(counts.submissions),
                static_cast<unsigned long long>(counts.render_passes),
                static_cast<unsigned long long>(counts.draws),
                static_cast<unsigned long long>(counts.triangles),
                static_cast<unsigned long long>(counts.dispatches),
                static_cast<unsigned long long>(counts.groups),
                static_cast<unsigned long long>(counts.state_changes),
                static_cast<unsigned long long>(counts.barriers), static_cast<double>(bytes) / 1e6);
}

void profile(const nearfield::HostDevice& host, const Scene& scene, Technique technique) {
    Context context = take(Context::create(host, with_timestamps()));
    const Batch batch = scene.batch(context, technique);
    nearfield::Results results;
    std::vector<nearfield::Timings> timings;
    for (int frame = -warm_up; frame < frames; ++frame) {
        counts = {};
        require(context.run(batch, results));
        for (const nearfield::AnyResult& result : results.results) {
            require(std::visit([](const auto& any) { return any.status; }, result));
        }
        if (frame >= 0) {
            timings.push_back(results.timings);
        }
    }
    const auto stage = [&](double nearfield::Timings::*member) {
        std::vector<double> values;
        for (const nearfield::Timings& frame : timings) {
            values.push_back(frame.*member);
        }
        return median(std::move(values));
    };
    std::printf("| %s | %s | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f ", scene.name.c_str(),
                to_string(technique), stage(&nearfield::Timings::total),
                stage(&nearfield::Timings::localize), stage(&nearfield::Timings::plan),
                stage(&nearfield::Timings::record), stage(&nearfield::Timings::device),
                stage(&nearfield::Timings::decode));
    print_counts();
    for (std::size_t pass = 0; pass < results.timings.passes.size(); ++pass) {
        std::vector<double> values;
        for (const nearfield::Timings& frame : timings) {
            values.push_back(frame.passes[pass].milliseconds);
        }
        std::printf("%s %s %.2f", pass == 0 ? "" : ",", results.timings.passes[pass].name.c_str(),
                    median(std::move(values)));
    }
    std::printf(" |\n");
    std::fflush(stdout);
}

void profile_empty_submission(const nearfield::HostDevice& host) {
    const nearfield::gpu::Device device(host);
    nearfield::gpu::Submission submission(device);
    std::vector<double> times;
    for (int frame = -warm_up; frame < frames; ++frame) {
        const auto start = std::chrono::steady_clock::now();
        submission.begin();
        submission.submit();
        submission.wait();
        const std::chrono::duration<double, std::milli> time =
            std::chrono::steady_clock::now() - start;
        if (frame >= 0) {
            times.push_back(time.count());
        }
    }
    std::printf("An empty submission and its fence: %.3f ms\n", median(std::move(times)));
}

}  // namespace

int main() {
    try {
        const nearfield::gpu::HeadlessDevice device({});
        profile_empty_submission(device.host());
        const nearfield::test_support::FakeLoader loader(device.host(), counting());
        std::printf(
            "\n| scene | technique | frame ms | localize | plan | record | device | decode "
            "| submissions | render passes | draws | triangles | dispatches | groups | state "
            "changes "
            "| barriers | MB bound | passes, ms |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
        for (const Scene& scene :
             {Scene{"coast lines, penetration", penetration},
              Scene{"coast lines, intersection", intersection}, Scene{"coast lines, field", field},
              Scene{"1,000 pairs, penetration", penetration_pairs},
              Scene{"1,000 small fields", field_pairs}}) {
            for (const Technique technique :
                 {Technique::raster, Technique::compute, Technique::cpu}) {
                profile(loader.host(), scene, technique);
            }
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_profile: %s\n", error.what());
        return 1;
    }
}
