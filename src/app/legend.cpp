#include "app/legend.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "app/passive_window.h"
#include "shared/views.h"
#include "world/material_table.h"

namespace tarn {

namespace {

constexpr const char* meanings[] = {
    "",
    "base colour of the first surface; the sky is black",
    "of the first surface: x red, y green, z blue, half is 0",
    "distance of the first surface in voxels; the sky is black",
    "of the first surface; the sky is black",
    "times that the last frame's path went on after it met a surface",
    "voxels or boxes that the last frame's rays stepped through, those to the sun too",
    "frames in the mean",
    "of the mean's luminance, before the filter; black: not known",
};

ImU32 packed(glm::vec3 srgb) {
    const glm::vec3 color = glm::clamp(srgb, 0.f, 1.f);
    return ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, 1});
}

void draw_scale(int view) {
    constexpr int parts = 64;
    const float font = ImGui::GetFontSize();
    const ImVec2 size{font * 16, font};
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < parts; ++i) {
        const auto x = [&](int part) { return at.x + size.x * static_cast<float>(part) / parts; };
        list.AddRectFilled({x(i), at.y}, {x(i + 1), at.y + size.y},
                           packed(view_color((static_cast<float>(i) + 0.5f) / parts)));
    }
    ImGui::Dummy(size);
    const float offset = view_offset(view);
    const float low = view_low(view) + offset;
    const float high = view_high(view) + offset;
    const float left = ImGui::GetCursorPosX();
    for (const float t : {0.f, 0.5f, 1.f}) {
        const std::string text = fmt::format("{:.4g}", low * std::pow(high / low, t) - offset);
        if (t > 0) ImGui::SameLine();
        ImGui::SetCursorPosX(left + t * (size.x - ImGui::CalcTextSize(text.c_str()).x));
        ImGui::TextUnformatted(text.c_str());
    }
}

void draw_materials() {
    int shown = 0;
    for (const std::uint8_t id : named_materials()) {
        if (id == MATERIAL_AIR) continue;
        if (shown++ % 5 != 0) ImGui::SameLine();
        ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(packed(view_material_color(id))), "%s",
                           material_name(id).data());
    }
}

}  // namespace

void draw_legend(ViewKind view) {
    const auto index = static_cast<int>(view);
    const float margin = ImGui::GetFontSize() / 2;
    ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x - margin, margin}, ImGuiCond_Always, {1, 0});
    ImGui::SetNextWindowBgAlpha(0.7f);
    if (ImGui::Begin("##legend", nullptr, passive_window)) {
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 20);
        ImGui::Text("%s: %s", choice_names<ViewKind>()[index], meanings[index]);
        ImGui::PopTextWrapPos();
        if (view_has_scale(index)) draw_scale(index);
        if (view == ViewKind::Material) draw_materials();
    }
    ImGui::End();
}

}  // namespace tarn
