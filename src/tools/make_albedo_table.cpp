// Build-time tool: prints the albedo tables of src/reference/albedo.h as C++ arrays.
#include <fmt/format.h>

#include "reference/albedo.h"

namespace {

void print_array(const char* name, const std::vector<float>& values) {
    fmt::print("constexpr float {}[] = {{\n", name);
    int column = 0;
    for (const float value : values) fmt::print("{:.8e}f,{}", value, ++column % 8 == 0 ? "\n" : " ");
    fmt::print("}};\n");
}

}  // namespace

int main() {
    print_array("albedo_table", tarn::make_albedo_table());
    print_array("metal_albedo_table", tarn::make_metal_albedo_table());
    print_array("glass_albedo_table", tarn::make_glass_albedo_table());
}
