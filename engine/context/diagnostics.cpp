#include <engine/context/implementation.hpp>
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
    std::string text;
    Status status = catch_to_status([&] {
        if (format != GraphFormat::text && format != GraphFormat::graphviz) {
            throw StatusException(
                {StatusCode::invalid_settings, "the format of a graph is no enumerator: " +
                                                   std::to_string(static_cast<int>(format))});
        }
        const render::Renderer* const renderer = ContextAccess::implementation(context).renderer();
        if (renderer != nullptr) {
            text = renderer->print(format);
        }
    });
    return status.ok() ? Expected<std::string>(std::move(text)) : status;
}

Expected<std::vector<TileReport>> list_tiles(const Context& context) {
    std::vector<TileReport> tiles;
    Status status =
        catch_to_status([&] { ContextAccess::implementation(context).ring().list_tiles(tiles); });
    return status.ok() ? Expected<std::vector<TileReport>>(std::move(tiles)) : status;
}

Expected<std::uint32_t> reload_shaders([[maybe_unused]] Context& context,
                                       [[maybe_unused]] const char* folder) {
#ifdef NEARFIELD_SHADER_RELOAD
    auto& implementation = ContextAccess::implementation(context);
    std::uint32_t changed = 0;
    Status status =
        implementation.unless_lost([&] { changed = implementation.reload_shaders(folder); });
    return status.ok() ? Expected<std::uint32_t>(changed) : status;
#else
    return Status(StatusCode::unavailable,
                  "shaders cannot be reloaded: the library was built without the CMake option "
                  "NEARFIELD_SHADER_RELOAD");
#endif
}

}  // namespace nearfield
