#include <engine/base/catch_to_status.hpp>
#include <engine/batch/context_implementation.hpp>
#include <nearfield/diagnostics.hpp>

namespace nearfield {

/// Lets the functions that are no members reach what a context consists of.
struct ContextAccess {
    [[nodiscard]] static auto& implementation(Context& context) { return *context.implementation_; }
    [[nodiscard]] static const auto& implementation(const Context& context) {
        return *context.implementation_;
    }
};

Expected<std::string> describe_graph(const Context& context, GraphFormat format) {
    return catch_to_expected([&] {
        if (format != GraphFormat::text && format != GraphFormat::graphviz) {
            throw StatusException(
                {StatusCode::invalid_settings, "the format of a graph is no enumerator: " +
                                                   std::to_string(static_cast<int>(format))});
        }
        const render::Renderer* const renderer = ContextAccess::implementation(context).renderer();
        return renderer == nullptr ? std::string() : renderer->print(format);
    });
}

Expected<std::vector<TileReport>> list_tiles(const Context& context) {
    return catch_to_expected([&] {
        std::vector<TileReport> tiles;
        ContextAccess::implementation(context).ring().list_tiles(tiles);
        return tiles;
    });
}

Expected<std::uint32_t> reload_shaders([[maybe_unused]] Context& context,
                                       [[maybe_unused]] const char* folder) {
#ifdef NEARFIELD_SHADER_RELOAD
    auto& implementation = ContextAccess::implementation(context);
    return implementation.unless_lost([&] { return implementation.reload_shaders(folder); });
#else
    return Status(StatusCode::unavailable,
                  "shaders cannot be reloaded: the library was built without the CMake option "
                  "NEARFIELD_SHADER_RELOAD");
#endif
}

}  // namespace nearfield
