// The ways to shade cloth, by the name that scenes and --shader use: each is one fragment shader in
// shaders/render/.
#pragma once

#include <string>
#include <vector>

#include "gl/program.h"
#include "gl/texture.h"
#include "scene/scene.h"

namespace clothsim {

[[nodiscard]] std::vector<std::string> shadingModelNames();

// What a model looks at, apart from the surface.
enum class TextureUse { none, print, heights };

struct ShadingModel {
  std::string name;
  TextureUse textureUse = TextureUse::none;
  std::string texture;           // what it looks at; "" when it does not
  std::string weave;             // the same for weaves
  bool seesEnvironment = false;  // the sky, as a cube map
  bool measuresStrain = false;   // of the cloth, particle by particle
  bool displaces = false;        // its surface is not where the particles are
  bool isThick = false;          // the cloth is drawn as thick as it is
  bool hasVertexLight = false;   // can be worked out at vertices, but for what pixels tell apart
  bool isMatte = false;          // its shine may be left out of a draft
  double fuzz = 0;               // how far fibres stand off the cloth that are drawn over it [m]
  bool blends = false;           // drawn last, without hiding what is behind it
  gl::Defines defines;           // of cloth.vert and its own shader
  friend bool operator==(const ShadingModel&, const ShadingModel&) = default;
};
// `thick`: with the cloth's thickness and fuzz, where the model has them. @throws SceneError for a name that
// does not exist, listing those that do
[[nodiscard]] ShadingModel shadingModelOf(const RenderSettings& settings, bool thick = false);

}  // namespace clothsim
