// The head of confined water: height of the free surface that feeds a cell in quarter voxels, then how many steps of
// the way from there are left, then whether the way is open to the sky. 0: none. Greater wins.
const uint HEAD_OPEN = 1u;
const uint HEAD_STEP = 2u;
const uint HEAD_REACH = 2046u;
const int HEAD_HEIGHT_SHIFT = 11;
const int HEAD_PER_VOXEL = 4;

int height_of(uint head) { return int(head >> HEAD_HEIGHT_SHIFT); }
// Whether water under that head has passed a ceiling: only then does it press.
bool is_confined(uint head) { return head != 0u && (head & HEAD_OPEN) == 0u; }
// Whether the head of a cell in layer y stands more than a voxel above it.
bool is_pressed(uint head, int y) { return is_confined(head) && height_of(head) >= (y + 2) * HEAD_PER_VOXEL; }
// Height in quarter voxels of the water in a cell of layer y.
int surface_quarters(int y, int content) { return y * HEAD_PER_VOXEL + content * HEAD_PER_VOXEL / FULL; }
