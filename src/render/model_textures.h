// The textures that the looks of the cloths and the background look at, loaded when first chosen.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "gl/texture.h"
#include "render/shading_models.h"

namespace clothsim {

class ModelTextures {
 public:
  // What no model looks at any more is let go. @throws SceneError, InputOutputError, leaving what was there
  // @param toKey  the direction of the main light, from which the surroundings of some stages are lit
  void choose(std::span<const ShadingModel> models, const RenderSettings& settings, glm::vec3 toKey);
  // Those of a model that was chosen.
  void bind(const ShadingModel& model) const;
  // Of the stage's surroundings, as Environment::irradiance().
  [[nodiscard]] const std::array<glm::vec3, 9>& irradiance() const { return irradiance_; }

 private:
  // By their names.
  using Textures = std::map<std::string, gl::Texture, std::less<>>;
  Textures weaves_, prints_, heights_;
  std::optional<gl::Texture> sky_, ground_;
  std::string groundName_, surroundings_;  // those of which the irradiance is
  glm::vec3 toKey_{};
  std::array<glm::vec3, 9> irradiance_{};
};

}  // namespace clothsim
