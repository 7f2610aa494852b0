// Lines of bricks that pass/brick_rooms.comp is to look at: between which of their bricks a count of the axis before
// changed, for each medium and way, and the highest level that did. All is zero where nothing is to be done; who looks
// at a line sets it to zero. src/passes/bricks.h owns the buffer.
#include "shared/bindings.h"
#include "shared/rooms.h"

// Of the lines along y (x fastest), then along x (y fastest), then along z (x fastest). The first word of a line: a bit
// for each medium and way that changed; then three for each of them, all the higher the wider:
// ROOM_LINE_END - first brick, last brick + 1, highest level + 1.
layout(std430, binding = STORAGE_ROOM_LINES) coherent buffer RoomLines { uint room_lines[]; };

const int ROOM_LINE_END = 0x10000;

// Of the line along `axis` through `brick`: where it begins.
int room_line_at(int axis, ivec3 brick, ivec3 size) {
    int words_y = room_line_words(1) * size.x * size.z;
    int words_x = room_line_words(0) * size.y * size.z;
    return axis == 1   ? room_line_words(1) * (brick.x + size.x * brick.z)
           : axis == 0 ? words_y + room_line_words(0) * (brick.y + size.y * brick.z)
                       : words_y + words_x + room_line_words(2) * (brick.x + size.x * brick.y);
}

// Which of its bits.
int room_line_part(int axis, int medium, int way) { return medium * room_line_ways(axis) + way; }

void mark_room_line(int axis, ivec3 brick, ivec3 size, int medium, int way, int level) {
    int line = room_line_at(axis, brick, size);
    int part = room_line_part(axis, medium, way);
    int range = line + 1 + 3 * part;
    atomicOr(room_lines[line], 1u << part);
    atomicMax(room_lines[range], uint(ROOM_LINE_END - brick[axis]));
    atomicMax(room_lines[range + 1], uint(brick[axis] + 1));
    atomicMax(room_lines[range + 2], uint(level + 1));
}
