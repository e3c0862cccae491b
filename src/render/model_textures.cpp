#include "render/model_textures.h"

#include <algorithm>
#include <set>

#include "render/environment.h"
#include "render/stage_look.h"
#include "render/textures.h"
#include "shared/render_layout.h"

namespace clothsim {
namespace {

using Names = std::set<std::string, std::less<>>;

template <class Textures, class Load>
void loadMissing(Textures& textures, const Names& wanted, Load load) {
  for (const std::string& name : wanted)
    if (!textures.contains(name)) textures.emplace(name, load(name));
}

template <class Textures>
void keepOnly(Textures& textures, const Names& wanted) {
  std::erase_if(textures, [&](const auto& entry) { return !wanted.contains(entry.first); });
}

template <class Textures>
void bindNamed(const Textures& textures, const std::string& name, GLuint unit) {
  if (const auto found = textures.find(name); found != textures.end()) found->second.bind(unit);
}

}  // namespace

void ModelTextures::choose(std::span<const ShadingModel> models, const RenderSettings& settings,
                           glm::vec3 toKey) {
  Names ofWeaves, ofPrints, ofHeights;
  for (const ShadingModel& model : models) {
    if (model.textureUse == TextureUse::print) ofPrints.insert(model.texture);
    if (model.textureUse == TextureUse::heights) ofHeights.insert(model.texture);
    if (!model.weave.empty()) ofWeaves.insert(model.weave);
  }
  // The user's own files first: they are what can be wrong.
  loadMissing(prints_, ofPrints, loadPrint);
  loadMissing(heights_, ofHeights, loadHeights);
  loadMissing(weaves_, ofWeaves, loadWeave);
  const StageLook& stage = stageLook(settings.stage);
  if (!stage.groundPicture.empty() && groundName_ != stage.groundPicture) {
    ground_ = loadGround(std::string(stage.groundPicture));
    groundName_ = stage.groundPicture;
  }
  const bool seesEnvironment =
      std::any_of(models.begin(), models.end(), [](const auto& model) { return model.seesEnvironment; });
  // The generated sky where that is seen, or no stage has other surroundings.
  const bool isSky = settings.background == "sky" || !hasSurroundings(settings.stage);
  const std::string surroundings = isSky ? "sky" : settings.stage;
  const bool isNew = surroundings != surroundings_ || (!isSky && toKey != toKey_);
  const bool needsMap = seesEnvironment || settings.background == "sky";
  if (isNew || (needsMap && !sky_)) {
    const Environment environment = isSky ? Environment() : Environment(settings.stage, toKey);
    irradiance_ = environment.irradiance();
    if (isNew) sky_.reset();
    if (needsMap) sky_ = environment.makeCubeMap();
    surroundings_ = surroundings;
    toKey_ = toKey;
  }
  keepOnly(prints_, ofPrints);
  keepOnly(heights_, ofHeights);
  keepOnly(weaves_, ofWeaves);
}

void ModelTextures::bind(const ShadingModel& model) const {
  bindNamed(weaves_, model.weave, WEAVE_UNIT);
  bindNamed(model.textureUse == TextureUse::print ? prints_ : heights_, model.texture,
            model.textureUse == TextureUse::print ? PRINT_UNIT : HEIGHTS_UNIT);
  if (sky_) sky_->bind(ENVIRONMENT_UNIT);
  if (ground_) ground_->bind(GROUND_UNIT);
}

}  // namespace clothsim
