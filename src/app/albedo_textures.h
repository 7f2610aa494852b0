// The albedo tables of src/reference/albedo.h, integrated at build time, as textures.
#pragma once
#include "gl/texture.h"

namespace tarn {

struct AlbedoTextures {
    gl::Texture dielectric;  // for BINDING_ALBEDO_TABLE
    gl::Texture metal;       // for BINDING_METAL_ALBEDO_TABLE
    gl::Texture glass;       // for BINDING_GLASS_ALBEDO_TABLE
};

AlbedoTextures make_albedo_textures();

}  // namespace tarn
