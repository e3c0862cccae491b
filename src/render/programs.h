// All programs of the renderer in one place, so that they can be made anew together while it runs.
#pragma once

#include <string>

#include "gl/program.h"
#include "render/shading_models.h"

namespace clothsim {

struct RenderPrograms {
  // From the files below the resource root as they are now. @throws SceneError for an unknown shading model,
  // OpenGlError, InputOutputError
  RenderPrograms(const std::string& shadingModel, int samples);

  gl::Program normals = gl::Program::makeCompute("render/normals.comp");
  gl::Program normalsWithCuts = gl::Program::makeCompute("render/normals.comp", {{"CUTS", ""}});

  gl::Program cloth;
  gl::Program sphere = gl::Program::makeRender("render/sphere.vert", "render/sphere.frag");
  gl::Program shape = gl::Program::makeRender("render/shape.vert", "render/sphere.frag");
  gl::Program plane = gl::Program::makeRender("render/plane.vert", "render/plane.frag");
  gl::Program resolve;

  gl::Program clothShadow = gl::Program::makeRender("render/cloth_shadow.vert", "render/depth_only.frag");
  gl::Program sphereShadow = gl::Program::makeRender("render/sphere_shadow.vert", "render/depth_only.frag");
  gl::Program shapeShadow = gl::Program::makeRender("render/shape_shadow.vert", "render/depth_only.frag");
  gl::Program blurFirstAxis =
      gl::Program::makeRender("render/fullscreen.vert", "render/floor_shadow.frag", {{"FIRST_AXIS", ""}});
  gl::Program blurSecondAxis = gl::Program::makeRender("render/fullscreen.vert", "render/floor_shadow.frag");
};

// Made when somebody first picks.
struct PickPrograms {
  gl::Program cloth = gl::Program::makeRender("render/pick_cloth.vert", "render/pick.frag");
  gl::Program sphere = gl::Program::makeRender("render/pick_sphere.vert", "render/pick.frag");
  gl::Program shape = gl::Program::makeRender("render/pick_shape.vert", "render/pick.frag");
  gl::Program plane = gl::Program::makeRender("render/pick_plane.vert", "render/pick.frag");
};

}  // namespace clothsim
