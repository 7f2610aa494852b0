// Images in memory and their files: PNG (8-bit sRGB) and OpenEXR (float32 linear). Row 0 is the top row.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

namespace tarn {

struct ImageRgba8 {  // sRGB-encoded
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;  // height x width x 4
};

struct ImageRgb32f {  // linear radiance
    int width = 0, height = 0;
    std::vector<float> pixels;  // height x width x 3
};

// Both throw Error naming the file when it cannot be written, and leave no part of it.
void write_png(const std::filesystem::path& path, const ImageRgba8& image);
void write_exr(const std::filesystem::path& path, const ImageRgb32f& image);

// Throws Error when the file is missing or not a picture.
ImageRgba8 read_png(const std::filesystem::path& path);
ImageRgb32f read_exr(const std::filesystem::path& path);

}  // namespace tarn
