#include "app/stats.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "gl/context.h"

namespace tarn {

namespace {

using nlohmann::ordered_json;

ordered_json counts_of(const Census& census) {
    ordered_json counts = ordered_json::object();
    for (const std::uint8_t id : named_materials())
        counts[std::string(material_name(id))] = census.voxels[id];
    for (std::size_t id = 0; id < census.voxels.size(); ++id) {
        const bool unnamed = material_name(static_cast<std::uint8_t>(id)).empty();
        if (unnamed && census.voxels[id] > 0) counts[fmt::format("{}", id)] = census.voxels[id];
    }
    return counts;
}

ordered_json vec(glm::vec3 v) {
    return {v.x, v.y, v.z};
}

ordered_json properties(const Material& m) {
    return {{"base_color", vec(m.base_color)},
            {"roughness", m.roughness},
            {"metallic", m.metallic},
            {"ior", m.ior},
            {"absorption_per_m", vec(m.absorption_per_m)},
            {"emission", vec(m.emission)}};
}

}  // namespace

std::string stats_json(const StatsInputs& in) {
    const Cells cells = in.simulation.read_cells();
    const Census census = take_census(cells);
    const FlowTotals flow = in.simulation.flow_totals();
    const EditTotals& edits = in.simulation.edit_totals();
    const glm::ivec3 size = cells.size_vox();
    const gl::DriverInfo driver = gl::driver_info();

    ordered_json stats;
    stats["scene"] = in.scene.name;
    stats["seed"] = in.scene.seed;
    stats["size"] = {size.x, size.y, size.z};
    stats["metres_per_voxel"] = in.scene.metres_per_voxel;
    stats["ticks"] = in.simulation.tick();
    stats["counts"] = counts_of(census);
    stats["water_quanta"] = census.water_quanta;
    stats["active_bricks"] = in.simulation.active_bricks();
    for (const std::uint8_t id : named_materials())
        stats["material_ids"][std::string(material_name(id))] = id;
    stats["cells_hash"] = fmt::format("{:016x}", hash_of(cells));
    stats["flow"] = {{"sprung_water_quanta", flow.sprung_water_quanta},
                     {"drained_water_quanta", flow.drained_water_quanta},
                     {"sprung_sand_voxels", flow.sprung_sand_voxels},
                     {"drained_sand_voxels", flow.drained_sand_voxels}};
    stats["edits"] = {
        {"placed", {{"counts", counts_of(edits.placed)}, {"water_quanta", edits.placed.water_quanta}}},
        {"removed", {{"counts", counts_of(edits.removed)}, {"water_quanta", edits.removed.water_quanta}}}};

    in.timers.finish();
    ordered_json passes = ordered_json::object();
    for (const gl::PassTime& pass : in.timers.passes()) {
        if (pass.frames > 0)
            passes[pass.name] = {{"mean", pass.total_ms / static_cast<double>(pass.frames)},
                                 {"runs", pass.frames}};
    }
    stats["pass_ms"] = passes;
    stats["compile_ms"] = in.compile_ms;
    stats["samples"] = in.samples;
    stats["rejected_samples"] = in.rejected_samples;
    stats["driver"] = {{"vendor", driver.vendor}, {"renderer", driver.renderer}, {"version", driver.version}};
    for (const std::uint8_t id : named_materials())
        stats["materials"][std::string(material_name(id))] = properties(in.scene.materials[id]);
    stats["settings"] = ordered_json::parse(settings_json(in.settings));
    return stats.dump(2) + "\n";
}

}  // namespace tarn
