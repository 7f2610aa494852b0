#include "app/setting_row.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace tarn {

namespace {

// Narrower than so many font sizes, lines of a tooltip are too short to read.
constexpr float tooltip_min_font = 10;

// Ranges this wide get a logarithmic slider.
bool is_wide(const SettingInfo& info) {
    if (info.min < 0) return false;
    return info.min > 0 ? info.max / info.min >= 200 : info.max >= 50;
}

bool is_quality(const SettingInfo& info) {
    return std::string_view(info.name) == "quality";
}

// A setting that works only while another one has (or has not) some value.
struct Dependence {
    std::string_view name, on;
    bool equal;
    std::string_view value;
};
constexpr Dependence dependences[] = {
    {"history_alpha", "history", true, "blend"},
    {"history_cap", "history", true, "count"},
    {"filter_passes", "filter", false, "none"},
    {"turbidity", "sky_model", true, "preetham"},
    {"sky_brightness", "sky_model", true, "preetham"},
    {"sun_irradiance", "sky_model", true, "gradient"},
    {"sky_zenith", "sky_model", true, "gradient"},
    {"sky_horizon", "sky_model", true, "gradient"},
    {"pressure_sweeps", "water_tier", true, "pressure"},
    {"retrace_changes", "history", true, "count"},
    {"antialiasing", "history", false, "exact"},
    {"antialiasing", "jitter", false, "true"},
    {"guided_upsampling", "resolution_scale", false, "1"},
    {"guided_upsampling", "history", false, "none"},
    {"guided_upsampling", "history", false, "exact"},
};

// Why the setting changes nothing as the others stand; empty: it works.
std::string idle_reason(const SettingInfo& info, const Settings& settings) {
    for (const Dependence& dependence : dependences) {
        if (dependence.name != info.name) continue;
        const std::string now = setting_text(settings, *find_setting(dependence.on));
        if ((now == dependence.value) != dependence.equal)
            return fmt::format("\nNo effect while {} is {}.", dependence.on, now);
    }
    return {};
}

void assign(const SettingInfo& info, Settings& settings, glm::dvec3 value) {
    for (int c = 0; c < 3; ++c) {
        if (!std::isfinite(value[c])) return;
    }
    value = glm::clamp(value, glm::dvec3(info.min), glm::dvec3(info.max));
    assign_setting(settings, info, value);
}

bool draw_number(const SettingInfo& info, const char* label, glm::dvec3& value) {
    const ImGuiSliderFlags flags =
        ImGuiSliderFlags_AlwaysClamp | (is_wide(info) ? ImGuiSliderFlags_Logarithmic : 0);
    bool changed = false;
    if (info.kind == SettingKind::Int) {
        int number = static_cast<int>(value.x);
        changed = ImGui::SliderInt(label, &number, static_cast<int>(info.min), static_cast<int>(info.max),
                                   "%d", flags);
        value = glm::dvec3(number);
    } else {
        auto number = static_cast<float>(value.x);
        changed = ImGui::SliderFloat(label, &number, static_cast<float>(info.min),
                                     static_cast<float>(info.max), "%.3f", flags);
        value = glm::dvec3(number);
    }
    return changed;
}

bool draw_triple(const SettingInfo& info, const char* label, glm::dvec3& value) {
    glm::vec3 triple(value);
    bool changed = false;
    if (info.kind == SettingKind::Color) {
        const ImGuiColorEditFlags flags =
            ImGuiColorEditFlags_Float | (info.max > 1 ? ImGuiColorEditFlags_HDR : 0);
        changed = ImGui::ColorEdit3(label, &triple.x, flags);
    } else {
        changed = ImGui::DragFloat3(label, &triple.x, 0.25f, static_cast<float>(info.min),
                                    static_cast<float>(info.max), "%.2f", ImGuiSliderFlags_AlwaysClamp);
    }
    value = triple;
    return changed;
}

bool draw_widget(const SettingInfo& info, const char* label, glm::dvec3& value) {
    switch (info.kind) {
        case SettingKind::Int:
        case SettingKind::Real:
            return draw_number(info, label, value);
        case SettingKind::Bool: {
            bool on = value.x != 0;
            const bool changed = ImGui::Checkbox(label, &on);
            value = glm::dvec3(on ? 1 : 0);
            return changed;
        }
        case SettingKind::Choice: {
            int index = static_cast<int>(value.x);
            const bool changed =
                ImGui::Combo(label, &index, info.choices.data(), static_cast<int>(info.choices.size()));
            value = glm::dvec3(index);
            return changed;
        }
        case SettingKind::Vec3:
        case SettingKind::Color:
            return draw_triple(info, label, value);
    }
    return false;
}

}  // namespace

// Beside the window that the control is in, so that it covers no other; at the mouse where there is no room.
void tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    const float font = ImGui::GetFontSize();
    const float left = ImGui::GetWindowPos().x;
    const float right = left + ImGui::GetWindowSize().x;
    const float room_right = ImGui::GetIO().DisplaySize.x - right;
    const float room = std::max(left, room_right) - 2 * font;
    const bool beside = room >= tooltip_min_font * font;
    if (beside) {
        const ImVec2 mouse = ImGui::GetMousePos();
        const bool to_left = left > room_right;
        ImGui::SetNextWindowPos({to_left ? left - font / 2 : right + font / 2, mouse.y}, ImGuiCond_Always,
                                {to_left ? 1.f : 0.f, mouse.y / std::max(ImGui::GetIO().DisplaySize.y, 1.f)});
    }
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(beside ? std::min(font * 24, room) : font * 24);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool button(const char* label, const char* help, bool enabled) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(label);
    ImGui::EndDisabled();
    tooltip(help);
    return pressed;
}

void setting_row(const SettingInfo& info, Settings& settings, const Settings& defaults) {
    ImGui::PushID(info.name);
    const bool is_default = info.get(settings) == info.get(defaults);
    ImGui::BeginDisabled(is_default);
    if (ImGui::SmallButton("r")) assign(info, settings, info.get(defaults));
    ImGui::EndDisabled();
    tooltip(fmt::format("Reset {} to {}.", info.name, setting_text(defaults, info)));
    ImGui::SameLine();

    std::string label = info.name;
    std::replace(label.begin(), label.end(), '_', ' ');
    glm::dvec3 value = info.get(settings);
    ImGui::SetNextItemWidth(std::min(ImGui::GetFontSize() * 13, ImGui::GetContentRegionAvail().x * 0.5f));
    const std::string idle = idle_reason(info, settings);
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, ImGui::GetStyle().Alpha * (idle.empty() ? 1.f : 0.45f));
    const bool changed = draw_widget(info, label.c_str(), value);
    ImGui::PopStyleVar();
    std::string help = fmt::format("{}\n\n{}: {}; default {}.{}", info.help, info.name, allowed_values(info),
                                   setting_text(defaults, info), idle);
    if (is_quality(info)) {
        Settings preset = settings;
        apply_quality(preset, settings.quality);
        if (preset != settings)
            help += "\nSome of its settings were changed since; choose it again to restore them.";
    }
    tooltip(help);
    if (changed) assign(info, settings, value);
    ImGui::PopID();
}

}  // namespace tarn
