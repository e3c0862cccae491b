#include "render/programs.h"

namespace clothsim {

RenderPrograms::RenderPrograms(const std::string& shadingModel, int samples)
    : cloth(makeShadingModel(shadingModel)),
      resolve(gl::Program::makeRender("render/fullscreen.vert", "render/resolve.frag",
                                      {{"SAMPLES", std::to_string(samples)}})) {}

}  // namespace clothsim
