// How far a picture is from a reference that is itself sampled: relMSE of the luminance without the
// reference's own noise, for it is two independent halves. Knows no GL.
#pragma once
#include <vector>

#include "core/image.h"

namespace tarn {

using Luminance = std::vector<float>;  // of each pixel, linear

Luminance luminance_of(const ImageRgb32f& image);

// Means of two independent halves of the samples.
struct Reference {
    Luminance a, b;
    int samples = 0;  // of each half, per pixel
};

// mean over the pixels of (x - a)(x - b) / (r^2 + 0.01 mean(r)^2), r the mean of a and b: its expectation is
// the relMSE against the true picture, for the errors of a and b are independent of each other and of x. May
// come out below 0 where x is as near to the truth as they are.
double error_of(const Luminance& x, const Reference& reference);

// The same of two independent pictures x, y made alike, multiplied with each other: their noise averages out,
// what both have in common (the bias squared) stays.
double bias_of(const Luminance& x, const Luminance& y, const Reference& reference);

// The relMSE of the reference (of the mean of both halves): a quarter of that between them.
double floor_of(const Reference& reference);

}  // namespace tarn
