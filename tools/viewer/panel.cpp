#include <backends/imgui_impl_sdl.h>
#include <imgui.h>
#include <tools/simulation/scenes.hpp>
#include <tools/viewer/panel.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
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

namespace {

/// A value and its name in a selection list.
template <class Value>
struct Named {
    Value value;
    const char* name;
};

constexpr std::array responses{
    Named<simulation::Response>{simulation::Response::penalty, "penalty"},
    Named<simulation::Response>{simulation::Response::backtracking, "backtracking"}};
constexpr std::array fields{
    Named<tools::FieldOverlay>{tools::FieldOverlay::none, "none"},
    Named<tools::FieldOverlay>{tools::FieldOverlay::distance, "distance"},
    Named<tools::FieldOverlay>{tools::FieldOverlay::features, "Voronoi ids"},
    Named<tools::FieldOverlay>{tools::FieldOverlay::gradient, "gradient"}};

template <class Value>
std::vector<Named<Value>> named(std::initializer_list<Value> values) {
    std::vector<Named<Value>> list;
    for (const Value value : values) {
        list.push_back({value, to_string(value)});
    }
    return list;
}

template <class Value>
void choose(const char* label, Value& value, std::span<const Named<Value>> from) {
    const auto now = std::find_if(from.begin(), from.end(), [&value](const Named<Value>& each) {
        return each.value == value;
    });
    if (ImGui::BeginCombo(label, now->name)) {
        for (const Named<Value>& each : from) {
            if (ImGui::Selectable(each.name, each.value == value)) {
                value = each.value;
            }
        }
        ImGui::EndCombo();
    }
}

void choose_scene(Choices& choices) {
    const auto offer = [&choices](const auto& scenes) {
        for (const auto& each : scenes) {
            if (ImGui::Selectable(each.name, choices.scene == each.name)) {
                choices.scene = each.name;
                choices.tolerance = 0.0;
            }
        }
    };
    if (ImGui::BeginCombo("scene", choices.scene.c_str())) {
        offer(simulation::all_scenes());
        offer(simulation::clearance_scenes());
        ImGui::EndCombo();
    }
}

void add_run_controls(Wishes& wishes) {
    if (ImGui::Button(wishes.running ? "Pause" : "Run")) {
        wishes.running = !wishes.running;
    }
    ImGui::SameLine();
    if (ImGui::Button("Step")) {
        wishes.running = false;
        wishes.step = true;
    }
    ImGui::SameLine();
    if (ImGui::Button("Restart")) {
        wishes.restart = true;
    }
    ImGui::TextDisabled("keys space, n, r; the mouse drags");
    choose_scene(wishes.choices);
}

void add_choices(Choices& choices, const Reading& reading) {
    choose<simulation::Response>("response", choices.response, responses);
    static const auto techniques =
        named({Technique::automatic, Technique::raster, Technique::compute, Technique::cpu});
    choose<Technique>("technique", choices.technique, techniques);
    double tolerance = reading.tolerance;
    // Takes effect when the input is complete, so that no intermediate value is tried.
    if (ImGui::InputDouble("tolerance d", &tolerance, 0.0, 0.0, "%.4g",
                           ImGuiInputTextFlags_EnterReturnsTrue) &&
        tolerance > 0.0) {
        choices.tolerance = tolerance;
    }
    int levels = static_cast<int>(choices.hierarchy_height);
    if (ImGui::InputInt("tree height", &levels)) {
        choices.hierarchy_height = static_cast<std::uint32_t>(std::clamp(levels, 0, 32));
    }
}

void add_overlays(Overlays& overlays) {
    ImGui::Separator();
    choose<tools::FieldOverlay>("field", overlays.field, fields);
    ImGui::Checkbox("contacts", &overlays.contacts);
    ImGui::SameLine();
    ImGui::Checkbox("depths", &overlays.depths);
    ImGui::SameLine();
    ImGui::Checkbox("regions", &overlays.regions);
    ImGui::SameLine();
    ImGui::Checkbox("tiles", &overlays.tiles);
    ImGui::Checkbox("samples of intersections", &overlays.samples);
    static const auto strategies =
        named({IntersectionStrategy::stencil, IntersectionStrategy::blend,
               IntersectionStrategy::logic_op, IntersectionStrategy::depth});
    ImGui::BeginDisabled(!overlays.samples);
    choose<IntersectionStrategy>("strategy", overlays.strategy, strategies);
    ImGui::EndDisabled();
}

/// Begins a table of names and numbers.
bool begin_numbers(const char* id) {
    if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_RowBg)) {
        return false;
    }
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("number", ImGuiTableColumnFlags_WidthFixed, 70.0F);
    return true;
}

void add_row(const char* name, double value, const char* format) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name);
    ImGui::TableNextColumn();
    ImGui::Text(format, value);
}

void add_frame(const Reading& reading) {
    ImGui::Separator();
    ImGui::TextWrapped("%s", reading.device.c_str());
    if (begin_numbers("frame")) {
        const simulation::FrameReport& frame = reading.frame;
        add_row("objects", double(reading.objects), "%.0f");
        add_row("lines", double(reading.lines), "%.0f");
        add_row("time, s", reading.time, "%.3f");
        add_row("energy", frame.energies.total(), "%.4g");
        add_row("points in contact", double(frame.contacts), "%.0f");
        add_row("worst penetration", frame.worst_penetration, "%.3g");
        add_row("queries", double(frame.queries.queries), "%.0f");
        add_row("query time, ms", frame.queries.milliseconds, "%.2f");
        ImGui::EndTable();
    }
}

void add_clearances(const Reading& reading, const simulation::ClearanceFrame& frame) {
    ImGui::Separator();
    if (begin_numbers("clearances")) {
        add_row("objects", double(reading.objects), "%.0f");
        add_row("lines", double(reading.lines), "%.0f");
        add_row("time, s", reading.time, "%.3f");
        add_row("clearance (below 0: depth)", frame.clearance.distance, "%.4f");
        add_row("paths", double(frame.paths), "%.0f");
        add_row("of these free", double(frame.free_paths), "%.0f");
        add_row("poses in one call", double(frame.poses), "%.0f");
        add_row("its time, ms", frame.milliseconds, "%.3f");
        ImGui::EndTable();
    }
    ImGui::TextDisabled("The CPU answers, exactly.");
}

void add_times(const Timings& timings) {
    ImGui::Separator();
    ImGui::TextUnformatted("The overlays' queries, one batch, ms");
    if (!begin_numbers("times")) {
        return;
    }
    add_row("localise", timings.localize, "%.3f");
    add_row("plan", timings.plan, "%.3f");
    add_row("record", timings.record, "%.3f");
    add_row("device", timings.device, "%.3f");
    for (const PassTime& pass : timings.passes) {
        add_row(("  " + pass.name).c_str(), pass.milliseconds, "%.3f");
    }
    add_row("decode, CPU's answers", timings.decode, "%.3f");
    add_row("total", timings.total, "%.3f");
    ImGui::EndTable();
    if (timings.passes.empty()) {
        ImGui::TextDisabled("The CPU answered all: no passes.");
    }
}

/// Shows where the tiles of the first atlas are in the image, and how many more there are.
void add_atlas(const std::vector<TileReport>& tiles) {
    constexpr float side = 110.0F;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::size_t shown = 0;
    const auto is_shown = [](const TileReport& tile) {
        return tile.technique == Technique::raster && tile.tile_batch == 0;
    };
    for (const TileReport& tile : tiles) {
        if (is_shown(tile)) {
            width = std::max(width, tile.x + tile.width);
            height = std::max(height, tile.y + tile.height);
            ++shown;
        }
    }
    ImGui::Separator();
    ImGui::Text("%zu tiles, %zu of them in one atlas image", tiles.size(), shown);
    if (shown == 0) {
        return;
    }
    const float scale = side / static_cast<float>(std::max(width, height));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const auto at = [&](std::uint32_t x, std::uint32_t y) {
        return ImVec2(corner.x + scale * static_cast<float>(x),
                      corner.y + scale * static_cast<float>(y));
    };
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, at(width, height), IM_COL32(255, 255, 255, 255));
    for (const TileReport& tile : tiles) {
        if (is_shown(tile)) {
            const ImVec2 high = at(tile.x + tile.width, tile.y + tile.height);
            list.AddRectFilled(at(tile.x, tile.y), high, IM_COL32(0, 121, 107, 40));
            list.AddRect(at(tile.x, tile.y), high, IM_COL32(0, 121, 107, 255));
        }
    }
    ImGui::Dummy({scale * static_cast<float>(width), scale * static_cast<float>(height)});
}

void add_notice(const std::string& notice) {
    if (!notice.empty()) {
        ImGui::Separator();
        ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(180, 30, 30, 255));
        ImGui::TextWrapped("%s", notice.c_str());
        ImGui::PopStyleColor();
    }
}

/// What there is to choose and to read for a scene of bodies.
void add_bodies(Wishes& wishes, const Reading& reading) {
    add_choices(wishes.choices, reading);
    add_overlays(wishes.overlays);
    add_notice(reading.notice);
    add_notice(reading.findings.refusal);
    if (wishes.overlays.tiles) {
        add_atlas(reading.findings.tiles);
    }
    add_frame(reading);
    add_times(reading.findings.timings);
}

}  // namespace

void add_panel(Wishes& wishes, const Reading& reading, float height) {
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize({panel_width, height});
    ImGui::Begin("nearfield", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PushItemWidth(170.0F);
    add_run_controls(wishes);
    if (reading.clearances) {
        add_notice(reading.notice);
        add_clearances(reading, *reading.clearances);
    } else {
        add_bodies(wishes, reading);
    }
    ImGui::PopItemWidth();
    ImGui::End();
}

}  // namespace nearfield::viewer
