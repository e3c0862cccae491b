// Pictures that shading models look at, from PNG files: bundled ones by name, others by path.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "gl/texture.h"

namespace clothsim {

struct LoadedPng {
  int width = 0, height = 0;
  std::vector<std::uint16_t> rgba;  // 4 * width * height, 0 to 65535, top row first
};
// @throws InputOutputError naming the file
[[nodiscard]] LoadedPng loadPng(const std::filesystem::path& path);

// Prints and height maps that come with the program; made by tools/make_textures.
[[nodiscard]] std::vector<std::string> bundledTextures();

// @throws SceneError for a name that is not bundled, listing those that are
[[nodiscard]] std::filesystem::path texturePath(const std::string& texture);

// All @throws SceneError, InputOutputError, OpenGlError.
[[nodiscard]] gl::Texture loadPrint(const std::string& texture);  // sRGB in the file, linear when sampled
// Heights 0 to 1 in r, their change along u and v, for one repeat, in g and b.
[[nodiscard]] gl::Texture loadHeights(const std::string& texture);
// As it is in the file, for controls.
[[nodiscard]] gl::Texture loadPicture(const std::filesystem::path& path);
// The picture of a stage's ground, by its name in assets/textures; linear light when sampled.
[[nodiscard]] gl::Texture loadGround(const std::string& name);
[[nodiscard]] gl::Texture loadWeave(const std::string& weave);  // as tools/make_textures describes it

}  // namespace clothsim
