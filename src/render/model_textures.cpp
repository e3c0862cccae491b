#include "render/model_textures.h"

#include "render/environment.h"
#include "render/textures.h"
#include "shared/render_layout.h"

namespace clothsim {

template <class Load>
void ModelTextures::replace(std::string& name, gl::Texture& texture, const std::string& wanted, Load load) {
  if (wanted.empty() || wanted == name) return;
  texture = load(wanted);
  name = wanted;
}

void ModelTextures::choose(const ShadingModel& model, const std::string& background) {
  // The user's own files first: they are what can be wrong.
  if (model.textureUse == TextureUse::print) replace(printName_, print_, model.texture, loadPrint);
  if (model.textureUse == TextureUse::heights) replace(heightsName_, heights_, model.texture, loadHeights);
  replace(weaveName_, weave_, model.weave, loadWeave);
  const bool needsMap = (model.seesEnvironment || background == "sky") && !sky_;
  if (knowsIrradiance_ && !needsMap) return;
  const Environment environment;
  irradiance_ = environment.irradiance();
  knowsIrradiance_ = true;
  if (needsMap) sky_ = environment.makeCubeMap();
}

void ModelTextures::bind() const {
  weave_.bind(WEAVE_UNIT);
  print_.bind(PRINT_UNIT);
  heights_.bind(HEIGHTS_UNIT);
  if (sky_) sky_->bind(ENVIRONMENT_UNIT);
}

}  // namespace clothsim
