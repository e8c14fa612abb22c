#include <backends/imgui_impl_sdl.h>
#include <imgui.h>
#include <tools/viewer/gui.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace nearfield::viewer {
namespace {

// Both libraries use the same vertex layout, so vertices are copied only once.
static_assert(sizeof(ImDrawVert) == sizeof(tools::MeshVertex));
static_assert(offsetof(ImDrawVert, uv) == offsetof(tools::MeshVertex, u));
static_assert(offsetof(ImDrawVert, col) == offsetof(tools::MeshVertex, color));
static_assert(sizeof(ImDrawIdx) == sizeof(std::uint16_t));

tools::MeshVertex converted(const ImDrawVert& vertex) {
    return {vertex.pos.x, vertex.pos.y, vertex.uv.x, vertex.uv.y, vertex.col};
}

/// The part of a clip rectangle on the page, in whole pixels.
tools::MeshPart part_of(const ImDrawCmd& command, const tools::Mesh& mesh) {
    const auto whole = [](float value, std::uint32_t most) {
        return static_cast<std::uint32_t>(std::clamp(value, 0.0F, static_cast<float>(most)));
    };
    const std::uint32_t left = whole(command.ClipRect.x, mesh.width());
    const std::uint32_t top = whole(command.ClipRect.y, mesh.height());
    const std::uint32_t right = whole(command.ClipRect.z, mesh.width());
    const std::uint32_t bottom = whole(command.ClipRect.w, mesh.height());
    return {static_cast<std::int32_t>(left),
            static_cast<std::int32_t>(top),
            std::max(left, right) - left,
            std::max(top, bottom) - top,
            command.IdxOffset,
            command.ElemCount};
}

}  // namespace

Gui::Gui(SDL_Window* window) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // writes nothing to the working folder
    io.BackendRendererName = "nearfield";
    ImGui::StyleColorsLight();
    ImGui::GetStyle().Colors[ImGuiCol_PopupBg].w = 1.0F;  // lists cover other text
    ImGui_ImplSDL2_InitForVulkan(window);
}

Gui::~Gui() {
    ImGui_ImplSDL2_Shutdown();
    ImGui::DestroyContext();
}

tools::Letters Gui::letters() {
    unsigned char* coverage = nullptr;
    int width = 0;
    int height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&coverage, &width, &height);
    tools::Letters letters{
        static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    letters.coverage.assign(coverage, coverage + std::size_t{letters.width} * letters.height);
    return letters;
}

void Gui::handle(const SDL_Event& event) {
    ImGui_ImplSDL2_ProcessEvent(&event);
}

bool Gui::wants_mouse() {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::wants_keys() {
    return ImGui::GetIO().WantTextInput;
}

void Gui::begin() {
    ImGui_ImplSDL2_NewFrame();
    ImGui::NewFrame();
}

void Gui::add_to(tools::Mesh& mesh) {
    ImGui::Render();
    const ImDrawData& data = *ImGui::GetDrawData();
    for (const ImDrawList* const list : std::span(data.CmdLists, std::size_t(data.CmdListsCount))) {
        std::vector<tools::MeshVertex> vertices;
        std::transform(list->VtxBuffer.begin(), list->VtxBuffer.end(), std::back_inserter(vertices),
                       converted);
        std::vector<tools::MeshPart> parts;
        std::transform(list->CmdBuffer.begin(), list->CmdBuffer.end(), std::back_inserter(parts),
                       [&mesh](const ImDrawCmd& command) { return part_of(command, mesh); });
        mesh.add(vertices, {list->IdxBuffer.Data, std::size_t(list->IdxBuffer.Size)}, parts);
    }
}

}  // namespace nearfield::viewer
