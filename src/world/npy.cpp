#include "world/npy.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fstream>
#include <string>

#include "core/error.h"
#include "core/files.h"

namespace tarn {

namespace {

// Format: numpy/lib/format.py. Magic, version 1.0, header length (16 bits, little-endian), header, data; all
// before the data is a multiple of 64 bytes.
constexpr std::string_view magic("\x93NUMPY\x01\x00", 8);
constexpr std::size_t prefix_bytes = magic.size() + 2;
constexpr std::size_t alignment_bytes = 64;
constexpr std::string_view header_start = "{'descr': '|u1', 'fortran_order': False, 'shape': (";

std::string header_of(glm::ivec3 size) {
    std::string header = fmt::format("{}{}, {}, {}), }}", header_start, size.z, size.y, size.x);
    const std::size_t used = prefix_bytes + header.size() + 1;
    header.append((alignment_bytes - used % alignment_bytes) % alignment_bytes, ' ');
    return header + '\n';
}

// Writes of(byte) for each byte.
void write_array(const std::filesystem::path& path, const Cells& cells, std::uint32_t (*of)(std::uint32_t)) {
    write_beside_and_rename(path, [&](const std::filesystem::path& temporary) {
        std::ofstream file(temporary, std::ios::binary);
        const std::string header = header_of(cells.size_vox());
        file.write(magic.data(), magic.size());
        file.put(static_cast<char>(header.size() & 255));
        file.put(static_cast<char>(header.size() >> 8));
        file.write(header.data(), static_cast<std::streamsize>(header.size()));
        // In pieces: a second copy of a world may not fit beside the first.
        std::vector<char> piece;
        constexpr std::size_t piece_bytes = std::size_t{1} << 20;
        for (std::size_t begin = 0; begin < cells.count(); begin += piece_bytes) {
            piece.resize(std::min(piece_bytes, cells.count() - begin));
            for (std::size_t i = 0; i < piece.size(); ++i)
                piece[i] = static_cast<char>(of(cells.bytes()[begin + i]));
            file.write(piece.data(), static_cast<std::streamsize>(piece.size()));
        }
        file.flush();
        if (!file) fail("{}: cannot write: {}", path.string(), std::strerror(errno));
    });
}

}  // namespace

void write_npy(const std::filesystem::path& path, const Cells& cells) {
    write_array(path, cells, material_of);
}

void write_amounts_npy(const std::filesystem::path& path, const Cells& cells) {
    write_array(path, cells, quanta_of);
}

Cells read_npy(const std::filesystem::path& path) {
    const std::string bytes = read_text_file(path);
    const auto refuse = [&path](std::string_view reason) {
        fail(
            "{}: not an array of cells: {}; needed: .npy 1.0, uint8, C order, shape (z, y, x), sides 1 to {}",
            path.string(), reason, world_side_max_vox);
    };
    if (bytes.size() < prefix_bytes || !bytes.starts_with(magic)) refuse("no .npy 1.0 header");
    const std::size_t length =
        static_cast<unsigned char>(bytes[8]) + std::size_t{256} * static_cast<unsigned char>(bytes[9]);
    if (bytes.size() < prefix_bytes + length) refuse("the header is cut short");
    const std::string_view header = std::string_view(bytes).substr(prefix_bytes, length);
    if (!header.starts_with(header_start)) refuse("the header names another type or order");
    std::string_view rest = header.substr(header_start.size());
    glm::ivec3 size(0);
    for (int axis = 2; axis >= 0; --axis) {
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), size[axis]);
        if (error != std::errc{} || size[axis] < 1 || size[axis] > world_side_max_vox)
            refuse("a side is not a whole number in range");
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
        const std::string_view separator = axis > 0 ? ", " : "), }";
        if (!rest.starts_with(separator)) refuse("the shape has not three sides");
        rest.remove_prefix(separator.size());
    }
    Cells cells(size);
    if (bytes.size() != prefix_bytes + length + cells.count())
        refuse(fmt::format("{} bytes of data where the shape needs {}", bytes.size() - prefix_bytes - length,
                           cells.count()));
    std::copy(bytes.end() - static_cast<std::ptrdiff_t>(cells.count()), bytes.end(), cells.bytes().begin());
    return cells;
}

}  // namespace tarn
