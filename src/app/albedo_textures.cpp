#include "app/albedo_textures.h"

#include "reference/albedo.h"

namespace tarn {

namespace {

#include "albedo_tables.inc"

}  // namespace

AlbedoTextures make_albedo_textures() {
    AlbedoTextures textures{
        .dielectric = gl::Texture({.label = "albedo table",
                                   .format = GL_RG32F,
                                   .size = {albedo_cos_count, albedo_roughness_count, albedo_eta_count},
                                   .linear = true}),
        .metal = gl::Texture({.label = "metal albedo table",
                              .format = GL_R32F,
                              .size = {metal_albedo_angle_count, metal_albedo_roughness_count, 0},
                              .linear = true}),
        .glass = gl::Texture(
            {.label = "glass albedo table",
             .format = GL_R32F,
             .size = {glass_albedo_angle_count, glass_albedo_roughness_count, glass_albedo_eta_count},
             .linear = true})};
    textures.dielectric.upload(std::span<const float>(albedo_table), GL_RG, GL_FLOAT);
    textures.metal.upload(std::span<const float>(metal_albedo_table), GL_RED, GL_FLOAT);
    textures.glass.upload(std::span<const float>(glass_albedo_table), GL_RED, GL_FLOAT);
    return textures;
}

}  // namespace tarn
