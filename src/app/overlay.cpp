#include "app/overlay.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "app/passive_window.h"

namespace tarn {

namespace {

constexpr double shown_ms_min = 0.005;

template <typename... Args>
void line(fmt::format_string<Args...> format, Args&&... args) {
    ImGui::TextUnformatted(fmt::format(format, std::forward<Args>(args)...).c_str());
}

ImVec2 units_from_px(glm::vec2 at_px) {
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    return {at_px.x / scale.x, at_px.y / scale.y};
}

ImU32 display_color(glm::vec3 linear) {
    const glm::vec3 encoded = glm::pow(glm::clamp(linear, 0.f, 1.f), glm::vec3(1 / 2.2f));
    return ImGui::ColorConvertFloat4ToU32({encoded.x, encoded.y, encoded.z, 1});
}

}  // namespace

void draw_overlay(const OverlayInputs& in) {
    const float margin = ImGui::GetFontSize() / 2;
    ImGui::SetNextWindowPos({margin, margin});
    ImGui::SetNextWindowBgAlpha(0.45f);
    if (ImGui::Begin("##overlay", nullptr, passive_window)) {
        line("frame {:.1f} ms", in.frame_ms);
        if (in.paused)
            line("paused, tick {}", in.tick);
        else
            line("{:.0f} of {:.0f} ticks/s, tick {}", in.ticks_per_s, in.ticks_per_s_wanted, in.tick);
        line("world {} x {} x {}", in.size_vox.x, in.size_vox.y, in.size_vox.z);
        const std::uint64_t quanta = in.census.water_quanta;
        line("water {:.1f} in {} voxels", static_cast<double>(quanta) / QUANTA_PER_VOXEL,
             in.census.voxels[MATERIAL_WATER]);
        line("active bricks {}", in.active_bricks);
        line("sand {}", in.census.voxels[MATERIAL_SAND]);
        line("samples {}", in.samples);
        if (in.error) line("error {:.2g} (relMSE)", *in.error);
        if (in.rejected_samples > 0) line("rejected samples {}", in.rejected_samples);
        line("{} {} {}{}", material_name(in.brush.material),
             in.brush.shape == BrushShape::Sphere ? "sphere" : "cube", in.brush.radius_vox,
             in.brush.overwrite ? ", overwrites" : "");
        line("H help, O settings");
        // Last: they may outgrow a small window.
        for (const gl::PassTime& pass : in.passes) {
            if (pass.mean_ms >= shown_ms_min) line("  {} {:.2f}", pass.name, pass.mean_ms);
        }
    }
    ImGui::End();
}

void draw_message(const std::string& text, bool is_error) {
    if (text.empty()) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float margin = ImGui::GetFontSize() / 2;
    ImGui::SetNextWindowPos({display.x - margin, display.y - margin}, ImGuiCond_Always, {1, 1});
    ImGui::SetNextWindowBgAlpha(0.7f);
    if (ImGui::Begin(is_error ? "##error" : "##message", nullptr, passive_window)) {
        ImGui::PushTextWrapPos(display.x - 4 * margin);
        if (is_error) ImGui::PushStyleColor(ImGuiCol_Text, {1, 0.5f, 0.4f, 1});
        ImGui::TextUnformatted(text.c_str());
        if (is_error) ImGui::PopStyleColor();
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

void draw_cross() {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const ImVec2 center{display.x / 2, display.y / 2};
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const auto& [color, reach, width] :
         {std::tuple{IM_COL32(0, 0, 0, 160), 8.f, 3.f}, std::tuple{IM_COL32_WHITE, 7.f, 1.f}}) {
        list.AddLine({center.x - reach, center.y}, {center.x + reach, center.y}, color, width);
        list.AddLine({center.x, center.y - reach}, {center.x, center.y + reach}, color, width);
    }
}

void draw_outline(const View& view, const Brush& brush, glm::ivec3 center_vox, bool removing,
                  glm::vec3 color_linear) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImU32 color = removing ? IM_COL32(255, 80, 60, 255) : display_color(color_linear);
    // Far beyond the picture a line's pixels exceed what the rasteriser's fixed point holds.
    constexpr float px_max = 16384;
    for (const auto& [from, to] : outline_of(brush, center_vox)) {
        const auto ends_px = view.project(from, to);
        if (!ends_px) continue;
        const ImVec2 a = units_from_px(glm::clamp((*ends_px)[0], -px_max, px_max));
        const ImVec2 b = units_from_px(glm::clamp((*ends_px)[1], -px_max, px_max));
        list.AddLine(a, b, IM_COL32(0, 0, 0, 140), 3.5f);
        list.AddLine(a, b, color, 1.5f);
    }
}

}  // namespace tarn
