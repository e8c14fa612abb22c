#include <engine/graph/bake.hpp>
#include <engine/graph/print.hpp>

#include <gtest/gtest.h>
#include <tests/unit/graph/support.hpp>

namespace nearfield::graph::testing {
namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t number = 0;
    for (std::size_t at = text.find(part); at != std::string::npos;
         at = text.find(part, at + part.size())) {
        ++number;
    }
    return number;
}

/// Checks the quoting and nesting of a DOT text: every quote is closed on its line, and outside of
/// quotes every bracket and brace has its partner.
void expect_well_formed(const std::string& dot) {
    bool quoted = false;
    std::string open;
    for (std::size_t i = 0; i < dot.size(); ++i) {
        const char character = dot[i];
        if (quoted) {
            ASSERT_NE(character, '\n') << "a quote left open in: " << dot;
            if (character == '\\') {
                ++i;
            } else if (character == '"') {
                quoted = false;
            }
        } else if (character == '"') {
            quoted = true;
        } else if (character == '{' || character == '[') {
            open += character;
        } else if (character == '}' || character == ']') {
            ASSERT_FALSE(open.empty()) << dot;
            ASSERT_EQ(open.back(), character == '}' ? '{' : '[') << dot;
            open.pop_back();
        }
    }
    EXPECT_FALSE(quoted) << dot;
    EXPECT_TRUE(open.empty()) << dot;
}

TEST(GraphPrint, MentionsEveryPassAndResource) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const RandomGraph random(seed);
        const Graph& graph = random.graph();
        const Expected<BakedGraph> baked = bake(graph);
        ASSERT_TRUE(baked.has_value()) << baked.error().text();
        const std::string text = print_text(graph, *baked);
        const std::string dot = print_graphviz(graph, *baked, "all");
        for (std::size_t i = 0; i < baked->passes.size(); ++i) {
            const std::string name =
                std::to_string(i) + ". " + graph.passes()[baked->passes[i].pass].name;
            EXPECT_TRUE(contains(text, name + " (")) << text;
            EXPECT_TRUE(contains(dot, name)) << dot;
        }
        for (const Resource& resource : graph.resources()) {
            const std::string kind = resource.is_image ? "image " : "buffer ";
            EXPECT_TRUE(contains(text, "     " + kind + resource.name() + ": ")) << text;
            EXPECT_TRUE(contains(dot, resource.name() + "\\nversion 0\"")) << dot;
        }
        std::size_t barriers = baked->to_host.size();
        for (const BakedPass& pass : baked->passes) {
            barriers += pass.barriers.size();
        }
        EXPECT_EQ(count(text, "     barrier "), barriers) << text;
        EXPECT_EQ(count(dot, "shape=box"), graph.passes().size()) << dot;
        expect_well_formed(dot);
    }
}

TEST(GraphPrint, SaysWhatWasBaked) {
    Graph graph;
    const Handle sign = color(graph, "sign", VK_FORMAT_R32_UINT, {48, 32});
    const Handle records = graph.import_buffer({.name = "records", .read_by_host = true});
    static_cast<void>(color(graph, "spare"));
    add_pass(graph, "resolve", PassKind::compute,
             {reads(next(sign), Access::sampled_in_compute),
              writes(records, Access::storage_write_in_compute)});
    add_pass(graph, "fill", PassKind::graphics, {writes(sign, Access::color_attachment)});
    const Expected<BakedGraph> baked = bake(graph);
    ASSERT_TRUE(baked.has_value()) << baked.error().text();
    EXPECT_EQ(print_text(graph, *baked),
              "passes\n"
              "0. fill (graphics, 48 x 32)\n"
              "     barrier sign: compute (none) -> color-output (color-read+color-write), layout "
              "undefined -> color-attachment\n"
              "     write sign 0 -> 1 as color_attachment\n"
              "     attachment sign: color_attachment, no load, store\n"
              "1. resolve (compute)\n"
              "     barrier sign: color-output (color-write) -> compute (shader-read), layout "
              "color-attachment -> shader-read-only\n"
              "     read sign 1 as sampled_in_compute\n"
              "     write records 0 -> 1 as storage_write_in_compute\n"
              "to the host\n"
              "     barrier records: compute (shader-write) -> host (host-read)\n"
              "resources, 1 memory slots\n"
              "     image sign: R32_UINT, 48 x 32, passes 0 to 1, memory slot 0, usage "
              "sampled+color-attachment\n"
              "     buffer records: read by the host, passes 1 to 1\n"
              "     image spare: R8_UNORM, 16 x 16, unused\n");
    const std::string dot = print_graphviz(graph, *baked, "all");
    EXPECT_TRUE(contains(dot, "resource_0_0 [shape=ellipse, style=dotted")) << dot;
    EXPECT_TRUE(contains(dot, "pass_0 -> resource_0_1 [label=\"color_attachment\"]")) << dot;
    EXPECT_TRUE(contains(dot, "resource_0_1 -> pass_1 [label=\"sampled_in_compute\"]")) << dot;
}

TEST(GraphPrint, EscapesNames) {
    Graph graph;
    const Handle image = color(graph, "the \"sign\" \\");
    add_pass(graph, "fill\n\"all\" }", PassKind::graphics,
             {writes(image, Access::color_attachment)});
    const Expected<BakedGraph> baked = bake(graph);
    ASSERT_TRUE(baked.has_value()) << baked.error().text();
    const std::string dot = print_graphviz(graph, *baked, "all");
    expect_well_formed(dot);
    EXPECT_TRUE(contains(dot, R"(the \"sign\" \\)")) << dot;
    EXPECT_TRUE(contains(dot, R"(fill\n\"all\" })")) << dot;
}

}  // namespace
}  // namespace nearfield::graph::testing
