#include "render/shading_models.h"

#include <algorithm>

#include "core/error.h"
#include "render/weaves.h"

namespace clothsim {
namespace {

constexpr double MOST_MATTE_GLOSS = 0.35;  // more shows highlights, which draft must not lose

}  // namespace

std::vector<std::string> shadingModelNames() { return {shadingModels.begin(), shadingModels.end()}; }

ShadingModel shadingModelOf(const RenderSettings& settings, bool thick) {
  const std::string& name = settings.shader;
  if (std::find(shadingModels.begin(), shadingModels.end(), name) == shadingModels.end()) {
    std::string known;
    for (const std::string& each : shadingModelNames()) known += (known.empty() ? "" : ", ") + each;
    throw SceneError("render.shader: there is no shading model \"" + name + "\"; there is: " + known);
  }
  ShadingModel model;
  model.name = name;
  const auto lookAt = [&](TextureUse use, const std::string& otherwise) {
    model.texture = settings.texture.empty() ? otherwise : settings.texture;
    model.textureUse = model.texture.empty() ? TextureUse::none : use;
  };
  if (name == "fabric") lookAt(TextureUse::print, "");
  if (name == "texture") lookAt(TextureUse::print, "tartan");
  if (name == "bump" || name == "displacement") lookAt(TextureUse::heights, "quilt");
  if (name == "fabric" && settings.weave != "none") model.weave = settings.weave;
  model.seesEnvironment = name == "mirror";
  model.measuresStrain = name == "strain";
  model.displaces = name == "displacement";
  model.blends = name == "wireframe";
  model.hasVertexLight = name == "fabric" && model.textureUse == TextureUse::none;
  model.isMatte = name == "fabric" && settings.gloss <= MOST_MATTE_GLOSS;
  model.isThick = thick && !model.displaces && !model.blends;  // lines have none, and reliefs their own
  if (thick && !model.weave.empty()) model.fuzz = std::max(settings.fuzz, weaveOf(model.weave).fuzz);

  if (name == "fabric" || name == "bump" || name == "displacement") model.defines.emplace_back("TANGENT", "");
  if (model.measuresStrain) model.defines.emplace_back("STRAIN", "");
  if (model.displaces) model.defines.emplace_back("DISPLACEMENT", "");
  if (model.isThick) model.defines.emplace_back("THICK", "");
  if (model.textureUse == TextureUse::print) model.defines.emplace_back("PRINT", "");
  if (!model.weave.empty()) model.defines.emplace_back("WOVEN", "");
  if (settings.stage == "window") model.defines.emplace_back("WINDOW", "");  // whose bars throw shadows
  return model;
}

}  // namespace clothsim
