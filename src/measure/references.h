// The reference pictures of a recording, each of two independent halves, and their file: sampled once,
// sampled further when asked, read again by later runs.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "measure/picture_error.h"

namespace tarn {

class References {
  public:
    // `about`: all that the pictures follow from but the number of samples; a file about anything else is
    // ignored. No file is kept where `file` is empty.
    References(std::filesystem::path file, std::string about, int frames, std::size_t pixels);

    int frames() const { return static_cast<int>(frames_.size()); }
    const Reference& at(int frame) const { return frames_[static_cast<std::size_t>(frame)]; }
    int samples() const { return frames_.front().samples; }  // of each half
    double floor() const;                                    // mean over the frames

    // Adds the mean of `samples` more to a half of a frame; both halves of all frames get as many.
    void add(int frame, bool second, const Luminance& mean, int samples);
    // Counts them and writes the file.
    void added(int samples);

  private:
    void read();
    std::filesystem::path file_;
    std::string about_;
    std::vector<Reference> frames_;
};

}  // namespace tarn
