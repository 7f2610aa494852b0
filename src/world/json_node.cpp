#include "world/json_node.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace tarn {

using nlohmann::json;

namespace {

constexpr std::size_t shown_length_max = 200;
constexpr std::size_t depth_max = 32;

std::string key_path(const std::string& parent, std::string_view key) {
    return parent.empty() ? printable(key) : fmt::format("{}.{}", parent, printable(key));
}

// Builds the document; refuses keys that occur twice, which nlohmann's own builder would drop in silence.
class Builder : public nlohmann::json_sax<json> {
  public:
    Builder(const std::string& text, const std::string& origin) : text_(text), origin_(origin) {}
    json take() { return std::move(root_); }

    bool null() override { return add(json(nullptr)); }
    bool boolean(bool value) override { return add(json(value)); }
    bool number_integer(json::number_integer_t value) override { return add(json(value)); }
    bool number_unsigned(json::number_unsigned_t value) override { return add(json(value)); }
    bool number_float(json::number_float_t value, const std::string&) override { return add(json(value)); }
    bool string(std::string& value) override { return add(json(std::move(value))); }
    bool binary(json::binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(json::object()); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool key(std::string& name) override {
        if (open_.back()->contains(name)) fail("{}: {}: key given twice", origin_, key_path(path(), name));
        keys_.back() = name;
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const json::exception& error) override {
        const std::size_t end = std::min(position > 0 ? position - 1 : 0, text_.size());
        const auto line =
            std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(end), '\n') + 1;
        const std::size_t line_start = end == 0 ? std::string::npos : text_.rfind('\n', end - 1);
        const std::size_t column = line_start == std::string::npos ? end + 1 : end - line_start;
        // nlohmann's text is "[id] parse error at line L, column C: reason"; only the reason is kept.
        std::string reason = error.what();
        if (const auto bracket = reason.find("] "); bracket != std::string::npos)
            reason.erase(0, bracket + 2);
        if (const auto colon = reason.find(": ");
            reason.starts_with("parse error") && colon != std::string::npos)
            reason.erase(0, colon + 2);
        fail("{}: line {}, column {}: not JSON: {}", origin_, line, column, printable(reason));
    }

  private:
    std::string path() const {
        std::string path;
        for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
            if (open_[i]->is_array())
                path += fmt::format("[{}]", open_[i]->size() - 1);
            else
                path = key_path(path, keys_[i]);
        }
        return path;
    }
    bool add(json value) { return place(std::move(value)) != nullptr; }
    json* place(json value) {
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        json& parent = *open_.back();
        if (parent.is_array()) {
            parent.push_back(std::move(value));
            return &parent.back();
        }
        return &(parent[keys_.back()] = std::move(value));
    }
    bool open(json value) {
        if (open_.size() >= depth_max)
            fail("{}: {}: nested too deep; allowed: {} levels", origin_, printable(path()), depth_max);
        open_.push_back(place(std::move(value)));
        keys_.emplace_back();
        return true;
    }
    bool close() {
        open_.pop_back();
        keys_.pop_back();
        return true;
    }

    const std::string& text_;
    const std::string& origin_;
    json root_;
    std::vector<json*> open_;
    std::vector<std::string> keys_;
};

std::string range_text(double min, double max) {
    return fmt::format("{} to {}", min, max);
}

}  // namespace

std::string printable(std::string_view text) {
    std::string out(text.substr(0, shown_length_max));
    for (char& c : out) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }
    if (text.size() > shown_length_max) out += "...";
    return out;
}

JsonNode JsonNode::parse(const std::string& text, const std::string& origin) {
    auto shared_origin = std::make_shared<const std::string>(printable(origin));
    Builder builder(text, *shared_origin);
    json::sax_parse(text, &builder);
    auto root = std::make_shared<const json>(builder.take());
    const json* value = root.get();
    return {std::move(shared_origin), std::move(root), value, ""};
}

void JsonNode::refuse(std::string_view reason, std::string_view allowed) const {
    fail("{}: {}{}{}; allowed: {}", *origin_, path_, path_.empty() ? "" : ": ", reason, allowed);
}

std::string JsonNode::got() const {
    switch (value_->type()) {
        case json::value_t::null:
            return "null";
        case json::value_t::object:
            return "an object";
        case json::value_t::array:
            return fmt::format("an array of {}", value_->size());
        default:
            return printable(value_->dump(-1, ' ', true, json::error_handler_t::replace));
    }
}

JsonNode JsonNode::child(const json& value, std::string path) const {
    return {origin_, root_, &value, std::move(path)};
}

void JsonNode::allow_only(std::initializer_list<std::string_view> keys) const {
    const std::string allowed = fmt::format("{}", fmt::join(keys, ", "));
    if (!value_->is_object())
        refuse(fmt::format("{} where an object is needed", got()), fmt::format("an object of {}", allowed));
    for (const auto& [key, value] : value_->items()) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
            child(value, key_path(path_, key)).refuse("unknown key", allowed);
    }
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
    if (!value_->is_object()) return std::nullopt;
    const auto found = value_->find(key);
    if (found == value_->end()) return std::nullopt;
    return child(*found, key_path(path_, key));
}

JsonNode JsonNode::need(std::string_view key) const {
    if (auto found = find(key)) return *std::move(found);
    fail("{}: {}: missing, and it has no default", *origin_, key_path(path_, key));
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
    if (!value_->is_object()) refuse(fmt::format("{} where an object is needed", got()), "an object");
    std::vector<std::pair<std::string, JsonNode>> members;
    for (const auto& [key, value] : value_->items())
        members.emplace_back(key, child(value, key_path(path_, key)));
    return members;
}

std::vector<JsonNode> JsonNode::items() const {
    if (!value_->is_array()) refuse(fmt::format("{} where an array is needed", got()), "an array");
    std::vector<JsonNode> items;
    for (std::size_t i = 0; i < value_->size(); ++i)
        items.push_back(child((*value_)[i], fmt::format("{}[{}]", path_, i)));
    return items;
}

double JsonNode::number(double min, double max) const {
    if (!value_->is_number()) refuse(fmt::format("{} where a number is needed", got()), range_text(min, max));
    const double number = value_->get<double>();
    if (!std::isfinite(number) || number < min || number > max)
        refuse(fmt::format("{} is out of range", got()), range_text(min, max));
    return number;
}

std::int64_t JsonNode::integer(std::int64_t min, std::int64_t max) const {
    const std::string allowed = fmt::format("a whole number from {} to {}", min, max);
    if (!value_->is_number()) refuse(fmt::format("{} where a whole number is needed", got()), allowed);
    const double number = value_->get<double>();
    if (number != std::floor(number)) refuse(fmt::format("{} is not a whole number", got()), allowed);
    // Both ends lie far below 2^53, where double still holds every whole number.
    if (number < static_cast<double>(min) || number > static_cast<double>(max))
        refuse(fmt::format("{} is out of range", got()), allowed);
    return static_cast<std::int64_t>(number);
}

bool JsonNode::flag() const {
    if (!value_->is_boolean()) refuse(fmt::format("{} where true or false is needed", got()), "true, false");
    return value_->get<bool>();
}

std::string JsonNode::text() const {
    if (!value_->is_string()) refuse(fmt::format("{} where text is needed", got()), "text in quotes");
    return value_->get<std::string>();
}

std::vector<JsonNode> JsonNode::array_of(std::size_t n, std::string_view allowed) const {
    if (!value_->is_array() || value_->size() != n)
        refuse(fmt::format("{} where {} numbers are needed", got(), n), allowed);
    return items();
}

glm::dvec2 JsonNode::vec2(double min, double max) const {
    const auto parts = array_of(2, fmt::format("[a, b], each {}", range_text(min, max)));
    return {parts[0].number(min, max), parts[1].number(min, max)};
}

glm::dvec3 JsonNode::vec3(double min, double max) const {
    const auto parts = array_of(3, fmt::format("[a, b, c], each {}", range_text(min, max)));
    return {parts[0].number(min, max), parts[1].number(min, max), parts[2].number(min, max)};
}

glm::ivec3 JsonNode::ivec3(int min, int max) const {
    const auto parts = array_of(3, fmt::format("[x, y, z], each a whole number from {} to {}", min, max));
    glm::ivec3 value;
    for (int axis = 0; axis < 3; ++axis) value[axis] = static_cast<int>(parts[axis].integer(min, max));
    return value;
}

}  // namespace tarn
