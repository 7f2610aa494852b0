// Emissive voxels as lights: their tree against a count over the cells, its samples against solid angles in
// closed form, and light sampling against chance.
#include <algorithm>
#include <numbers>

#include "app/frame_block.h"
#include "passes/bricks.h"
#include "passes/emitters.h"
#include "picture.h"
#include "shared/bindings.h"
#include "worlds.h"

namespace tarn {
namespace {

class EmittersTest : public GlTest {};

bool lets_light_out(const Cells& cells, glm::ivec3 cell) {
    const std::uint32_t id = material_of(cells.get(cell, MATERIAL_AIR));
    return id == MATERIAL_AIR || id == MATERIAL_WATER || id == MATERIAL_GLASS;
}

constexpr glm::ivec3 face_directions[] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                          {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};

struct Leaves {  // by brick, x fastest
    std::vector<glm::uvec2> masks;
    std::vector<double> power;
};

Leaves count_leaves(const Cells& cells, const MaterialTable& materials) {
    const glm::ivec3 bricks = bricks_of(cells.size_vox());
    const std::size_t n = std::size_t{1} * bricks.x * bricks.y * bricks.z;
    Leaves leaves{std::vector<glm::uvec2>(n, glm::uvec2(0)), std::vector<double>(n, 0)};
    const glm::ivec3 size = cells.size_vox();
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const std::uint8_t byte = cells.at({x, y, z});
                const glm::vec3 shines = materials[byte].emission;
                if (is_water(byte) || std::max({shines.x, shines.y, shines.z}) <= 0) continue;
                const int exposed =
                    static_cast<int>(std::ranges::count_if(face_directions, [&](glm::ivec3 d) {
                        return lets_light_out(cells, glm::ivec3(x, y, z) + d);
                    }));
                if (exposed == 0) continue;
                const glm::ivec3 brick = glm::ivec3(x, y, z) / BRICK_SIDE;
                const std::size_t at = brick.x + std::size_t{1} * bricks.x * (brick.y + bricks.y * brick.z);
                const int bit = x % 4 + 4 * (y % 4) + 16 * (z % 4);
                leaves.masks[at][bit / 32] |= 1u << (bit % 32);
                leaves.power[at] += exposed * (0.2126 * shines.x + 0.7152 * shines.y + 0.0722 * shines.z);
            }
    return leaves;
}

// The pass with the material block that it reads.
struct Tree {
    glm::ivec3 size_bricks;
    EmittersPass pass;
    gl::Buffer materials{"materials", sizeof(make_material_block({}))};
    gl::Timers timers;

    Tree(glm::ivec3 size_vox, const MaterialTable& table)
        : size_bricks(bricks_of(size_vox)), pass(size_bricks) {
        materials.upload(make_material_block(table));
    }
    void update(const Simulation& simulation) {
        materials.bind_uniform(BINDING_MATERIALS);
        pass.record({.cells = simulation.cells(),
                     .changes = simulation.changes(),
                     .version = static_cast<std::uint32_t>(simulation.version())},
                    timers);
    }
};

void expect_tree_of(const Tree& tree, const Cells& cells, const MaterialTable& materials) {
    const Leaves leaves = count_leaves(cells, materials);
    const EmitterTreeHead head = emitter_tree_head(tree.size_bricks);
    std::vector<float> power(emitter_node_count(head));
    tree.pass.tree().download(std::span(power), sizeof(EmitterTreeHead));
    std::vector<glm::uvec2> masks(leaves.masks.size());
    tree.pass.masks().download(std::span(masks));
    ASSERT_EQ(masks, leaves.masks);
    double sum = 0;
    // Sums of up to 384 floats.
    for (std::size_t i = 0; i < leaves.power.size(); ++i) {
        ASSERT_NEAR(power[i], leaves.power[i], 1e-5 * leaves.power[i]) << "brick " << i;
        sum += leaves.power[i];
    }
    for (int level = 0; level < head.depth.x; ++level) {
        const glm::ivec4 at = head.levels[level];
        double of_level = 0;
        for (int i = 0; i < at.x * at.y * at.z; ++i) of_level += power[at.w + i];
        EXPECT_NEAR(of_level, sum, 1e-5 * sum) << "level " << level;
    }
}

Scene soup_scene(glm::ivec3 size_vox, Soup soup, std::uint32_t seed) {
    Scene scene;
    scene.materials[MATERIAL_SAND].emission = glm::vec3(1, 2, 3);
    scene.materials[MATERIAL_GLASS].emission = glm::vec3(0.5, 0, 0);
    scene.materials[MATERIAL_WATER].emission = glm::vec3(4);
    scene.cells = make_soup(size_vox, soup, seed);
    return scene;
}

TEST_F(EmittersTest, TheTreeEqualsACountOverTheCellsThroughTicksAndEdits) {
    for (const glm::ivec3 size : {glm::ivec3(1), glm::ivec3(7, 13, 5), glm::ivec3(61, 37, 45)}) {
        for (const Soup soup : {Soup::AllBytes, Soup::Matter, Soup::Layers}) {
            const Scene scene = soup_scene(size, soup, 11);
            gl::Timers timers;
            Simulation simulation(scene, timers);
            Tree tree(size, scene.materials);
            tree.update(simulation);
            expect_tree_of(tree, simulation.read_cells(), scene.materials);
            EditHistory history;
            history.begin_stroke();
            for (int round = 0; round < 3; ++round) {
                simulation.step(2 + round, scene.settings);
                const auto material = static_cast<std::uint8_t>(round == 0 ? MATERIAL_LAMP : MATERIAL_AIR);
                simulation.apply({.center_vox = size / 2, .radius_vox = 2 + round, .material = material},
                                 history);
                simulation.step(1, scene.settings);
                tree.update(simulation);
                expect_tree_of(tree, simulation.read_cells(), scene.materials);
            }
        }
    }
}

// What is built into a lamp or taken from beside it, in the lamp's brick or in the next; some versions later.
TEST_F(EmittersTest, TheTreeFollowsSingleCellsBesideALamp) {
    constexpr glm::ivec3 size(26, 21, 19);
    constexpr glm::ivec3 lamp(11, 8, 7);  // at three faces of its brick
    Scene scene;
    scene.cells = Cells(size);
    scene.cells.at(lamp) = MATERIAL_LAMP;
    gl::Timers timers;
    Simulation simulation(scene, timers);
    simulation.put_to_sleep();
    Tree tree(size, scene.materials);
    tree.update(simulation);
    for (const glm::ivec3 d : face_directions) {
        simulation.write({{lamp + d, MATERIAL_AIR, MATERIAL_STONE}});
        simulation.step(1, Settings{});
        tree.update(simulation);
        expect_tree_of(tree, simulation.read_cells(), scene.materials);
    }
    for (const glm::ivec3 d : face_directions) {
        simulation.write({{lamp + d, MATERIAL_STONE, MATERIAL_GLASS}});
        if (d.x == 0) tree.update(simulation);
    }
    tree.update(simulation);
    expect_tree_of(tree, simulation.read_cells(), scene.materials);
    simulation.write({{lamp, MATERIAL_LAMP, MATERIAL_STONE}});
    tree.update(simulation);
    expect_tree_of(tree, simulation.read_cells(), scene.materials);
}

// Solid angle of a rectangle at distance `d` along its normal, one corner at (x0, y0) and the other at (x1,
// y1).
double rectangle_angle(double x0, double x1, double y0, double y1, double d) {
    const auto corner = [&](double x, double y) {
        return std::atan2(x * y, d * std::sqrt(x * x + y * y + d * d));
    };
    return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

// Of the exposed faces of all emissive voxels, each as if nothing stood before it.
double solid_angle(const Cells& cells, const MaterialTable& materials, glm::dvec3 from) {
    double sum = 0;
    const glm::ivec3 size = cells.size_vox();
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::ivec3 cell(x, y, z);
                if (materials[cells.at(cell)].emission.x <= 0) continue;
                for (const glm::ivec3 d : face_directions) {
                    const int axis = d.x != 0 ? 0 : d.y != 0 ? 1 : 2;
                    const double plane = cell[axis] + (d[axis] > 0 ? 1 : 0);
                    const double distance = (from[axis] - plane) * d[axis];
                    if (distance <= 0 || !lets_light_out(cells, cell + d)) continue;
                    const int u = (axis + 1) % 3;
                    const int v = (axis + 2) % 3;
                    sum += rectangle_angle(cell[u] - from[u], cell[u] + 1 - from[u], cell[v] - from[v],
                                           cell[v] + 1 - from[v], distance);
                }
            }
    return sum;
}

TEST_F(EmittersTest, SamplesHaveTheirDensityAndCoverEverySolidAngle) {
    Scene scene;
    scene.cells = Cells({37, 29, 41});
    for (const glm::ivec3 lamp : {glm::ivec3(3, 20, 30),
                                  {4, 20, 30},
                                  {4, 21, 30},
                                  {5, 21, 30},
                                  {20, 27, 9},
                                  {36, 28, 40},
                                  {18, 9, 18},
                                  {30, 12, 3},
                                  {31, 12, 3}})
        scene.cells.at(lamp) = MATERIAL_LAMP;
    scene.cells.at({20, 27, 8}) = MATERIAL_STONE;
    scene.cells.at({20, 27, 10}) = MATERIAL_GLASS;
    gl::Timers timers;
    const Simulation simulation(scene, timers);
    Tree tree(scene.cells.size_vox(), scene.materials);
    tree.update(simulation);

    constexpr int invocations = 4096;
    constexpr int each = 64;
    const gl::Program program({.label = "emitters", .compute = "tests/kernels/emitters.comp"});
    const gl::Buffer results("results", invocations * sizeof(glm::vec4));
    FrameBlock block;
    block.world_size_vox = glm::ivec4(scene.cells.size_vox(), 0);
    gl::Buffer frame_block("frame block", sizeof(FrameBlock));
    frame_block.upload(std::span(&block, 1));
    frame_block.bind_uniform(BINDING_FRAME);
    simulation.cells().bind_image(IMAGE_CELLS, GL_READ_ONLY);
    tree.pass.bind();
    results.bind_storage(0);
    struct Case {
        glm::vec3 at;
        int axis;
        float side;
    };
    // Every lamp lies in front of the receiver's plane. The last stands a tenth of a voxel from a lamp's
    // face.
    for (const Case& c :
         {Case{{18.3f, 2, 17.6f}, 1, 1}, {{0, 14.5f, 20.2f}, 0, 1}, {{20.5f, 8.9f, 18.5f}, 1, 1}}) {
        program.set("at_vox", c.at);
        program.set("axis", c.axis);
        program.set("side", c.side);
        program.set("per_invocation", static_cast<std::uint32_t>(each));
        program.dispatch_for({invocations, 1, 1}, {64, 1, 1});
        std::vector<glm::vec4> sums(invocations);
        results.download(std::span(sums));
        constexpr double n = 1.0 * invocations * each;
        glm::dvec4 mean(0);
        for (const glm::vec4& s : sums) {
            mean += glm::dvec4(s) / n;
            ASSERT_LT(s.w, 1e-5f) << "densities differ";
        }
        const double error = std::sqrt((mean.y - mean.x * mean.x) / n);
        const double expected = solid_angle(scene.cells, scene.materials, c.at);
        EXPECT_NEAR(mean.x, expected, 4 * error + 1e-5 * expected);
        EXPECT_LT(error, 0.02 * expected);
        EXPECT_LT(mean.z, 0.05) << "samples without light";
    }
}

// Two lamps, one under water, over a floor of `material` with a wall between them.
Scene lamp_room(const char* material) {
    Scene scene = scene_from(R"({"size": [24, 16, 24], "metres_per_voxel": 0.2,
        "camera": {"position_vox": [12, 15, 23], "pitch_deg": -45, "fov_deg": 60},
        "sun": {"irradiance": [0, 0, 0]}, "sky": {"zenith": [0, 0, 0], "horizon": [0, 0, 0]},
        "materials": {"metal": {"roughness": 0.4, "base_color": [0.9, 0.9, 0.9]}, "wall": {"base_color": [0.8, 0.8, 0.8]},
                      "stone": {"ior": 1.5, "roughness": 0.4}, "glass": {"roughness": 0.4}},
        "build": [{"box": {"min": [0, 0, 0], "max": [24, 2, 24], "material": "dirt"}},
                  {"box": {"min": [11, 2, 9], "max": [14, 8, 12], "material": "wall"}},
                  {"box": {"min": [3, 8, 3], "max": [7, 10, 8], "material": "lamp"}},
                  {"box": {"min": [14, 2, 13], "max": [24, 6, 24], "material": "water"}},
                  {"box": {"min": [18, 3, 16], "max": [21, 5, 20], "material": "lamp"}}]})");
    const std::uint8_t id = *material_id(material);
    for (std::uint8_t& cell : scene.cells.bytes())
        if (cell == MATERIAL_DIRT) cell = id;
    // Levels of the water that differ, for what smooth_water passes.
    for (int x = 14; x < 24; ++x) scene.cells.at({x, 5, 20}) = static_cast<std::uint8_t>(water_cell(12));
    return scene;
}

TEST_F(EmittersTest, SamplingEmissiveVoxelsChangesNoMean) {
    for (const bool smooth_water : {false, true}) {
        for (const char* material : {"wall", "stone", "metal", "glass"}) {
            const auto with = [&](LightSampling sampling, int frames) {
                return picture_of(lamp_room(material), frames, {64, 64}, [&](Settings& s) {
                    s.light_sampling = sampling;
                    s.smooth_water = smooth_water;
                });
            };
            const Picture chance = with(LightSampling::None, 64);
            const Picture sampled = with(LightSampling::Lights, 24);
            EXPECT_EQ(sampled.rejected, 0u);
            // The pixels differ among themselves by more than their noise: this error is an upper bound.
            const double error = std::hypot(chance.standard_error(), sampled.standard_error());
            EXPECT_NEAR(sampled.mean().x, chance.mean().x, std::min(3 * error, 0.02 * chance.mean().x))
                << material;
        }
    }
}

TEST_F(EmittersTest, ALampThatIsBuiltAndTakenAwayLightsAndGoesDark) {
    Scene scene = lamp_room("wall");
    std::ranges::replace(scene.cells.bytes(), MATERIAL_LAMP, MATERIAL_AIR);
    apply_quality(scene.settings, Quality::Exact);
    scene.settings.jitter = false;
    gl::Timers timers;
    Simulation simulation(scene, timers);
    Renderer renderer(scene, timers);
    EditHistory history;
    history.begin_stroke();
    const auto light = [&] {
        for (int i = 0; i < 8; ++i) renderer.render(simulation, scene.settings, {32, 32});
        return Picture{renderer.read_radiance(), renderer.rejected_samples()}.mean().x;
    };
    EXPECT_EQ(light(), 0);
    simulation.apply({.center_vox = {5, 9, 5}, .radius_vox = 1, .material = MATERIAL_LAMP}, history);
    const double lit = light();
    EXPECT_GT(lit, 0.01);
    simulation.apply({.center_vox = {5, 9, 5}, .radius_vox = 1, .material = MATERIAL_AIR}, history);
    EXPECT_EQ(light(), 0);
}

TEST_F(EmittersTest, ALampThatIsBuiltOrTakenStartsEveryHistoryAnew) {
    Scene scene = lamp_room("wall");
    apply_quality(scene.settings, Quality::Balanced);
    gl::Timers timers;
    Simulation simulation(scene, timers);
    Renderer renderer(scene, timers);
    EditHistory history;
    history.begin_stroke();
    const auto samples_after = [&](std::uint8_t material) {
        for (int i = 0; i < 3; ++i) renderer.render(simulation, scene.settings, {16, 16});
        EXPECT_EQ(renderer.samples(), 3u);
        simulation.apply({.center_vox = {10, 12, 5}, .material = material, .overwrite = true}, history);
        renderer.render(simulation, scene.settings, {16, 16});
        const std::uint64_t samples = renderer.samples();
        renderer.reset_history();
        return samples;
    };
    EXPECT_EQ(samples_after(MATERIAL_STONE), 4u);
    EXPECT_EQ(samples_after(MATERIAL_LAMP), 1u);
    EXPECT_EQ(samples_after(MATERIAL_AIR), 1u);
}

}  // namespace
}  // namespace tarn
