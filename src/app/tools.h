// The player's hands: the brush, what it aims at, and the edits that a frame of input asks for. Knows no GL;
// applies nothing.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "app/renderer.h"
#include "platform/platform.h"
#include "world/edits.h"

namespace tarn {

constexpr int brush_radius_max_vox = 32;
constexpr float reach_vox = 200;

// Materials of the number keys 1 to 9.
constexpr std::array<std::uint8_t, 9> palette = {MATERIAL_STONE, MATERIAL_DIRT,  MATERIAL_GRASS,
                                                 MATERIAL_SAND,  MATERIAL_GLASS, MATERIAL_METAL,
                                                 MATERIAL_LAMP,  MATERIAL_WALL,  MATERIAL_WATER};

struct Brush {
    std::uint8_t material = MATERIAL_WATER;  // an id of the palette
    BrushShape shape = BrushShape::Sphere;
    int radius_vox = 2;
    bool overwrite = false;

    // The brush of water meets its surface; any other goes through water, to build and dig under it.
    bool goes_through_water() const { return material != MATERIAL_WATER; }
};

// A ray of the pointer, in voxels; `dir` has unit length.
struct Ray {
    glm::vec3 origin, dir;
};

// The cell for the brush's centre: before the face hit when placing, the cell hit when removing. Nothing
// without a hit within reach, or when placing from inside a voxel.
std::optional<glm::ivec3> target_cell(const Pick& pick, bool placing, glm::vec3 eye_vox);

// Edges of the brush: a box, or three circles of a sphere; radius 0 is the voxel's box. In voxels.
std::vector<std::array<glm::vec3, 2>> outline_of(const Brush& brush, glm::ivec3 center_vox);

class Tools {
  public:
    Brush brush;

    // Number keys, shape, overwrite, wheel.
    void choose(const Input& input);
    // Takes the material of a voxel seen, if it has a name.
    void take_material(const Pick& pick);

    // A stroke that places holds the plane in which it began, so that it neither climbs towards the eye nor
    // follows the water it pours; it needs no pick. A stroke that removes digs on where it aims.
    bool needs_pick(const Input& input) const;

    struct Stroke {
        bool begins = false;
        std::vector<Edit> edits;  // in order
    };
    // One frame: aims, and returns what to apply at `tick`.
    Stroke use(const Input& input, const Pick& pick, const Ray& ray, std::uint64_t tick);

    // A held button does nothing until it is pressed again.
    void end_stroke() { mode_ = Mode::Idle; }

    // Where the brush would land, after use().
    const std::optional<glm::ivec3>& aim() const { return aim_; }
    bool removing() const { return mode_ == Mode::Remove; }

  private:
    enum class Mode { Idle, Place, Remove };
    struct Plane {
        int axis;
        float at_vox;  // of the face hit
        int cell;      // of the layer to fill
    };
    void start_or_end(const Input& input);
    std::optional<glm::ivec3> aim_in_plane(const Ray& ray) const;
    void place_up_to(glm::ivec3 cell, Stroke& stroke, Edit edit);

    Mode mode_ = Mode::Idle;
    std::optional<Plane> plane_;
    std::optional<glm::ivec3> aim_, last_;  // last_: the last cell placed at in this stroke
    double since_edit_s_ = 0;
    float wheel_rest_ = 0;  // touch pads send parts of a step
};

}  // namespace tarn
