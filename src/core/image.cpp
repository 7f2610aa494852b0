#include "core/image.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>

#include <cstddef>

#include "core/error.h"
#include "core/files.h"

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace tarn {

namespace {

constexpr const char* exr_channels[3] = {"R", "G", "B"};

Imf::FrameBuffer frame_buffer(float* pixels, int width) {
    Imf::FrameBuffer frame;
    for (int c = 0; c < 3; ++c) {
        // OpenEXR takes char* whatever the channel's type.
        frame.insert(exr_channels[c],
                     Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels + c), 3 * sizeof(float),
                                3 * sizeof(float) * static_cast<std::size_t>(width)));
    }
    return frame;
}

}  // namespace

void write_png(const std::filesystem::path& path, const ImageRgba8& image) {
    CHECK(image.pixels.size() == std::size_t{4} * image.width * image.height);
    std::vector<std::uint8_t> bytes;
    const auto append = [](void* context, void* data, int size) {
        auto* out = static_cast<std::vector<std::uint8_t>*>(context);
        const auto* begin = static_cast<const std::uint8_t*>(data);
        out->insert(out->end(), begin, begin + size);
    };
    if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.pixels.data(),
                               4 * image.width) == 0)
        fail("{}: cannot encode a {}x{} PNG", path.string(), image.width, image.height);
    write_file(path, bytes);
}

void write_exr(const std::filesystem::path& path, const ImageRgb32f& image) {
    CHECK(image.pixels.size() == std::size_t{3} * image.width * image.height);
    write_beside_and_rename(path, [&](const std::filesystem::path& temporary) {
        try {
            Imf::Header header(image.width, image.height);
            for (const char* channel : exr_channels)
                header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
            Imf::OutputFile file(temporary.c_str(), header);
            file.setFrameBuffer(frame_buffer(const_cast<float*>(image.pixels.data()), image.width));
            file.writePixels(image.height);
        } catch (const std::exception& error) {
            fail("{}: cannot write: {}", path.string(), error.what());
        }
    });
}

ImageRgba8 read_png(const std::filesystem::path& path) {
    const std::string bytes = read_text_file(path);
    int channels = 0;
    ImageRgba8 image;
    std::uint8_t* pixels =
        stbi_load_from_memory(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                              static_cast<int>(bytes.size()), &image.width, &image.height, &channels, 4);
    if (pixels == nullptr) fail("{}: not a PNG: {}", path.string(), stbi_failure_reason());
    image.pixels.assign(pixels, pixels + std::size_t{4} * image.width * image.height);
    stbi_image_free(pixels);
    return image;
}

ImageRgb32f read_exr(const std::filesystem::path& path) {
    try {
        Imf::InputFile file(path.c_str());
        const auto window = file.header().dataWindow();
        ImageRgb32f image{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, {}};
        image.pixels.resize(std::size_t{3} * image.width * image.height);
        file.setFrameBuffer(frame_buffer(
            image.pixels.data() - 3 * (window.min.x + std::ptrdiff_t{window.min.y} * image.width),
            image.width));
        file.readPixels(window.min.y, window.max.y);
        return image;
    } catch (const std::exception& error) {
        fail("{}: cannot read as OpenEXR: {}", path.string(), error.what());
    }
}

}  // namespace tarn
