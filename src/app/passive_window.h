// Flags of ImGui windows that are looked at and never touched.
#pragma once
#include <imgui.h>

namespace tarn {

constexpr ImGuiWindowFlags passive_window =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus;

}  // namespace tarn
