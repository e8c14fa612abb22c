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

TEST(GraphErrors, CycleIsNamedWithoutPassesThatAreNotPartOfIt) {
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
    expect_refused(graph, {"cycle", "'early'", "'late'", "'left'", "'right'", "version 1"});
    EXPECT_EQ(bake(graph).error().message().find("'innocent'"), std::string::npos);
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

/// Expects that a graph with one pass, and resources of some kinds, is rejected.
class GraphErrorsOfAPass : public ::testing::Test {
protected:
    void expect_refused(const std::string& name, PassKind kind, const std::vector<Use>& uses,
                        std::vector<std::string> words) const {
        Graph graph = resources_;
        add_pass(graph, name, kind, uses);
        words.push_back("'" + name + "'");
        testing::expect_refused(graph, words);
    }

    Graph resources_;
    const Handle sign_ = color(resources_, "sign");
    const Handle wide_ = color(resources_, "wide", VK_FORMAT_R8_UNORM, {64, 32});
    const Handle near_ = color(resources_, "near", VK_FORMAT_D32_SFLOAT);
    const Handle far_ = color(resources_, "far", VK_FORMAT_D32_SFLOAT);
    const Handle edges_ = resources_.import_buffer({.name = "edges", .written_by_host = true});
    const Handle list_ = resources_.import_buffer({.name = "list", .written_by_host = false});
};

TEST_F(GraphErrorsOfAPass, AVersionThatNobodyWrote) {
    expect_refused("resolve", PassKind::compute, {reads(sign_, Access::sampled_in_compute)},
                   {"version 0", "'sign'", "nobody wrote"});
    expect_refused("count", PassKind::compute, {reads(list_, Access::storage_read_in_compute)},
                   {"version 0", "'list'", "nobody wrote"});
    expect_refused("fill", PassKind::graphics, {writes({sign_.resource, 3}, color_access)},
                   {"on top of version 3", "'sign'", "nobody wrote"});
}

TEST_F(GraphErrorsOfAPass, AccessForTheOtherKindOfResource) {
    expect_refused("list", PassKind::compute, {writes(sign_, Access::storage_write_in_compute)},
                   {"'sign'", "storage_write_in_compute", "is an image"});
    expect_refused("look", PassKind::compute, {reads(edges_, Access::sampled_in_compute)},
                   {"'edges'", "sampled_in_compute", "is a buffer"});
}

TEST_F(GraphErrorsOfAPass, AccessForTheOtherKindOfPass) {
    expect_refused("fill", PassKind::compute, {writes(sign_, color_access)},
                   {"'sign'", "color_attachment", "compute pass"});
    expect_refused("draw", PassKind::graphics, {reads(edges_, Access::storage_read_in_compute)},
                   {"'edges'", "storage_read_in_compute", "graphics pass"});
}

TEST_F(GraphErrorsOfAPass, ReadAndWriteMixedUp) {
    expect_refused("fill", PassKind::graphics, {reads(sign_, color_access)},
                   {"'sign'", "color_attachment", "as a read"});
    expect_refused("list", PassKind::compute, {writes(edges_, Access::storage_read_in_compute)},
                   {"'edges'", "storage_read_in_compute", "as a write"});
}

TEST_F(GraphErrorsOfAPass, FormatWithoutTheAspect) {
    expect_refused("fill", PassKind::graphics, {writes(near_, color_access)},
                   {"'near'", "no colour"});
    expect_refused("cones", PassKind::graphics, {writes(sign_, depth_access)},
                   {"'sign'", "neither depth nor stencil"});
}

TEST_F(GraphErrorsOfAPass, Attachments) {
    expect_refused("fill", PassKind::graphics,
                   {writes(sign_, color_access), writes(wide_, color_access)},
                   {"'sign'", "'wide'", "16 x 16", "64 x 32"});
    expect_refused("cones", PassKind::graphics,
                   {writes(near_, depth_access), writes(far_, depth_access)},
                   {"'near'", "'far'", "two depth-stencil"});
    expect_refused("draw", PassKind::graphics, {reads(edges_, Access::vertex_buffer)},
                   {"no attachment"});
}

TEST_F(GraphErrorsOfAPass, OneResourceTwiceOrNone) {
    expect_refused("list", PassKind::compute,
                   {reads(edges_, Access::storage_read_in_compute),
                    writes(edges_, Access::storage_write_in_compute)},
                   {"'edges'", "twice"});
    expect_refused("list", PassKind::compute, {reads(Handle{}, Access::storage_read_in_compute)},
                   {"no resource"});
}

}  // namespace
}  // namespace nearfield::graph::testing
