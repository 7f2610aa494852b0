#include "reference/exact_traversal.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tarn::reference {

namespace {

struct Pair {
    double high, low;  // high + low is exact, high the rounded value
};

// Knuth 1969: a + b without error.
Pair two_sum(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;
    return {sum, (a - (sum - b_part)) + (b - b_part)};
}

Pair two_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

// Sign of a sum of doubles without error: an expansion whose parts do not overlap (Shewchuk 1997), so that
// the largest that is not zero has the sign of the sum.
class ExactSum {
  public:
    void add(double term) {
        for (std::size_t i = 0; i < count_; ++i) {
            const Pair sum = two_sum(term, parts_[i]);
            parts_[i] = sum.low;
            term = sum.high;
        }
        parts_[count_++] = term;
    }
    void add(Pair pair) {
        add(pair.low);
        add(pair.high);
    }
    int sign() const {
        for (std::size_t i = count_; i-- > 0;)
            if (parts_[i] != 0) return parts_[i] > 0 ? 1 : -1;
        return 0;
    }

  private:
    std::array<double, 8> parts_{};
    std::size_t count_ = 0;
};

// The time at which a ray passes a plane, (plane - origin) / dir, as a fraction over |dir|; never, if dir is
// 0. The numerator, a difference of two doubles, is a Pair without error. All values are multiples of 2^-149,
// the least float, so that the products below are multiples of 2^-298: nothing underflows and two_product is
// exact.
class Time {
  public:
    Time(double plane, float origin, float dir)
        : numerator_(two_sum(dir < 0 ? -plane : plane, dir < 0 ? double{origin} : -double{origin})),
          dir_(std::abs(double{dir})) {}

    bool never() const { return dir_ == 0; }
    double rounded() const { return numerator_.high / dir_; }

    // Sign of this - other.
    int compare(const Time& other) const {
        if (never() || other.never()) return static_cast<int>(never()) - static_cast<int>(other.never());
        // Both quotients are within 2^-52 of their values, relatively; farther apart there is no doubt.
        const double a = rounded();
        const double b = other.rounded();
        const double doubt = (std::abs(a) + std::abs(b)) * 0x1p-50;
        if (a - b > doubt) return 1;
        if (b - a > doubt) return -1;
        ExactSum sum;
        sum.add(two_product(numerator_.low, other.dir_));
        sum.add(two_product(numerator_.high, other.dir_));
        sum.add(two_product(-other.numerator_.low, dir_));
        sum.add(two_product(-other.numerator_.high, dir_));
        return sum.sign();
    }

  private:
    Pair numerator_;
    double dir_;
};

}  // namespace

RayHit trace_ray_exact(const Cells& cells, const RayStart& start, glm::vec3 dir) {
    const glm::ivec3 size = cells.size_vox();
    const int bound = size.x + size.y + size.z + 4;
    const auto time_of = [&](int axis, double plane) {
        return Time(plane, start.origin_vox[axis], dir[axis]);
    };
    const auto height_of = [](glm::ivec3 cell, std::uint32_t byte) {
        return cell.y + quanta_of(byte) / 16.0;
    };

    glm::ivec3 cell = start.cell;
    for (int i = 0; i < bound; ++i) {
        int axis = 0;
        Time exit = time_of(0, cell.x + (dir.x > 0 ? 1 : 0));
        for (int k = 1; k < 3; ++k) {
            const Time time = time_of(k, cell[k] + (dir[k] > 0 ? 1 : 0));
            if (time.compare(exit) < 0) {
                axis = k;
                exit = time;
            }
        }

        const std::uint32_t here = cells.get(cell, MATERIAL_AIR);
        if (is_partly_filled(here) && dir.y != 0 && (dir.y > 0) == (start.medium == MATERIAL_WATER)) {
            const Time surface = time_of(1, height_of(cell, here));
            if (surface.compare(exit) <= 0) {
                return {.kind = HitKind::Surface,
                        .t = static_cast<float>(std::max(surface.rounded(), 0.0)),
                        .previous = cell,
                        .cell = cell,
                        .axis = 1,
                        .beyond = start.medium == MATERIAL_WATER ? MATERIAL_AIR : MATERIAL_WATER,
                        .byte_beyond = here};
            }
        }

        const glm::ivec3 previous = cell;
        cell[axis] += dir[axis] > 0 ? 1 : -1;
        const std::uint32_t next = cells.get(cell, MATERIAL_AIR);
        std::uint32_t beyond = material_of(next);
        if (is_partly_filled(next)) {
            const double height = height_of(cell, next);
            const bool below = dir.y == 0 ? start.origin_vox.y < height
                                          : (exit.compare(time_of(1, height)) < 0) == (dir.y > 0);
            beyond = below ? MATERIAL_WATER : MATERIAL_AIR;
        }
        if (beyond != start.medium) {
            return {.kind = HitKind::Face,
                    .t = static_cast<float>(std::max(exit.rounded(), 0.0)),
                    .previous = previous,
                    .cell = cell,
                    .axis = axis,
                    .beyond = beyond,
                    .byte_beyond = next};
        }
        if (!cells.contains(cell)) break;
    }
    return {.t = traversal_t_max, .previous = start.cell, .cell = start.cell};
}

}  // namespace tarn::reference
