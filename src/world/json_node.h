// Reading a JSON text with errors that name the place: a value, the path to it, and checked conversions.
// Knows nothing of scenes.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tarn {

// `text` fit for one line of an error message: control characters replaced, long text cut.
std::string printable(std::string_view text);

class JsonNode {
  public:
    // Parses a whole text; `origin` names it in errors. Throws Error with line and column where it is not
    // JSON, holds a key twice in one object, or nests deeper than any scene needs.
    static JsonNode parse(const std::string& text, const std::string& origin);

    // Throws Error: "origin: path: reason; allowed: allowed".
    [[noreturn]] void refuse(std::string_view reason, std::string_view allowed) const;

    // Throws Error unless this is an object with no other keys than `keys`.
    void allow_only(std::initializer_list<std::string_view> keys) const;
    std::optional<JsonNode> find(std::string_view key) const;
    JsonNode need(std::string_view key) const;                      // throws Error where it is missing
    std::vector<std::pair<std::string, JsonNode>> members() const;  // of an object
    std::vector<JsonNode> items() const;                            // of an array
    bool is_array() const { return value_->is_array(); }
    const std::string& path() const { return path_; }

    // Each throws Error where type or range do not fit; ranges include both ends.
    double number(double min, double max) const;
    std::int64_t integer(std::int64_t min, std::int64_t max) const;
    bool flag() const;  // true or false
    std::string text() const;
    glm::dvec2 vec2(double min, double max) const;
    glm::dvec3 vec3(double min, double max) const;
    glm::ivec3 ivec3(int min, int max) const;

  private:
    JsonNode(std::shared_ptr<const std::string> origin, std::shared_ptr<const nlohmann::json> root,
             const nlohmann::json* value, std::string path)
        : origin_(std::move(origin)), root_(std::move(root)), value_(value), path_(std::move(path)) {}
    JsonNode child(const nlohmann::json& value, std::string path) const;
    std::string got() const;
    std::vector<JsonNode> array_of(std::size_t n, std::string_view allowed) const;

    std::shared_ptr<const std::string> origin_;
    std::shared_ptr<const nlohmann::json> root_;
    const nlohmann::json* value_;
    std::string path_;
};

}  // namespace tarn
