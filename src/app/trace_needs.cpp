#include "app/trace_needs.h"

#include "app/views.h"
#include "shared/trace.h"

namespace tarn {

namespace {

TraceFeatures features_of(const Settings& settings, const MaterialTable& materials, bool has_sun,
                          const std::function<bool(std::size_t id)>& may_hold) {
    TraceFeatures features;
    for (std::size_t id = MATERIAL_AIR + 1; id < materials.size(); ++id) {
        if (!may_hold(id)) continue;
        const Material& m = materials[id];
        const bool clear = id == MATERIAL_WATER || id == MATERIAL_GLASS;
        if (clear) features.rough |= m.roughness * m.roughness >= ALPHA_SMOOTH;
        if (!clear) features.coated |= m.ior != 1 || m.metallic > 0;
        features.clear |= clear;
        features.emitters |= id != MATERIAL_WATER && shines(m);  // as in lib/emitter_tree
    }
    const bool sampled = settings.light_sampling != LightSampling::None;
    features.skip = settings.traversal == Traversal::Distance;
    features.sun = sampled && has_sun;
    features.sky = settings.light_sampling == LightSampling::All;
    features.emitters &= sampled;
    features.smooth_water = settings.smooth_water && may_hold(MATERIAL_WATER);
    return features;
}

}  // namespace

TraceFeatures needed_features(const Settings& settings, const MaterialTable& materials,
                              const FrameBlock& block, const std::function<bool(std::size_t id)>& may_hold) {
    TraceFeatures features = features_of(settings, materials, block.sun_radiance.w > 0, may_hold);
    features.count = counts_paths(settings.view);
    return features;
}

TraceFeatures general_features(const Settings& settings, const MaterialTable& materials) {
    return features_of(settings, materials, true, [](std::size_t) { return true; });
}

TraceFeatures with(const TraceFeatures& a, const TraceFeatures& b) {
    return {.skip = a.skip || b.skip,
            .clear = a.clear || b.clear,
            .rough = a.rough || b.rough,
            .coated = a.coated || b.coated,
            .sun = a.sun || b.sun,
            .sky = a.sky || b.sky,
            .emitters = a.emitters || b.emitters,
            .smooth_water = a.smooth_water || b.smooth_water,
            .count = a.count || b.count};
}

}  // namespace tarn
