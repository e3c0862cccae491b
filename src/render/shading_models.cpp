#include "render/shading_models.h"

#include <algorithm>

#include "core/error.h"

namespace clothsim {

std::vector<std::string> shadingModelNames() { return {"phong"}; }

gl::Program makeShadingModel(const std::string& name) {
  const std::vector<std::string> names = shadingModelNames();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    std::string known;
    for (const std::string& each : names) known += (known.empty() ? "" : ", ") + each;
    throw SceneError("render.shader: there is no shading model \"" + name + "\"; there is: " + known);
  }
  return gl::Program::makeRender("render/cloth.vert", "render/" + name + ".frag");
}

}  // namespace clothsim
