#include "render/textures.h"

#include <stb/stb_image.h>

#include <algorithm>
#include <memory>

#include "core/error.h"
#include "core/files.h"
#include "core/nearest.h"
#include "scene/scene.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largestFile = 256 * 1024 * 1024;
constexpr int longestSide = 16384;              // pixels; what every driver takes
constexpr std::int64_t mostPixels = 1LL << 26;  // a file of some bytes can claim any number; 8 bytes each

fs::path folder() { return resourceRoot() / "assets" / "textures"; }

std::vector<std::uint8_t> eightBits(const LoadedPng& png) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(png.rgba.size());
  for (const std::uint16_t value : png.rgba) bytes.push_back(static_cast<std::uint8_t>((value + 128) / 257));
  return bytes;
}

float luminance(const std::uint16_t* rgba) {
  return (0.2126f * rgba[0] + 0.7152f * rgba[1] + 0.0722f * rgba[2]) / 65535.0f;
}

}  // namespace

LoadedPng loadPng(const fs::path& path) {
  const std::string bytes = readFile(path, largestFile);
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  LoadedPng png;
  int channels = 0;
  if (stbi_info_from_memory(data, size, &png.width, &png.height, &channels) != 0 &&
      (std::max(png.width, png.height) > longestSide ||
       static_cast<std::int64_t>(png.width) * png.height > mostPixels))
    throw InputOutputError(path.string() + ": has " + std::to_string(png.width) + " x " +
                           std::to_string(png.height) + " pixels, more than " + std::to_string(longestSide) +
                           " along a side or " + std::to_string(mostPixels) + " in all");
  const std::unique_ptr<stbi_us, decltype(&stbi_image_free)> pixels(
      stbi_load_16_from_memory(data, size, &png.width, &png.height, &channels, 4), stbi_image_free);
  if (!pixels)
    throw InputOutputError(path.string() + ": cannot be read as a PNG picture: " + stbi_failure_reason());
  const std::size_t count = 4 * static_cast<std::size_t>(png.width) * static_cast<std::size_t>(png.height);
  png.rgba.assign(pixels.get(), pixels.get() + count);
  return png;
}

std::vector<std::string> bundledTextures() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (fs::directory_iterator entry(folder(), ignored), end; entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().stem().string();
    if (entry->path().extension() == ".png" && !name.starts_with("weave_") && !name.starts_with("ground_") &&
        name != "sky")
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path texturePath(const std::string& texture) {
  if (isTexturePath(texture)) return texture;
  const std::vector<std::string> names = bundledTextures();
  if (std::find(names.begin(), names.end(), texture) != names.end()) return folder() / (texture + ".png");
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  throw SceneError("render.texture: no bundled texture is called \"" + texture + "\"" +
                   didYouMean(texture, names) + "; there is: " + list +
                   "; a PNG of your own is given by its path, such as ./" + texture + ".png");
}

gl::Texture loadPrint(const std::string& texture) {
  const LoadedPng png = loadPng(texturePath(texture));
  return gl::Texture::make2D("print " + texture, png.width, png.height, {.internal = GL_SRGB8_ALPHA8},
                             eightBits(png).data());
}

gl::Texture loadHeights(const std::string& texture) {
  const LoadedPng png = loadPng(texturePath(texture));
  const int width = png.width, height = png.height;
  const auto at = [&](int x, int y) {
    const int column = (x + width) % width, row = (y + height) % height;
    return luminance(&png.rgba[4 * static_cast<std::size_t>(row * width + column)]);
  };
  std::vector<std::array<float, 4>> pixels;
  pixels.reserve(png.rgba.size() / 4);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float alongU = 0.5f * (at(x + 1, y) - at(x - 1, y)) * static_cast<float>(width);
      const float alongV = 0.5f * (at(x, y + 1) - at(x, y - 1)) * static_cast<float>(height);
      pixels.push_back({at(x, y), alongU, alongV, 1});
    }
  }
  return gl::Texture::make2D("heights " + texture, width, height,
                             {.internal = GL_RGBA16F, .given = GL_RGBA, .type = GL_FLOAT}, pixels.data());
}

gl::Texture loadPicture(const fs::path& path) {
  const LoadedPng png = loadPng(path);
  return gl::Texture::make2D(path.stem().string(), png.width, png.height, {}, eightBits(png).data());
}

gl::Texture loadGround(const std::string& name) {
  const LoadedPng png = loadPng(folder() / (name + ".png"));
  return gl::Texture::make2D(name, png.width, png.height, {.internal = GL_SRGB8_ALPHA8},
                             eightBits(png).data());
}

gl::Texture loadWeave(const std::string& weave) {
  return loadPicture(folder() / ("weave_" + weave + ".png"));
}

}  // namespace clothsim
