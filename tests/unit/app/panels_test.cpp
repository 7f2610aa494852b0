// The panels in an ImGui context without a window: the mouse is moved over them pixel by pixel.
#include "app/panels.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <functional>
#include <set>
#include <vector>

#include "app/setting_row.h"
#include "core/sun_clock.h"

namespace tarn {
namespace {

class PanelsTest : public testing::Test {
  protected:
    PanelsTest() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1200, 2400};
        unsigned char* pixels = nullptr;
        int width = 0;
        int height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    }
    ~PanelsTest() override { ImGui::DestroyContext(); }

    static void frame(const std::function<void()>& draw) {
        ImGui::GetIO().DeltaTime = 0.1f;
        ImGui::NewFrame();
        draw();
        ImGui::Render();
    }

    // Ids of the items hovered anywhere in the window, and those of them without a tooltip.
    struct Sweep {
        std::set<ImGuiID> hovered, silent;
    };
    static Sweep sweep(const char* window_name, const std::function<void()>& draw) {
        frame(draw);
        frame(draw);
        ImGuiWindow* window = ImGui::FindWindowByName(window_name);
        // Corners for resizing are the window's own.
        const std::set<ImGuiID> corners{ImGui::GetWindowResizeCornerID(window, 0),
                                        ImGui::GetWindowResizeCornerID(window, 1)};
        Sweep found;
        const ImRect area = window->ContentRegionRect;
        for (int y = 0; y < static_cast<int>(area.GetHeight()); y += 4) {
            for (int x = 0; x < static_cast<int>(area.GetWidth()); x += 6) {
                ImGui::GetIO().MousePos = {area.Min.x + static_cast<float>(x),
                                           area.Min.y + static_cast<float>(y)};
                frame(draw);
                const ImGuiID id = ImGui::GetCurrentContext()->HoveredId;
                if (id == 0 || corners.contains(id)) continue;
                found.hovered.insert(id);
                const bool shown = [] {
                    for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
                        if (w->Active && (w->Flags & ImGuiWindowFlags_Tooltip) != 0) return true;
                    }
                    return false;
                }();
                if (!shown) found.silent.insert(id);
            }
        }
        return found;
    }

    Settings settings, defaults;
    Brush brush;
};

TEST_F(PanelsTest, EveryButtonAndFieldOfTheSettingsHasATooltip) {
    Panels panels;
    panels.settings_open = true;
    const std::vector<SceneSummary> scenes{{"flat", "a plain"}};
    const std::string scene = "flat";
    const Sweep found = sweep("Settings", [&] {
        Actions actions;
        panels.draw({.settings = settings,
                     .brush = brush,
                     .defaults = defaults,
                     .scene = scene,
                     .scenes = scenes,
                     .paused = false,
                     .can_undo = true,
                     .can_redo = true},
                    actions);
    });
    // 5 of time, 6 of the brush, 3 of the world, 7 groups
    EXPECT_GE(found.hovered.size(), 21u);
    EXPECT_TRUE(found.silent.empty()) << found.silent.size() << " of " << found.hovered.size();
    EXPECT_TRUE(panels.settings_was_shown());
    EXPECT_EQ(settings, defaults) << "looking changes nothing";
}

TEST_F(PanelsTest, EverySettingHasATooltipAndAWayBack) {
    for (const SettingInfo& info : setting_infos()) {
        const glm::dvec3 other =
            info.get(defaults) == glm::dvec3(info.max) ? glm::dvec3(info.min) : glm::dvec3(info.max);
        info.set(settings, other);
        const Sweep found = sweep("row", [&] {
            ImGui::SetNextWindowPos({10, 10});
            ImGui::SetNextWindowSize({420, 60});
            ImGui::Begin("row", nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoScrollbar);
            setting_row(info, settings, defaults);
            ImGui::End();
        });
        // A choice of one value has no other to come back from.
        const std::size_t controls = info.min == info.max ? 1 : 2;
        EXPECT_GE(found.hovered.size(), controls) << info.name;
        EXPECT_TRUE(found.silent.empty()) << info.name;
    }
}

TEST_F(PanelsTest, DraggingTheTimeOfDayMovesTheSunAndMovingTheSunLeavesTheClock) {
    const auto drag = [&](const char* name) {
        const SettingInfo& info = *find_setting(name);
        const auto draw = [&] {
            ImGui::SetNextWindowPos({10, 10});
            ImGui::SetNextWindowSize({420, 60});
            ImGui::Begin("row", nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoScrollbar);
            setting_row(info, settings, defaults);
            ImGui::End();
        };
        frame(draw);
        frame(draw);
        ImGuiIO& io = ImGui::GetIO();
        const ImRect area = ImGui::FindWindowByName("row")->ContentRegionRect;
        io.MousePos = {area.Min.x + 100, area.Min.y + 8};
        frame(draw);
        io.MouseDown[0] = true;
        std::vector<double> values;
        for (int step = 0; step < 6; ++step) {
            io.MousePos.x += 12;
            frame(draw);
            values.push_back(info.get(settings).x);
            if (std::string_view(name) != "time_of_day_h") continue;
            EXPECT_EQ(settings.sun_azimuth_deg, static_cast<float>(sun_position(values.back()).azimuth_deg));
            EXPECT_EQ(settings.sun_elevation_deg,
                      static_cast<float>(sun_position(values.back()).elevation_deg));
        }
        io.MouseDown[0] = false;
        frame(draw);
        EXPECT_GE(std::set<double>(values.begin(), values.end()).size(), 5u) << name;
    };
    drag("time_of_day_h");
    const float hour = settings.time_of_day_h;
    const float azimuth = settings.sun_azimuth_deg;
    drag("sun_elevation_deg");
    EXPECT_EQ(settings.time_of_day_h, hour);
    EXPECT_EQ(settings.sun_azimuth_deg, azimuth);
}

TEST_F(PanelsTest, HelpIsDrawnWithoutAskingForAnything) {
    Panels panels;
    panels.help_open = true;
    Actions actions;
    frame([&] {
        panels.draw({.settings = settings,
                     .brush = brush,
                     .defaults = defaults,
                     .scene = "flat",
                     .scenes = {},
                     .paused = true,
                     .can_undo = false,
                     .can_redo = false},
                    actions);
    });
    EXPECT_TRUE(panels.help_was_shown());
    EXPECT_FALSE(actions.load_scene.has_value());
}

// The window that the game starts with.
TEST_F(PanelsTest, ASmallWindowHasRoomForThePictureAndForTooltipsBesideThePanel) {
    ImGui::GetIO().DisplaySize = {640, 360};
    Panels panels;
    panels.settings_open = true;
    const auto draw = [&] {
        Actions actions;
        panels.draw({.settings = settings,
                     .brush = brush,
                     .defaults = defaults,
                     .scene = "flat",
                     .scenes = {},
                     .paused = true,
                     .can_undo = false,
                     .can_redo = false},
                    actions);
    };
    frame(draw);
    frame(draw);
    ImRect panel = ImGui::FindWindowByName("Settings")->Rect();
    EXPECT_LE(panel.GetWidth(), 0.56f * 640);
    EXPECT_GE(panel.Min.y, 0);
    EXPECT_LE(panel.Max.y, 360);
    EXPECT_LE(panel.Max.x, 640);
    int shown = 0;
    for (float y = panel.Min.y + 30; y < panel.Max.y; y += 12) {
        ImGui::GetIO().MousePos = {panel.Min.x + 40, y};
        frame(draw);
        frame(draw);
        for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
            if (!w->Active || w->Hidden || (w->Flags & ImGuiWindowFlags_Tooltip) == 0) continue;
            ++shown;
            EXPECT_FALSE(w->Rect().Overlaps(panel)) << y;
            EXPECT_GE(w->Size.x, w->ContentSize.x + 2 * w->WindowPadding.x) << "cut off at " << y;
            EXPECT_TRUE(w->Pos.x >= 0 && w->Pos.y >= 0 && w->Rect().Max.y <= 360) << y;
        }
    }
    EXPECT_GT(shown, 5);
    panels.help_open = true;
    frame(draw);
    EXPECT_TRUE(panels.help_open);
    EXPECT_FALSE(panels.settings_open) << "what was opened last has the room";
    panels.settings_open = true;
    frame(draw);
    EXPECT_FALSE(panels.help_open);
    ImGui::GetIO().DisplaySize = {1280, 720};
    panels.help_open = true;
    frame(draw);
    EXPECT_TRUE(panels.help_open && panels.settings_open);
}

TEST_F(PanelsTest, RecordAndHomeAreButtons) {
    Panels panels;
    panels.settings_open = true;
    Actions actions;
    const auto draw = [&] {
        panels.draw({.settings = settings,
                     .brush = brush,
                     .defaults = defaults,
                     .scene = "flat",
                     .scenes = {},
                     .paused = true,
                     .can_undo = false,
                     .can_redo = false},
                    actions);
    };
    frame(draw);
    frame(draw);
    ImGuiIO& io = ImGui::GetIO();
    const ImRect area = ImGui::FindWindowByName("Settings")->ContentRegionRect;
    int records = 0;
    int homes = 0;
    for (float y = area.Min.y; y < area.Min.y + 260; y += 10)
        for (float x = area.Min.x; x < area.Max.x; x += 20) {
            io.MousePos = {x, y};
            frame(draw);
            io.MouseDown[0] = true;
            frame(draw);
            io.MouseDown[0] = false;
            actions = {};
            frame(draw);
            records += actions.record ? 1 : 0;
            homes += actions.home ? 1 : 0;
            ImGui::ClosePopupsOverWindow(nullptr, false);
        }
    EXPECT_GT(records, 0);
    EXPECT_GT(homes, 0);
}

}  // namespace
}  // namespace tarn
