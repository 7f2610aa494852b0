#include "passes/pick_pass.h"

#include "shared/bindings.h"

namespace tarn {

PickPass::PickPass(bool through_water)
    : program_(
          {.label = "pick",
           .compute = "pass/pick.comp",
           .vertex = {},
           .fragment = {},
           .defines = through_water
                          ? std::vector<std::pair<std::string, std::string>>{{"TRAVERSAL_THROUGH_WATER", "1"}}
                          : std::vector<std::pair<std::string, std::string>>{}}),
      result_("pick", sizeof(Result)) {}

PickPass::Result PickPass::record(const Inputs& inputs, gl::Timers& timers) const {
    {
        const auto scope = timers.scope("pick");
        inputs.cells.bind_image(IMAGE_CELLS, GL_READ_ONLY);
        result_.bind_storage(0);
        program_.set("ray_dir", inputs.dir);
        program_.dispatch({1, 1, 1});
    }
    Result result{};
    result_.download(std::span(&result, 1));
    return result;
}

}  // namespace tarn
