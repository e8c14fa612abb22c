#include <engine/base/status_exception.hpp>
#include <engine/geometry/mesh.hpp>
#include <engine/gpu/pipeline.hpp>

#include <gtest/gtest.h>
#include <tests/support/fake_loader.hpp>
#include <tests/unit/gpu/canvas.hpp>
#include <tests/unit/gpu/fixture.hpp>
#include <tests/unit/gpu/shaders.hpp>

#include <array>
#include <cstring>
#include <random>
#include <vector>

namespace nearfield {
namespace {

using geometry::MeshVertex;
using test_support::Canvas;

constexpr std::uint32_t size = Canvas::size;

class GpuPipeline : public test_support::GpuTest {
protected:
    GpuPipeline() : device_(host_.device()) {}

    gpu::Device device_;
};

/// Pixels [left, right) x [bottom, top) as two triangles with either winding.
struct Rectangle {
    std::uint32_t left, bottom, right, top;
    float depth;
    std::uint32_t id;
    bool flipped;

    [[nodiscard]] bool covers(std::uint32_t x, std::uint32_t y) const {
        return x >= left && x < right && y >= bottom && y < top;
    }
};

Rectangle random_rectangle(std::mt19937& random, std::uint32_t id) {
    std::uniform_int_distribution<std::uint32_t> corner(0, size);
    const auto [left, right] = std::minmax({corner(random), corner(random)});
    const auto [bottom, top] = std::minmax({corner(random), corner(random)});
    std::uniform_int_distribution<int> depth(1, 9);
    return {left, bottom,           right, top, static_cast<float>(depth(random)) / 10.0F,
            id,   depth(random) > 4};
}

void append(std::vector<MeshVertex>& mesh, const Rectangle& rectangle) {
    const auto clip = [](std::uint32_t pixel) {
        return 2.0F * static_cast<float>(pixel) / static_cast<float>(size) - 1.0F;
    };
    const auto corner = [&](std::uint32_t x, std::uint32_t y) {
        return MeshVertex{clip(x), clip(y), rectangle.depth, rectangle.id};
    };
    std::array<MeshVertex, 4> corners{
        corner(rectangle.left, rectangle.bottom), corner(rectangle.right, rectangle.bottom),
        corner(rectangle.right, rectangle.top), corner(rectangle.left, rectangle.top)};
    if (rectangle.flipped) {
        std::swap(corners[1], corners[3]);
    }
    for (const std::size_t index : {0U, 1U, 2U, 0U, 2U, 3U}) {
        mesh.push_back(corners[index]);
    }
}

gpu::MappedBuffer upload(const gpu::Device& device, const std::vector<MeshVertex>& mesh) {
    gpu::MappedBuffer buffer(device, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, gpu::Direction::upload,
                             "mesh");
    buffer.reserve(mesh.size() * sizeof(MeshVertex));
    std::memcpy(buffer.data(), mesh.data(), mesh.size() * sizeof(MeshVertex));
    buffer.flush();
    return buffer;
}

gpu::GraphicsPipelineDescription description(const Canvas& canvas, const char* name) {
    gpu::GraphicsPipelineDescription what;
    what.name = name;
    what.render_pass = canvas.render_pass();
    what.layout = canvas.layout();
    what.vertex_shader = test_shaders::mesh_vertex;
    what.fragment_shader = test_shaders::write_id;
    return what;
}

void draw(const gpu::Functions& functions, VkCommandBuffer commands, VkPipeline pipeline,
          VkBuffer mesh, std::uint32_t first, std::uint32_t count) {
    const VkDeviceSize offset = 0;
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    functions.vkCmdBindVertexBuffers(commands, 0, 1, &mesh, &offset);
    functions.vkCmdDraw(commands, count, 1, first, 0);
}

void set_stencil(const gpu::Functions& functions, VkCommandBuffer commands,
                 std::uint32_t compare_mask, std::uint32_t write_mask) {
    functions.vkCmdSetStencilCompareMask(commands, VK_STENCIL_FACE_FRONT_AND_BACK, compare_mask);
    functions.vkCmdSetStencilWriteMask(commands, VK_STENCIL_FACE_FRONT_AND_BACK, write_mask);
    functions.vkCmdSetStencilReference(commands, VK_STENCIL_FACE_FRONT_AND_BACK, 0);
}

TEST_F(GpuPipeline, NearestOfRectanglesWinsByDepth) {
    Canvas canvas(device_);
    gpu::GraphicsPipelineDescription what = description(canvas, "nearest id");
    what.depth_test = true;
    what.depth_compare = VK_COMPARE_OP_LESS;
    const gpu::Owned<VkPipeline> pipeline = gpu::make_graphics_pipeline(device_, what);
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937 random(seed);
        std::vector<MeshVertex> mesh;
        std::vector<std::uint32_t> expected(std::size_t{size} * size);
        std::vector<float> depths(expected.size(), 1.0F);
        for (std::uint32_t id = 1; id <= 10; ++id) {
            const Rectangle rectangle = random_rectangle(random, id);
            append(mesh, rectangle);
            for (std::uint32_t i = 0; i < expected.size(); ++i) {
                if (rectangle.covers(i % size, i / size) && rectangle.depth < depths[i]) {
                    depths[i] = rectangle.depth;
                    expected[i] = id;
                }
            }
        }
        const gpu::MappedBuffer buffer = upload(device_, mesh);
        EXPECT_EQ(canvas.draw([&](VkCommandBuffer commands) {
            draw(device_.functions(), commands, pipeline.get(), buffer.handle(), 0,
                 static_cast<std::uint32_t>(mesh.size()));
        }),
                  expected);
    }
}

TEST_F(GpuPipeline, StencilParityFillsWhatIsCoveredAnOddNumberOfTimes) {
    Canvas canvas(device_);
    gpu::GraphicsPipelineDescription parity = description(canvas, "parity");
    parity.fragment_shader = {};
    parity.stencil_test = true;
    parity.stencil_pass = VK_STENCIL_OP_INVERT;
    const gpu::Owned<VkPipeline> invert = gpu::make_graphics_pipeline(device_, parity);
    gpu::GraphicsPipelineDescription cover = description(canvas, "cover");
    cover.stencil_test = true;
    cover.stencil_compare = VK_COMPARE_OP_NOT_EQUAL;
    const gpu::Owned<VkPipeline> fill = gpu::make_graphics_pipeline(device_, cover);
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937 random(seed);
        std::vector<MeshVertex> mesh;
        std::vector<std::uint32_t> expected(std::size_t{size} * size);
        for (std::uint32_t id = 1; id <= 7; ++id) {
            const Rectangle rectangle = random_rectangle(random, id);
            append(mesh, rectangle);
            for (std::uint32_t i = 0; i < expected.size(); ++i) {
                expected[i] ^= rectangle.covers(i % size, i / size) ? 1000U : 0U;
            }
        }
        const auto edges = static_cast<std::uint32_t>(mesh.size());
        append(mesh, {0, 0, size, size, 0.5F, 1000, false});
        const gpu::MappedBuffer buffer = upload(device_, mesh);
        EXPECT_EQ(canvas.draw([&](VkCommandBuffer commands) {
            // Parity needs only one bit; the other seven belong to other masks.
            set_stencil(device_.functions(), commands, 0x04, 0x04);
            draw(device_.functions(), commands, invert.get(), buffer.handle(), 0, edges);
            draw(device_.functions(), commands, fill.get(), buffer.handle(), edges, 6);
        }),
                  expected);
        EXPECT_EQ(canvas.draw([&](VkCommandBuffer commands) {
            set_stencil(device_.functions(), commands, 0xFB, 0x04);
            draw(device_.functions(), commands, invert.get(), buffer.handle(), 0, edges);
            draw(device_.functions(), commands, fill.get(), buffer.handle(), edges, 6);
        }),
                  std::vector<std::uint32_t>(expected.size()));
    }
}

// Vertex attributes that a pass does not use are not an error.
TEST_F(GpuPipeline, ShaderMayUseThePositionAlone) {
    Canvas canvas(device_);
    gpu::GraphicsPipelineDescription what = description(canvas, "position only");
    what.vertex_shader = test_shaders::position_only;
    what.fragment_shader = {};
    EXPECT_TRUE(gpu::make_graphics_pipeline(device_, what));
}

VkResult VKAPI_CALL refused(VkDevice, VkPipelineCache, std::uint32_t,
                            const VkComputePipelineCreateInfo*, const VkAllocationCallbacks*,
                            VkPipeline*) {
    return VK_ERROR_OUT_OF_HOST_MEMORY;
}

TEST_F(GpuPipeline, FailureNamesThePipeline) {
    test_support::Lies lies;
    lies.entry_points["vkCreateComputePipelines"] = reinterpret_cast<PFN_vkVoidFunction>(&refused);
    const test_support::FakeLoader fake(host_.device(), lies);
    const gpu::Device device(fake.host());
    try {
        (void)gpu::make_compute_pipeline(device, VK_NULL_HANDLE, test_shaders::double_and_add_one,
                                         "resolve");
        FAIL() << "no Failure";
    } catch (const StatusException& failure) {
        EXPECT_EQ(failure.status().code(), StatusCode::out_of_memory);
        EXPECT_EQ(failure.status().message(),
                  "vkCreateComputePipelines failed with VK_ERROR_OUT_OF_HOST_MEMORY for pipeline "
                  "'resolve'");
    }
}

}  // namespace
}  // namespace nearfield
