#include <passes/drawing.hpp>

#include <utility>

namespace nearfield::passes {

graph::Handle add_drawing(TileGraph& graph, const char* name,
                          std::initializer_list<graph::Read> reads, graph::ImageDescription image,
                          graph::ImageDescription tested, TileGraph::Record record) {
    graph::Handle drawn = graph.create_image(std::move(image));
    graph.add_pass(
        name, graph::PassKind::graphics,
        [&](graph::PassBuilder& pass) {
            pass.read(reads);
            drawn = pass.write(drawn, graph::Access::color_attachment);
            if (tested.format != VK_FORMAT_UNDEFINED) {
                static_cast<void>(pass.write(graph.create_image(std::move(tested)),
                                             graph::Access::depth_stencil_attachment));
            }
        },
        std::move(record));
    return drawn;
}

}  // namespace nearfield::passes
