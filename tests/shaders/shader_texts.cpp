// Writes every variant of every shader of glsl/pass, as the driver gets it, into the folder argv[1]. The
// variants are read from the shaders: each macro that a conditional asks about is tried both ways, so that
// none can be forgotten.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "core/assets.h"
#include "core/error.h"
#include "core/files.h"
#include "gl/program.h"

namespace tarn {
namespace {

using Defines = std::vector<std::pair<std::string, std::string>>;

// Macros that stand for a number, with every value that the passes give them.
const std::map<std::string, std::vector<std::string>> numbers = {
    {"AXIS", {"0", "1", "2"}}, {"SHOWN_VIEW", {"1", "2", "3", "4", "5", "6", "7", "8"}}};

// Macros that the passes define only together with another.
const std::map<std::string, std::string> needs = {{"TRACE_ROUGH", "TRACE_CLEAR"},
                                                  {"TRACE_SMOOTH_WATER", "TRACE_CLEAR"}};

bool is_made(const Defines& defines) {
    const auto defined = [&](const std::string& name) {
        return std::any_of(defines.begin(), defines.end(), [&](const auto& d) { return d.first == name; });
    };
    return std::all_of(needs.begin(), needs.end(),
                       [&](const auto& need) { return !defined(need.first) || defined(need.second); });
}

std::set<std::string> names_in(const std::string& text, const char* pattern) {
    const std::regex regex(pattern, std::regex::ECMAScript | std::regex::multiline);
    std::set<std::string> names;
    for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
        names.insert((*it)[1].str());
    return names;
}

// Every combination of the macros that `text` asks about and does not define itself.
std::vector<Defines> variants(const std::string& text) {
    // What each macro may be; an empty text is "not defined".
    std::map<std::string, std::vector<std::string>> choices;
    for (const std::string& name : names_in(text, R"(^\s*#\s*(?:el)?if\s+!?\s*([A-Z]\w*)\s*$)"))
        choices[name] = {"0", "1"};
    for (const char* pattern : {R"(^\s*#\s*ifn?def\s+(\w+))", R"(\bdefined\s*\(?\s*(\w+))"})
        for (const std::string& name : names_in(text, pattern)) choices[name] = {"", "1"};
    for (const auto& [name, values] : numbers)
        if (text.find(name) != std::string::npos) choices[name] = values;
    for (const std::string& name : names_in(text, R"(^\s*#\s*define\s+(\w+))")) choices.erase(name);
    choices.erase("__cplusplus");

    std::vector<Defines> all = {{}};
    for (const auto& [name, values] : choices) {
        std::vector<Defines> product;
        for (const Defines& defines : all) {
            for (const std::string& value : values) {
                product.push_back(defines);
                if (!value.empty()) product.back().emplace_back(name, value);
            }
        }
        all = std::move(product);
    }
    std::erase_if(all, [](const Defines& defines) { return !is_made(defines); });
    return all;
}

int run(const std::filesystem::path& folder) {
    std::size_t count = 0;
    for (const std::string& asset : list_assets("glsl/pass/")) {
        const std::filesystem::path file = std::filesystem::path(asset).filename();
        for (const Defines& defines : variants(gl::shader_text("pass/" + file.string(), {}).text)) {
            std::string name = file.stem().string();
            for (const auto& [macro, value] : defines) name += fmt::format("-{}_{}", macro, value);
            write_file(folder / (name + file.extension().string()),
                       gl::shader_text("pass/" + file.string(), defines).text);
            ++count;
        }
    }
    fmt::print("{} shader texts\n", count);
    return count > 0 ? 0 : 1;
}

}  // namespace
}  // namespace tarn

int main(int argc, char** argv) {
    try {
        if (argc != 2) tarn::fail("shader_texts: one argument, the folder to write to");
        return tarn::run(argv[1]);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
}
