#include "world/material_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tarn {
namespace {

TEST(Materials, NamesAndIdsAreThoseOfTheContract) {
    const std::pair<const char*, int> contract[] = {{"air", 0},  {"stone", 1}, {"dirt", 2},  {"grass", 3},
                                                    {"sand", 4}, {"glass", 5}, {"metal", 6}, {"lamp", 7},
                                                    {"wall", 8}, {"water", 64}};
    ASSERT_EQ(named_materials().size(), std::size(contract));
    for (std::size_t i = 0; i < std::size(contract); ++i) {
        const auto& [name, id] = contract[i];
        EXPECT_EQ(named_materials()[i], id);
        EXPECT_EQ(material_name(static_cast<std::uint8_t>(id)), name);
        EXPECT_EQ(material_id(name), static_cast<std::uint8_t>(id));
    }
    EXPECT_EQ(material_name(9), "");
    EXPECT_EQ(material_name(65), "");
    EXPECT_EQ(material_id("lava"), std::nullopt);
    EXPECT_EQ(material_id(""), std::nullopt);
}

TEST(Materials, BytesOfWaterCarryTheirQuanta) {
    for (std::uint32_t q = 1; q <= QUANTA_PER_VOXEL; ++q) {
        const std::uint32_t byte = water_cell(q);
        EXPECT_EQ(byte, 63 + q);
        EXPECT_TRUE(is_water(byte));
        EXPECT_EQ(quanta_of(byte), q);
        EXPECT_EQ(material_of(byte), MATERIAL_WATER);
    }
    EXPECT_EQ(water_cell(0), MATERIAL_AIR);
    for (const std::uint32_t byte : {0u, 63u, 80u, 255u}) {
        EXPECT_FALSE(is_water(byte));
        EXPECT_EQ(quanta_of(byte), 0u);
        EXPECT_EQ(material_of(byte), byte);
    }
}

TEST(Materials, DefaultsAreTheTableOfTheSharedList) {
    const MaterialTable table = default_materials();
    EXPECT_FLOAT_EQ(table[MATERIAL_WATER].ior, 1.333f);
    EXPECT_FLOAT_EQ(table[MATERIAL_METAL].metallic, 1);
    EXPECT_FLOAT_EQ(table[MATERIAL_LAMP].emission.x, 12);
    EXPECT_FLOAT_EQ(table[MATERIAL_GLASS].absorption_per_m.x, 0.06f);
    EXPECT_FLOAT_EQ(table[MATERIAL_SAND].base_color.y, 0.63f);
    EXPECT_FLOAT_EQ(table[MATERIAL_SAND].roughness, 0.9f);
}

TEST(Materials, WaterSettingsAreAViewOfTheTable) {
    MaterialTable table = default_materials();
    Settings settings;
    water_settings_from(table, settings);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(settings.water_color[c], std::exp(-table[MATERIAL_WATER].absorption_per_m[c]), 1e-6);
    const MaterialTable before = table;
    apply_water_settings(settings, table);
    EXPECT_EQ(table, before) << "untouched settings must not change the table by a bit";
    settings.water_color.y = 0.5f;
    settings.water_ior = 1.5f;
    apply_water_settings(settings, table);
    EXPECT_NEAR(table[MATERIAL_WATER].absorption_per_m.y, std::log(2.0), 1e-6);
    EXPECT_EQ(table[MATERIAL_WATER].absorption_per_m.x, before[MATERIAL_WATER].absorption_per_m.x);
    EXPECT_EQ(table[MATERIAL_WATER].ior, 1.5f);
}

TEST(Materials, AbsorptionBeyondTheSettingsRangeSurvivesThem) {
    MaterialTable table = default_materials();
    table[MATERIAL_WATER].absorption_per_m = {1e4f, 0, 0.1f};
    Settings settings;
    water_settings_from(table, settings);
    EXPECT_FLOAT_EQ(settings.water_color.x, 1e-4f) << "the least colour that the setting allows";
    EXPECT_EQ(settings.water_color.y, 1);
    settings.water_color.z = 0.25f;
    apply_water_settings(settings, table);
    EXPECT_EQ(table[MATERIAL_WATER].absorption_per_m.x, 1e4f);
    EXPECT_EQ(table[MATERIAL_WATER].absorption_per_m.y, 0);
    settings.water_color.z = 1;
    apply_water_settings(settings, table);
    EXPECT_EQ(table[MATERIAL_WATER].absorption_per_m.z, 0);
    EXPECT_FALSE(std::signbit(table[MATERIAL_WATER].absorption_per_m.z));
}

}  // namespace
}  // namespace tarn
