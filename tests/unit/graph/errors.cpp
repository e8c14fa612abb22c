#include <engine/graph/bake.hpp>

#include <gtest/gtest.h>
#include <tests/unit/graph/support.hpp>

namespace nearfield::graph::testing {
namespace {

/// Expects that the graph is rejected with a message that contains all the words.
void expect_refused(const Graph& graph, const std::vector<std::string>& words) {
    const Expected<BakedGraph> baked = bake(graph);
    ASSERT_FALSE(baked.has_value());
    EXPECT_FALSE(baked.error().ok());
    for (const std::string& word : words) {
        EXPECT_NE(baked.error().message().find(word), std::string::npos)
            << "'" << word << "' is missing in: " << baked.error().message();
    }
}

constexpr Access color_access = Access::color_attachment;
constexpr Access depth_access = Access::depth_stencil_attachment;

TEST(GraphErrors, Cycle) {
    Graph graph;
    const Handle a = graph.import_buffer({.name = "left"});
    const Handle b = graph.import_buffer({.name = "right"});
    add_pass(graph, "early", PassKind::compute,
             {reads(next(b), Access::storage_read_in_compute),
              writes(a, Access::storage_write_in_compute)});
    add_pass(graph, "late", PassKind::compute,
             {reads(next(a), Access::storage_read_in_compute),
              writes(b, Access::storage_write_in_compute)});
    expect_refused(graph, {"cycle", "'early'", "'late'", "'left'", "'right'", "version 1"});
}

TEST(GraphErrors, CycleBehindPassesThatAreNotPartOfIt) {
    Graph graph;
    const Handle a = graph.import_buffer({.name = "left"});
    const Handle b = graph.import_buffer({.name = "right"});
    const Handle c = graph.import_buffer({.name = "aside"});
    add_pass(graph, "innocent", PassKind::compute,
             {reads(next(a), Access::storage_read_in_compute),
              writes(c, Access::storage_write_in_compute)});
    add_pass(graph, "early", PassKind::compute,
             {reads(next(b), Access::storage_read_in_compute),
              writes(a, Access::storage_write_in_compute)});
    add_pass(graph, "late", PassKind::compute,
             {reads(next(a), Access::storage_read_in_compute),
              writes(b, Access::storage_write_in_compute)});
    expect_refused(graph, {"cycle", "'early'", "'late'"});
    EXPECT_EQ(bake(graph).error().message().find("'innocent'"), std::string::npos);
}

TEST(GraphErrors, ReadOfImageThatNobodyWrote) {
    Graph graph;
    const Handle image = color(graph, "sign");
    add_pass(graph, "resolve", PassKind::compute, {reads(image, Access::sampled_in_compute)});
    expect_refused(graph, {"'resolve'", "version 0", "'sign'", "nobody wrote"});
}

TEST(GraphErrors, ReadOfBufferThatNobodyWrote) {
    Graph graph;
    const Handle buffer = graph.import_buffer({.name = "edges", .written_by_host = false});
    add_pass(graph, "list", PassKind::compute, {reads(buffer, Access::storage_read_in_compute)});
    expect_refused(graph, {"'list'", "version 0", "'edges'", "nobody wrote"});
}

TEST(GraphErrors, WriteOnTopOfVersionThatNobodyWrote) {
    Graph graph;
    const Handle image = color(graph, "sign");
    add_pass(graph, "fill", PassKind::graphics, {writes({image.resource, 3}, color_access)});
    expect_refused(graph, {"'fill'", "on top of version 3", "'sign'", "nobody wrote"});
}

TEST(GraphErrors, TwoWritersOfOneVersion) {
    Graph graph;
    const Handle image = color(graph, "sign");
    add_pass(graph, "fill", PassKind::graphics, {writes(image, color_access)});
    add_pass(graph, "refill", PassKind::graphics, {writes(image, color_access)});
    expect_refused(graph, {"'fill'", "'refill'", "both write", "version 0", "'sign'"});
}

TEST(GraphErrors, StaleHandle) {
    Graph graph;
    const Handle sign = color(graph, "sign");
    const Handle records = graph.import_buffer({.name = "records"});
    add_pass(graph, "fill", PassKind::graphics, {writes(sign, color_access)});
    add_pass(graph, "refill", PassKind::graphics, {writes(next(sign), color_access)});
    add_pass(graph, "resolve", PassKind::compute,
             {reads(next(next(sign)), Access::sampled_in_compute),
              writes(records, Access::storage_write_in_compute)});
    const Handle wanted = next(sign);
    add_pass(graph, "late", PassKind::compute,
             {reads(next(records), Access::storage_read_in_compute),
              reads(wanted, Access::sampled_in_compute)});
    expect_refused(graph, {"'late'", "'sign'", "version 1", "'refill'", "stale"});
}

TEST(GraphErrors, AccessForTheOtherKindOfResource) {
    Graph images;
    const Handle image = color(images, "sign");
    add_pass(images, "list", PassKind::compute, {writes(image, Access::storage_write_in_compute)});
    expect_refused(images, {"'list'", "'sign'", "storage_write_in_compute", "is an image"});

    Graph buffers;
    const Handle buffer = buffers.import_buffer({.name = "edges", .written_by_host = true});
    add_pass(buffers, "look", PassKind::compute, {reads(buffer, Access::sampled_in_compute)});
    expect_refused(buffers, {"'look'", "'edges'", "sampled_in_compute", "is a buffer"});
}

TEST(GraphErrors, AccessForTheOtherKindOfPass) {
    Graph compute;
    const Handle image = color(compute, "sign");
    add_pass(compute, "fill", PassKind::compute, {writes(image, color_access)});
    expect_refused(compute, {"'fill'", "'sign'", "color_attachment", "compute pass"});

    Graph graphics;
    const Handle buffer = graphics.import_buffer({.name = "edges", .written_by_host = true});
    add_pass(graphics, "draw", PassKind::graphics,
             {reads(buffer, Access::storage_read_in_compute)});
    expect_refused(graphics, {"'draw'", "'edges'", "storage_read_in_compute", "graphics pass"});
}

TEST(GraphErrors, ReadAndWriteMixedUp) {
    Graph reading;
    const Handle image = color(reading, "sign");
    add_pass(reading, "fill", PassKind::graphics, {reads(image, color_access)});
    expect_refused(reading, {"'fill'", "'sign'", "color_attachment", "as a read"});

    Graph writing;
    const Handle buffer = writing.import_buffer({.name = "edges", .written_by_host = true});
    add_pass(writing, "list", PassKind::compute, {writes(buffer, Access::storage_read_in_compute)});
    expect_refused(writing, {"'list'", "'edges'", "storage_read_in_compute", "as a write"});
}

TEST(GraphErrors, FormatWithoutTheAspect) {
    Graph depth_as_color;
    const Handle depth = color(depth_as_color, "distance", VK_FORMAT_D32_SFLOAT);
    add_pass(depth_as_color, "fill", PassKind::graphics, {writes(depth, color_access)});
    expect_refused(depth_as_color, {"'fill'", "'distance'", "no colour"});

    Graph color_as_depth;
    const Handle image = color(color_as_depth, "sign", VK_FORMAT_R32_UINT);
    add_pass(color_as_depth, "cones", PassKind::graphics, {writes(image, depth_access)});
    expect_refused(color_as_depth, {"'cones'", "'sign'", "neither depth nor stencil"});
}

TEST(GraphErrors, UnknownFormatAndEmptyExtent) {
    Graph undefined;
    static_cast<void>(color(undefined, "sign", VK_FORMAT_UNDEFINED));
    expect_refused(undefined, {"'sign'", "format number 0"});

    Graph compressed;
    static_cast<void>(color(compressed, "sign", VK_FORMAT_BC7_UNORM_BLOCK));
    expect_refused(compressed, {"'sign'", "format number"});

    Graph empty;
    static_cast<void>(color(empty, "sign", VK_FORMAT_R8_UNORM, {16, 0}));
    expect_refused(empty, {"'sign'", "empty", "16 x 0"});
}

TEST(GraphErrors, AttachmentsOfTwoExtents) {
    Graph graph;
    const Handle large = color(graph, "large", VK_FORMAT_R8_UNORM, {64, 64});
    const Handle flat = color(graph, "flat", VK_FORMAT_R8_UNORM, {64, 32});
    add_pass(graph, "fill", PassKind::graphics,
             {writes(large, color_access), writes(flat, color_access)});
    expect_refused(graph, {"'fill'", "'large'", "'flat'", "64 x 64", "64 x 32"});
}

TEST(GraphErrors, TwoDepthStencilAttachments) {
    Graph graph;
    const Handle a = color(graph, "near", VK_FORMAT_D32_SFLOAT);
    const Handle b = color(graph, "far", VK_FORMAT_D32_SFLOAT);
    add_pass(graph, "cones", PassKind::graphics,
             {writes(a, depth_access), writes(b, depth_access)});
    expect_refused(graph, {"'cones'", "'near'", "'far'", "two depth-stencil"});
}

TEST(GraphErrors, GraphicsPassWithoutAttachment) {
    Graph graph;
    const Handle buffer = graph.import_buffer({.name = "edges", .written_by_host = true});
    add_pass(graph, "draw", PassKind::graphics, {reads(buffer, Access::vertex_buffer)});
    expect_refused(graph, {"'draw'", "no attachment"});
}

TEST(GraphErrors, OneResourceTwiceInAPass) {
    Graph graph;
    const Handle buffer = graph.import_buffer({.name = "edges", .written_by_host = true});
    add_pass(graph, "list", PassKind::compute,
             {reads(buffer, Access::storage_read_in_compute),
              writes(buffer, Access::storage_write_in_compute)});
    expect_refused(graph, {"'list'", "'edges'", "twice"});
}

TEST(GraphErrors, HandleOfNoResource) {
    Graph graph;
    add_pass(graph, "list", PassKind::compute, {reads(Handle{}, Access::storage_read_in_compute)});
    expect_refused(graph, {"'list'", "no resource"});
}

}  // namespace
}  // namespace nearfield::graph::testing
