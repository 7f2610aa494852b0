// A view of what the renderer knows besides radiance: false colours, or raw values. glsl/pass/view.frag.
#pragma once
#include "core/settings.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/timers.h"

namespace tarn {

class ViewPass {
  public:
    // Each view reads what it shows alone; null where there is no such texture.
    struct Inputs {
        const gl::Texture& surface;
        const gl::Texture* counts;
        const gl::Texture* history;     // alpha: frames kept; exact: the mean, alpha: frames lost
        const gl::Texture* moments;     // exact: the sums
        const gl::Texture* correction;  // exact: of the sums
    };
    struct Outputs {
        const gl::Framebuffer& picture;
    };

    // history: what keeps frames. raw: values; otherwise sRGB.
    ViewPass(ViewKind view, History history, bool raw);
    void record(const Inputs& inputs, const Outputs& outputs, gl::Timers& timers) const;
    gl::Program& program() { return program_; }

  private:
    gl::Program program_;
};

}  // namespace tarn
