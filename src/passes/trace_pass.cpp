#include "passes/trace_pass.h"

#include "core/error.h"
#include "shared/bindings.h"

namespace tarn {

namespace {

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
    define(features.metal, "TRACE_METAL");
    define(features.sun, "TRACE_SUN");
    define(features.sky, "TRACE_SKY");
    define(features.emitters, "TRACE_EMITTERS");
    define(features.clear_sky, "TRACE_PREETHAM");
    define(features.smooth_water, "TRACE_SMOOTH_WATER");
    define(features.count, "TRACE_COUNT");
    return desc;
}

}  // namespace

TracePass::TracePass(const TraceFeatures& features) : features_(features), program_(describe(features)) {}

void TracePass::record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const {
    const auto scope = timers.scope("trace");
    inputs.cells.bind(BINDING_CELLS);
    if (features_.skip) inputs.brick_distance.bind(BINDING_BRICK_DISTANCE);
    if (features_.coated) inputs.albedo_table.bind(BINDING_ALBEDO_TABLE);
    if (features_.metal) inputs.metal_albedo_table.bind(BINDING_METAL_ALBEDO_TABLE);
    if (features_.rough) inputs.glass_albedo_table.bind(BINDING_GLASS_ALBEDO_TABLE);
    if (features_.emitters) {
        CHECK(inputs.emitters != nullptr);
        inputs.emitters->bind();
    }
    inputs.rejected.bind_storage(0);
    if (features_.clear) {
        inputs.brick_changed.bind(BINDING_BRICK_CHANGED);
        program_.set("still_since", inputs.still_since);
    }
    program_.set("stride", inputs.stride);
    program_.use();
    outputs.target.draw_fullscreen();
}

}  // namespace tarn
