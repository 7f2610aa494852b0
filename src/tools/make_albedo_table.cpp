// Build-time tool: prints the albedo table of src/reference/albedo.h as the body of a C++ array.
#include <fmt/format.h>

#include "reference/albedo.h"

int main() {
    int column = 0;
    for (const float value : tarn::make_albedo_table()) {
        fmt::print("{:.8e}f,{}", value, ++column % 8 == 0 ? "\n" : " ");
    }
}
