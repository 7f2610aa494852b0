#include "app/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "app/setting_row.h"
#include "core/front.h"

namespace tarn {

namespace {

// Of the window's width, what Settings take of a small one: the rest shows what a change does, and tooltips.
constexpr float settings_share = 0.55f;
// In font sizes: a window with room for Help beside Settings.
constexpr float both_open_font = 70;

struct HelpLine {
    const char* keys;  // null: a heading
    const char* text;
};

constexpr HelpLine help_lines[] = {
    {nullptr, "Fly"},
    {"W A S D, arrows", "forward, left, back, right"},
    {"Space, C", "up, down"},
    {"Shift", "four times as fast"},
    {"Tab or M", "look with the mouse, on and off; the brush then aims at the cross"},
    {"F or Alt", "look with the mouse while held"},
    {"Home or G", "back to where the scene's camera stands"},
    {"", "The ground stops you, unless fly_through_ground (settings, display) is on."},
    {nullptr, "Build"},
    {"left button", "place; hold to pour water and sand, drag to draw in the plane where you began"},
    {"right button", "remove; hold to dig on"},
    {"middle button", "take the material of the voxel under the mouse"},
    {"wheel", "size of the brush, 0 is one voxel"},
    {"1 to 9", "stone, dirt, grass, sand, glass, metal, lamp, wall, water"},
    {"B", "brush: sphere or cube"},
    {"X", "overwrite: replace everything, or fill air and water only"},
    {"Z, Ctrl+Z", "undo the last stroke"},
    {"Y, Shift+Z, Ctrl+Y", "redo"},
    {"",
     "The brush of water meets the water's surface. Every other material goes through water, to build and "
     "dig on the ground under it. Nothing happens further than 200 voxels away."},
    {nullptr, "Time"},
    {"P", "pause and go on"},
    {"N or .", "pause, then one tick at a time"},
    {"+ and -", "faster, slower"},
    {"R", "the scene's voxels from the start"},
    {nullptr, "Window"},
    {"H or F1", "this help"},
    {"O or F2", "settings"},
    {"F3", "times and counts in the corner"},
    {"V, Shift+V",
     "views in place of the picture: albedo, normal, depth, material, bounces, steps, history, variance; the "
     "legend says what their colours mean"},
    {"F12", "picture: tarn-0001.png and its settings as .json, in the folder that Tarn was started in"},
    {"F11", "record flight and strokes, and stop: tarn-0001.flight.json, in that folder too"},
    {"Esc", "give the mouse back; close the panels"},
    {"Ctrl+Q", "quit"},
};

void draw_time(const Panels::Inputs& inputs, Actions& actions) {
    actions.toggle_pause |= button(inputs.paused ? "Go on" : "Pause", "Stop or go on with the ticks (P).");
    ImGui::SameLine();
    actions.step |= button("Step", "Pause, then one tick (N).");
    ImGui::SameLine();
    actions.slower |= button("Slower", "Half the speed of time, down to a sixteenth (-).");
    ImGui::SameLine();
    actions.faster |= button("Faster", "Twice the speed of time, up to sixteen times (+).");
    ImGui::SameLine();
    actions.reload |= button("Reload", "The scene's voxels from the start; settings and camera stay (R).");
}

void draw_brush(const Panels::Inputs& inputs, Actions& actions) {
    Brush& brush = inputs.brush;
    const float width = ImGui::GetFontSize() * 13;
    ImGui::SetNextItemWidth(width);
    if (ImGui::BeginCombo("material", material_name(brush.material).data())) {
        for (const std::uint8_t id : palette) {
            if (ImGui::Selectable(material_name(id).data(), id == brush.material)) brush.material = id;
        }
        ImGui::EndCombo();
    }
    tooltip("What the left button places (keys 1 to 9, or middle click on a voxel).");
    constexpr const char* shapes[] = {"sphere", "cube"};
    int shape = static_cast<int>(brush.shape);
    ImGui::SetNextItemWidth(width);
    if (ImGui::Combo("shape", &shape, shapes, 2)) brush.shape = static_cast<BrushShape>(shape);
    tooltip("Shape of the brush (B).");
    ImGui::SetNextItemWidth(width);
    ImGui::SliderInt("radius", &brush.radius_vox, 0, brush_radius_max_vox, "%d voxels",
                     ImGuiSliderFlags_AlwaysClamp);
    tooltip("Radius of the brush in voxels, 0 to 32; 0 is one voxel (wheel).");
    ImGui::Checkbox("overwrite", &brush.overwrite);
    tooltip("On: placing replaces everything. Off: it fills air and water only (X).");
    ImGui::SameLine();
    actions.undo |=
        button("Undo",
               "Take back the last stroke (Z): its voxels become what they were; of water and sand that "
               "flowed on, as much as was poured is taken from the nearest within 64 voxels (128 down).",
               inputs.can_undo);
    ImGui::SameLine();
    actions.redo |= button("Redo", "Repeat the stroke taken back (Y).", inputs.can_redo);
}

void draw_world(const Panels::Inputs& inputs, Actions& actions) {
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 13);
    if (ImGui::BeginCombo("scene", inputs.scene.c_str())) {
        for (const SceneSummary& scene : inputs.scenes) {
            if (ImGui::Selectable(scene.name.c_str(), scene.name == inputs.scene))
                actions.load_scene = scene.name;
            tooltip(scene.description);
        }
        ImGui::EndCombo();
    }
    tooltip("Loads a built-in scene with its camera, water, sun and sky; what was built here is lost.");
    actions.screenshot |=
        button("Picture",
               "Write tarn-0001.png and its settings beside it, in the folder that Tarn was started "
               "in (F12).");
    ImGui::SameLine();
    actions.record |=
        button(inputs.recording ? "Stop" : "Record",
               "Record the flight, the strokes of the brush, undo and redo, to "
               "tarn-0001.flight.json in the folder that Tarn was started in, until pressed again (F11) or "
               "the world is loaded anew; `tarn render --path` plays it.");
}

// Where the slider stands, and what the measured front says of it.
void draw_front_point(const Panels::Inputs& inputs) {
    const std::size_t at = front_point(inputs.settings.tradeoff);
    const FrontPoint& point = front()[at];
    const auto as_set = point_of(inputs.settings);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(fmt::format("{} of {}: {}{}", at + 1, front().size(), front_label(point),
                                       as_set == at ? "" : ", changed since")
                               .c_str());
    const std::string time = inputs.expected_ms > 0
                                 ? fmt::format("{:.1f} ms a frame", inputs.expected_ms)
                                 : fmt::format("{:.2g} times balanced's frame time", point.time);
    ImGui::TextUnformatted(fmt::format("expects {}, error (relMSE) {:.2g}", time, point.error).c_str());
    ImGui::PopTextWrapPos();
}

}  // namespace

void Panels::draw(const Inputs& inputs, Actions& actions) {
    // A small window has room for one.
    const bool crowded = ImGui::GetIO().DisplaySize.x < ImGui::GetFontSize() * both_open_font;
    if (crowded && help_open && settings_open) (help_was_open_ ? help_open : settings_open) = false;
    help_was_open_ = help_open;
    if (help_open) draw_help();
    if (settings_open) draw_settings(inputs, actions);
}

void Panels::draw_help() {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({display.x * 0.02f, display.y * 0.03f}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize({std::min(font * 36, display.x * 0.9f), std::min(font * 38, display.y * 0.94f)},
                             ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Help", &help_open)) {
        help_shown_ = true;
        ImGui::PushTextWrapPos(0);
        for (const HelpLine& line : help_lines) {
            if (line.keys == nullptr) {
                ImGui::Separator();
                ImGui::TextColored({1, 0.8f, 0.4f, 1}, "%s", line.text);
                continue;
            }
            if (*line.keys != '\0') {
                ImGui::TextUnformatted(line.keys);
                ImGui::SameLine(font * 11);
            }
            ImGui::TextWrapped("%s", line.text);
        }
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

void Panels::draw_settings(const Inputs& inputs, Actions& actions) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({display.x * 0.99f, display.y * 0.03f}, ImGuiCond_FirstUseEver, {1, 0});
    ImGui::SetNextWindowSize(
        {std::min(font * 30, display.x * settings_share), std::min(font * 45, display.y * 0.94f)},
        ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Settings", &settings_open)) {
        settings_shown_ = true;
        draw_time(inputs, actions);
        ImGui::Separator();
        draw_brush(inputs, actions);
        ImGui::Separator();
        draw_world(inputs, actions);
        ImGui::SameLine();
        if (button("Reset all", "Every setting below as the scene and the program give it, the camera too."))
            inputs.settings = inputs.defaults;
        ImGui::SameLine();
        actions.home |= button("Camera home", "The camera back to where the scene has it (Home).");
        const std::span<const SettingInfo> infos = setting_infos();
        for (auto info = infos.begin(); info != infos.end();) {
            const SettingGroup group = info->group;
            const bool trade = group == SettingGroup::TRADE;
            const bool open =
                ImGui::CollapsingHeader(group_name(group), trade ? ImGuiTreeNodeFlags_DefaultOpen : 0);
            tooltip(fmt::format("Show or hide the settings of {}.", group_name(group)));
            for (; info != infos.end() && info->group == group; ++info) {
                if (open) setting_row(*info, inputs.settings, inputs.defaults);
            }
            if (trade && open) draw_front_point(inputs);
        }
    }
    ImGui::End();
}

}  // namespace tarn
