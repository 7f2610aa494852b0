#include "measure/references.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "core/error.h"
#include "core/files.h"

namespace tarn {

namespace {

// The file: this, `about` and the samples of each half, a line each; then float32 of both halves by frame.
constexpr const char* magic = "tarn references 1";

}  // namespace

References::References(std::filesystem::path file, std::string about, int frames, std::size_t pixels)
    : file_(std::move(file)), about_(std::move(about)) {
    std::replace(about_.begin(), about_.end(), '\n', ' ');
    frames_.resize(static_cast<std::size_t>(frames));
    for (Reference& reference : frames_) {
        reference.a.assign(pixels, 0);
        reference.b.assign(pixels, 0);
    }
    if (!file_.empty() && std::filesystem::exists(file_)) read();
}

void References::read() {
    const std::string bytes = read_text_file(file_);
    std::string_view rest = bytes;
    const auto line = [&] {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view text = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        return text;
    };
    if (line() != magic || line() != about_) return;
    const std::string_view count = line();
    int samples = 0;
    std::from_chars(count.data(), count.data() + count.size(), samples);
    const std::size_t half = frames_.front().a.size() * sizeof(float);
    if (samples < 1 || rest.size() != 2 * half * frames_.size()) return;
    for (Reference& reference : frames_) {
        reference.samples = samples;
        for (Luminance* y : {&reference.a, &reference.b}) {
            std::memcpy(y->data(), rest.data(), half);
            rest.remove_prefix(half);
        }
    }
}

double References::floor() const {
    double sum = 0;
    for (const Reference& reference : frames_) sum += floor_of(reference);
    return sum / static_cast<double>(frames_.size());
}

void References::add(int frame, bool second, const Luminance& mean, int samples) {
    Reference& reference = frames_[static_cast<std::size_t>(frame)];
    Luminance& half = second ? reference.b : reference.a;
    CHECK(mean.size() == half.size());
    const double share = static_cast<double>(samples) / (reference.samples + samples);
    for (std::size_t i = 0; i < half.size(); ++i)
        half[i] = static_cast<float>(half[i] + share * (static_cast<double>(mean[i]) - half[i]));
}

void References::added(int samples) {
    for (Reference& reference : frames_) reference.samples += samples;
    if (file_.empty()) return;
    std::string bytes = fmt::format("{}\n{}\n{}\n", magic, about_, this->samples());
    for (const Reference& reference : frames_)
        for (const Luminance* y : {&reference.a, &reference.b})
            bytes.append(reinterpret_cast<const char*>(y->data()), y->size() * sizeof(float));
    write_file(file_, std::string_view(bytes));
}

}  // namespace tarn
