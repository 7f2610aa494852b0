#include "measure/picture_error.h"

#include "core/error.h"

namespace tarn {

namespace {

// The mean over the pixels of product(i) over the reference's squares.
template <typename Product>
double relative_mean(const Reference& reference, Product product) {
    const std::size_t n = reference.a.size();
    CHECK(n > 0 && reference.b.size() == n);
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) mean += (static_cast<double>(reference.a[i]) + reference.b[i]) / 2;
    mean /= static_cast<double>(n);
    // A black picture: errors count as they are.
    const double least = mean > 0 ? 0.01 * mean * mean : 1;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double r = (static_cast<double>(reference.a[i]) + reference.b[i]) / 2;
        sum += product(i) / (r * r + least);
    }
    return sum / static_cast<double>(n);
}

}  // namespace

Luminance luminance_of(const ImageRgb32f& image) {
    Luminance y(image.pixels.size() / 3);
    for (std::size_t i = 0; i < y.size(); ++i) {
        const float* rgb = &image.pixels[3 * i];
        y[i] = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
    }
    return y;
}

double error_of(const Luminance& x, const Reference& reference) {
    return bias_of(x, x, reference);
}

double bias_of(const Luminance& x, const Luminance& y, const Reference& reference) {
    CHECK(x.size() == reference.a.size() && y.size() == x.size());
    return relative_mean(reference, [&](std::size_t i) {
        const double a = reference.a[i];
        const double b = reference.b[i];
        return ((x[i] - a) * (y[i] - b) + (x[i] - b) * (y[i] - a)) / 2;
    });
}

double floor_of(const Reference& reference) {
    return relative_mean(reference, [&](std::size_t i) {
        const double d = static_cast<double>(reference.a[i]) - reference.b[i];
        return d * d / 4;
    });
}

}  // namespace tarn
