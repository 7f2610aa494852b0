// One control of a panel with its tooltip: the ImGui pieces that the Settings window is made of.
#pragma once
#include <string>

#include "core/settings.h"

namespace tarn {

// Explains the control drawn last while the mouse rests on it.
void tooltip(const std::string& text);

// A button with its tooltip; greyed and never pressed while not `enabled`.
bool button(const char* label, const char* help, bool enabled = true);

// The widget that fits the setting's kind, with tooltip and a way back to its value in `defaults`. Typed
// values are clamped to the setting's range; they are assigned by assign_setting().
void setting_row(const SettingInfo& info, Settings& settings, const Settings& defaults);

}  // namespace tarn
