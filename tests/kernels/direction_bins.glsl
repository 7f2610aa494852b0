// Bins of directions: BIN_ROWS x BIN_COLUMNS on each side of the surface, and one for what falls in none. Over the
// square (x, y) in [0,1)^2 of a side: x = |cos|, or, where lobes are narrow, r^2 / (1 + r^2) with r = slope of the
// half vector / bin_alpha; y the azimuth / 2 pi. With slopes the last row is left out: it has no end.
// Needs tests/kernels/bsdf_case.glsl.
const int BIN_ROWS = 80;
const int BIN_COLUMNS = 160;
const int BIN_REST = 2 * BIN_ROWS * BIN_COLUMNS;

// The half vector of Walter et al. 2007, eq. 13 and 16, on the normal's side.
vec3 half_vector(vec3 w, vec3 wi) {
    vec3 h = wi.z > 0.0 ? w + wi : w + bin_eta * wi;
    return normalize(h.z < 0.0 ? -h : h);
}

int bin_of(vec3 w, vec3 wi) {
    vec3 v = wi;
    float x = abs(wi.z);
    if (by_slopes != 0) {
        v = half_vector(w, wi);
        float r2 = dot(v.xy, v.xy) / (v.z * v.z * bin_alpha * bin_alpha);
        x = r2 / (1.0 + r2);
    }
    float y = atan(v.y, v.x) / (2.0 * PI);
    int row = min(int(x * float(BIN_ROWS)), BIN_ROWS - 1);
    int column = min(int((y < 0.0 ? y + 1.0 : y) * float(BIN_COLUMNS)), BIN_COLUMNS - 1);
    if (by_slopes != 0 && row == BIN_ROWS - 1) return BIN_REST;
    return ((wi.z > 0.0 ? 0 : BIN_ROWS) + row) * BIN_COLUMNS + column;
}

// The direction of a point of the square, and the solid angle per area there; 0: no direction.
float direction_of(vec3 w, vec2 at, bool beyond, out vec3 wi) {
    float phi = 2.0 * PI * at.y;
    if (by_slopes == 0) {
        float r = sqrt(1.0 - at.x * at.x);
        wi = vec3(r * cos(phi), r * sin(phi), beyond ? -at.x : at.x);
        return 2.0 * PI;
    }
    float tan_h = bin_alpha * sqrt(at.x / (1.0 - at.x));
    vec3 h = normalize(vec3(tan_h * cos(phi), tan_h * sin(phi), 1.0));
    float c = dot(w, h);
    float wi_per_h = 4.0 * c;
    wi = 2.0 * c * h - w;
    if (beyond) {
        // bin_eta * cosine on the far side; no facet refracts at and below a root of 0.
        float t = sqrt(max(0.0, bin_eta * bin_eta - 1.0 + c * c));
        if (t == 0.0) return 0.0;
        wi = ((c - t) * h - w) / bin_eta;
        wi_per_h = (c - t) * (c - t) / (bin_eta * t);
    }
    if (c <= 0.0 || (beyond ? wi.z >= 0.0 : wi.z <= 0.0)) return 0.0;
    // d(slope area) = alpha^2 r dr dphi, d(solid angle of h) = h.z^3 d(slope area).
    float h_per_area = PI * bin_alpha * bin_alpha * h.z * h.z * h.z / ((1.0 - at.x) * (1.0 - at.x));
    return h_per_area * wi_per_h;
}
