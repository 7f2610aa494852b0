// A surface and a direction for the kernels that include tests/kernels/bsdf_case.glsl.
#pragma once
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "app/albedo_textures.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "shared/bindings.h"

namespace tarn {

struct BsdfCase {
    double cos_o = 1;
    double alpha = 1;
    double eta = 1.5;  // index beyond / index here; 1: opaque surfaces have no dielectric interface
    double metallic = 0;
    double base = 0.6;
    bool transmissive = false;
    bool uniform_diffuse = false;

    std::string text() const {
        return fmt::format("{} cos {} alpha {} eta {} metallic {} base {}",
                           transmissive      ? "glass"
                           : uniform_diffuse ? "opaque, uniform diffuse,"
                                             : "opaque",
                           cos_o, alpha, eta, metallic, base);
    }
};

// Off the axes of the local frame.
inline glm::vec3 case_wo(double cos_o) {
    const double sin_o = std::sqrt(1 - cos_o * cos_o);
    return {sin_o * 0.6, sin_o * -0.8, cos_o};
}

// As CaseBlock of tests/kernels/bsdf_case.glsl.
struct BsdfCaseBlock {
    glm::vec3 wo;
    float alpha;
    glm::vec3 base;
    float metallic;
    float eta;
    std::int32_t transmissive, uniform_diffuse, count;
    std::uint32_t seed = 0;
    std::int32_t by_slopes = 0;
    float bin_alpha = 1, bin_eta = 1;
};

inline BsdfCaseBlock case_block(const BsdfCase& c, int count) {
    return {.wo = case_wo(c.cos_o),
            .alpha = static_cast<float>(c.alpha),
            .base = glm::vec3(static_cast<float>(c.base)),
            .metallic = static_cast<float>(c.metallic),
            .eta = static_cast<float>(c.eta),
            .transmissive = c.transmissive ? 1 : 0,
            .uniform_diffuse = c.uniform_diffuse ? 1 : 0,
            .count = count};
}

// A kernel over the shipped BSDFs with their tables.
class BsdfKernel {
  public:
    explicit BsdfKernel(const char* path)
        : program_({.label = path, .compute = path, .vertex = {}, .fragment = {}, .defines = {}}) {}

    // `invocations` in workgroups of 64 that write `results`.
    void run(const BsdfCaseBlock& block, int invocations, const gl::Buffer& results) {
        block_.upload(std::span(&block, 1));
        block_.bind_uniform(2);
        tables_.dielectric.bind(BINDING_ALBEDO_TABLE);
        tables_.metal.bind(BINDING_METAL_ALBEDO_TABLE);
        tables_.glass.bind(BINDING_GLASS_ALBEDO_TABLE);
        results.bind_storage(0);
        program_.dispatch_for({invocations, 1, 1}, {64, 1, 1});
    }

  private:
    AlbedoTextures tables_ = make_albedo_textures();
    gl::Buffer block_{"case", sizeof(BsdfCaseBlock)};
    gl::Program program_;
};

}  // namespace tarn
