#include "passes/trace_pass.h"

#include "core/error.h"
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/materials.h"

namespace tarn {

namespace {

constexpr std::size_t materials_bytes =
    std::size_t{MATERIAL_COUNT} * 3 * sizeof(glm::vec4);  // lib/materials.glsl

gl::ProgramDesc describe(const TraceFeatures& features) {
    gl::ProgramDesc desc{.label = "trace",
                         .compute = {},
                         .vertex = "pass/fullscreen.vert",
                         .fragment = "pass/trace.frag",
                         .defines = {}};
    const auto define = [&](bool on, const char* name) {
        if (on) desc.defines.emplace_back(name, "1");
    };
    define(features.skip, "TRAVERSAL_SKIP");
    define(features.clear, "TRACE_CLEAR");
    define(features.rough, "TRACE_ROUGH");
    define(features.coated, "TRACE_COATED");
    define(features.sun, "TRACE_SUN");
    define(features.sky, "TRACE_SKY");
    define(features.emitters, "TRACE_EMITTERS");
    define(features.smooth_water, "TRACE_SMOOTH_WATER");
    define(features.count, "TRACE_COUNT");
    return desc;
}

}  // namespace

TracePass::TracePass(const TraceFeatures& features) : features_(features), program_(describe(features)) {}

void TracePass::draw(const Inputs& inputs, const Outputs& outputs) const {
    inputs.cells.bind_image(IMAGE_CELLS, GL_READ_ONLY);
    if (features_.skip) inputs.brick_rooms.bind_image(IMAGE_BRICK_ROOMS, GL_READ_ONLY);
    if (features_.coated) {
        inputs.albedo_table.bind(BINDING_ALBEDO_TABLE);
        inputs.metal_albedo_table.bind(BINDING_METAL_ALBEDO_TABLE);
    }
    if (features_.rough) inputs.glass_albedo_table.bind(BINDING_GLASS_ALBEDO_TABLE);
    if (inputs.emitters != nullptr) inputs.emitters->bind();
    inputs.rejected.bind_storage(0);
    if (features_.clear) {
        inputs.brick_changed.bind(BINDING_BRICK_CHANGED);
        program_.set("still_since", inputs.still_since);
    }
    if (inputs.new_pixel_samples > 1) {
        inputs.previous_radiance->bind_image(IMAGE_PREVIOUS_RADIANCE, GL_READ_ONLY);
        inputs.previous_surface->bind_image(IMAGE_PREVIOUS_SURFACE, GL_READ_ONLY);
    }
    program_.set("new_pixel_samples", inputs.new_pixel_samples);
    program_.set("stride", inputs.stride);
    program_.use();
    outputs.target.draw_rows(outputs.rows.value_or(gl::Rows{0, outputs.target.size().y}));
}

void TracePass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    CHECK(!features_.emitters || inputs.emitters != nullptr);
    const auto scope = timers.scope(outputs.timed_as);
    draw(inputs, outputs);
}

void TracePass::rehearse(const TraceShapes& shapes) const {
    // Nothing but zeros, and so no samples in a pixel.
    const gl::Buffer frame("rehearsal: frame", sizeof(FrameBlock));
    const gl::Buffer materials("rehearsal: materials", materials_bytes);
    const gl::Buffer emitters("rehearsal: emitters", sizeof(EmitterTreeHead) + sizeof(glm::vec4));
    const gl::Buffer rejected("rehearsal: rejected", sizeof(std::uint32_t));
    frame.bind_uniform(BINDING_FRAME);
    materials.bind_uniform(BINDING_MATERIALS);
    emitters.bind_storage(STORAGE_EMITTER_TREE);
    emitters.bind_storage(STORAGE_EMITTER_MASKS);
    const std::array<gl::Texture, 2> targets{gl::Texture(shapes.targets[0]), gl::Texture(shapes.targets[1])};
    const gl::Framebuffer target("rehearsal", {&targets[0], &targets[1]});
    const gl::Texture cells(shapes.cells);
    const gl::Texture brick_rooms(shapes.brick_rooms);
    const gl::Texture brick_changed(shapes.brick_changed);
    const gl::Texture albedo_table(shapes.albedo_table);
    const gl::Texture metal_albedo_table(shapes.metal_albedo_table);
    const gl::Texture glass_albedo_table(shapes.glass_albedo_table);
    draw({.cells = cells,
          .brick_rooms = brick_rooms,
          .albedo_table = albedo_table,
          .metal_albedo_table = metal_albedo_table,
          .glass_albedo_table = glass_albedo_table,
          .emitters = nullptr,
          .rejected = rejected,
          .brick_changed = brick_changed,
          .still_since = 0},
         {.target = target});
    if (features_.emitters) {
        gl::Timers timers;
        const glm::ivec3 size_bricks{2};
        EmittersPass(size_bricks)
            .record({.cells = cells, .changes = ChangeLog(size_bricks), .version = 1}, timers);
        timers.finish();
    }
    glFinish();
}

}  // namespace tarn
