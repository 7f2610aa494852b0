#include "world/recording.h"

#include <algorithm>

#include "core/assets.h"
#include "core/error.h"
#include "core/files.h"
#include "world/json_node.h"

namespace tarn {

namespace {

constexpr auto folder = "assets/recordings/";
constexpr double position_max_vox = 1e7;
constexpr int ticks_max = 1000;
constexpr int radius_max_vox = 256;
constexpr const char* shape_names[] = {"sphere", "cube"};
constexpr const char* stroke_names[] = {"undo", "redo"};

std::size_t choice_of(const JsonNode& node, std::span<const char* const> names) {
    const auto found = std::find(names.begin(), names.end(), node.text());
    if (found == names.end()) node.refuse("no such choice", fmt::format("{}", fmt::join(names, ", ")));
    return static_cast<std::size_t>(found - names.begin());
}

std::vector<int> read_ticks(const JsonNode& root, int frames) {
    const auto node = root.find("ticks_per_frame");
    if (!node) return std::vector<int>(frames, 0);
    if (!node->is_array()) return std::vector<int>(frames, static_cast<int>(node->integer(0, ticks_max)));
    std::vector<int> ticks;
    for (const JsonNode& item : node->items()) ticks.push_back(static_cast<int>(item.integer(0, ticks_max)));
    if (static_cast<int>(ticks.size()) != frames)
        node->refuse(fmt::format("{} numbers for {} frames", ticks.size(), frames),
                     "one number, or one for each frame");
    return ticks;
}

CameraKey read_key(const JsonNode& node, int last_frame, const Recording& recording) {
    node.allow_only({"frame", "position_vox", "yaw_deg", "pitch_deg", "fov_deg"});
    CameraKey key;
    const int first = recording.keys.empty() ? 0 : recording.keys.back().frame + 1;
    const int last = recording.keys.empty() ? 0 : last_frame;
    key.frame = static_cast<int>(node.need("frame").integer(first, last));
    if (recording.relative) {
        if (const auto at = node.find("position_vox"))
            key.position_vox = glm::vec3(at->vec3(-position_max_vox, position_max_vox));
    } else {
        key.position_vox = glm::vec3(node.need("position_vox").vec3(-position_max_vox, position_max_vox));
    }
    if (const auto yaw = node.find("yaw_deg")) key.yaw_deg = static_cast<float>(yaw->number(-360, 360));
    if (const auto pitch = node.find("pitch_deg"))
        key.pitch_deg = static_cast<float>(pitch->number(-180, 180));
    if (const auto fov = node.find("fov_deg")) key.fov_deg = static_cast<float>(fov->number(1, 179));
    return key;
}

RecordedEdit read_edit(const JsonNode& node, int first_frame, int last_frame) {
    node.allow_only(
        {"frame", "center_vox", "shape", "radius_vox", "material", "overwrite", "begins", "stroke"});
    RecordedEdit edit;
    edit.frame = static_cast<int>(node.need("frame").integer(first_frame, last_frame));
    if (const auto stroke = node.find("stroke")) {
        node.allow_only({"frame", "stroke"});
        edit.kind =
            choice_of(*stroke, stroke_names) == 0 ? RecordedEdit::Kind::Undo : RecordedEdit::Kind::Redo;
        return edit;
    }
    edit.center_vox = glm::vec3(node.need("center_vox").vec3(-position_max_vox, position_max_vox));
    if (const auto shape = node.find("shape"))
        edit.edit.shape = static_cast<BrushShape>(choice_of(*shape, shape_names));
    if (const auto radius = node.find("radius_vox"))
        edit.edit.radius_vox = static_cast<int>(radius->integer(0, radius_max_vox));
    const JsonNode material = node.need("material");
    const auto id = material_id(material.text());
    if (!id) {
        std::vector<std::string_view> names;
        for (const std::uint8_t known : named_materials()) names.push_back(material_name(known));
        material.refuse("unknown material", fmt::format("{}", fmt::join(names, ", ")));
    }
    edit.edit.material = *id;
    if (const auto overwrite = node.find("overwrite")) edit.edit.overwrite = overwrite->flag();
    if (const auto begins = node.find("begins")) edit.begins = begins->flag();
    return edit;
}

}  // namespace

bool Recording::moves_world() const {
    return !edits.empty() || std::any_of(ticks.begin(), ticks.end(), [](int n) { return n > 0; });
}

bool Recording::moves_camera() const {
    return keys.size() > 1;
}

Recording parse_recording(const std::string& text, const std::string& origin) {
    const JsonNode root = JsonNode::parse(text, origin);
    root.allow_only({"description", "camera", "frames", "lead_frames", "ticks_per_frame", "keys", "edits"});
    Recording recording;
    recording.name = asset_name(origin);
    if (const auto node = root.find("description")) recording.description = printable(node->text());
    constexpr const char* kinds[] = {"relative", "absolute"};
    recording.relative = choice_of(root.need("camera"), kinds) == 0;
    const auto frames = static_cast<int>(root.need("frames").integer(1, recording_frames_max));
    if (const auto node = root.find("lead_frames"))
        recording.lead_frames = static_cast<int>(node->integer(0, recording_frames_max));
    recording.ticks = read_ticks(root, frames);
    for (const JsonNode& node : root.need("keys").items())
        recording.keys.push_back(read_key(node, frames - 1, recording));
    if (recording.keys.empty()) root.need("keys").refuse("no key", "one at frame 0, and any after it");
    if (const auto list = root.find("edits"))
        for (const JsonNode& node : list->items())
            recording.edits.push_back(
                read_edit(node, recording.edits.empty() ? 0 : recording.edits.back().frame, frames - 1));
    return recording;
}

Recording load_recording(const std::string& name_or_path) {
    if (name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".json"))
        return parse_recording(read_text_file(name_or_path), name_or_path);
    for (const std::string& path : list_assets(folder))
        if (asset_name(path) == name_or_path) return parse_recording(read_asset(path), path);
    fail("recording {}: no built-in recording of this name; allowed: {}, or a path to a .json file",
         printable(name_or_path), fmt::join(builtin_recordings(), ", "));
}

std::vector<std::string> builtin_recordings() {
    std::vector<std::string> names;
    for (const std::string& path : list_assets(folder)) names.push_back(asset_name(path));
    return names;
}

std::string recording_json(const Recording& recording) {
    using Json = nlohmann::ordered_json;
    const auto vec = [](glm::vec3 v) { return Json{v.x, v.y, v.z}; };
    Json root;
    root["description"] = recording.description;
    root["camera"] = recording.relative ? "relative" : "absolute";
    root["frames"] = recording.frames();
    root["lead_frames"] = recording.lead_frames;
    root["ticks_per_frame"] = recording.ticks;
    root["keys"] = Json::array();
    for (const CameraKey& key : recording.keys) {
        Json item = {{"frame", key.frame},
                     {"position_vox", vec(key.position_vox)},
                     {"yaw_deg", key.yaw_deg},
                     {"pitch_deg", key.pitch_deg}};
        if (key.fov_deg > 0) item["fov_deg"] = key.fov_deg;
        root["keys"].push_back(item);
    }
    root["edits"] = Json::array();
    for (const RecordedEdit& e : recording.edits) {
        if (e.kind != RecordedEdit::Kind::Edit) {
            root["edits"].push_back(
                {{"frame", e.frame}, {"stroke", stroke_names[e.kind == RecordedEdit::Kind::Undo ? 0 : 1]}});
            continue;
        }
        root["edits"].push_back({{"frame", e.frame},
                                 {"center_vox", vec(e.center_vox)},
                                 {"shape", shape_names[static_cast<std::size_t>(e.edit.shape)]},
                                 {"radius_vox", e.edit.radius_vox},
                                 {"material", std::string(material_name(e.edit.material))},
                                 {"overwrite", e.edit.overwrite},
                                 {"begins", e.begins}});
    }
    return root.dump(1) + "\n";
}

CameraKey camera_at(const Recording& recording, int frame) {
    const auto after = std::upper_bound(recording.keys.begin(), recording.keys.end(), frame,
                                        [](int at, const CameraKey& key) { return at < key.frame; });
    if (after == recording.keys.begin()) return recording.keys.front();
    const CameraKey& a = *(after - 1);
    if (after == recording.keys.end()) return a;
    const CameraKey& b = *after;
    const float part = static_cast<float>(frame - a.frame) / static_cast<float>(b.frame - a.frame);
    CameraKey key{.frame = frame,
                  .position_vox = glm::mix(a.position_vox, b.position_vox, part),
                  .yaw_deg = glm::mix(a.yaw_deg, b.yaw_deg, part),
                  .pitch_deg = glm::mix(a.pitch_deg, b.pitch_deg, part),
                  .fov_deg = a.fov_deg};
    if (a.fov_deg > 0 && b.fov_deg > 0) key.fov_deg = glm::mix(a.fov_deg, b.fov_deg, part);
    return key;
}

}  // namespace tarn
