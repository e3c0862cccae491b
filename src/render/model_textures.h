// The textures that the chosen shading model and background look at, loaded when first chosen.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "gl/texture.h"
#include "render/shading_models.h"

namespace clothsim {

class ModelTextures {
 public:
  // @throws SceneError, InputOutputError, leaving what was there
  void choose(const ShadingModel& model, const std::string& background);
  void bind() const;
  // Of the sky, as Environment::irradiance().
  [[nodiscard]] const std::array<glm::vec3, 9>& irradiance() const { return irradiance_; }

 private:
  template <class Load>
  static void replace(std::string& name, gl::Texture& texture, const std::string& wanted, Load load);

  std::string weaveName_, printName_, heightsName_;
  gl::Texture weave_, print_, heights_;
  std::optional<gl::Texture> sky_;
  bool knowsIrradiance_ = false;
  std::array<glm::vec3, 9> irradiance_{};
};

}  // namespace clothsim
