#include "render/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/files.h"
#include "core/srgb.h"

namespace clothsim {
namespace {

constexpr float brightest = 2;  // the light that the picture's white stands for
constexpr int cubeSize = 256;   // pixels along each side of a face

float linear(std::uint16_t stored) { return static_cast<float>(linearOfSrgb(stored / 65535.0)); }

// The direction of a place on a cube's face, both -1 to 1, x to the right and y down (OpenGL 4.5,
// table 8.19).
glm::vec3 cubeDirection(int face, float x, float y) {
  switch (face) {
    case 0:
      return {1, -y, -x};
    case 1:
      return {-1, -y, x};
    case 2:
      return {x, 1, y};
    case 3:
      return {x, -1, -y};
    case 4:
      return {x, -y, 1};
    default:
      return {-x, -y, -1};
  }
}

// The real spherical harmonics up to the second degree, in the order of irradiance().
std::array<float, 9> harmonics(glm::vec3 d) {
  return {0.282095f,
          0.488603f * d.x,
          0.488603f * d.y,
          0.488603f * d.z,
          1.092548f * d.x * d.y,
          1.092548f * d.y * d.z,
          1.092548f * d.z * d.x,
          0.315392f * (3 * d.z * d.z - 1),
          0.546274f * (d.x * d.x - d.y * d.y)};
}

// Of a room or a stage: soft light from above, from the walls and from the ground, and a bright area of so
// many degrees to each side where the main light comes from.
struct Surroundings {
  std::string_view stage;
  glm::vec3 ceiling, wall, ground, lamp;
  float lampAngle;

  [[nodiscard]] glm::vec3 lightFrom(glm::vec3 direction, glm::vec3 toKey) const {
    const glm::vec3 above = glm::mix(wall, ceiling, glm::smoothstep(0.1f, 0.8f, direction.y));
    const glm::vec3 base = glm::mix(ground, above, glm::smoothstep(-0.25f, 0.05f, direction.y));
    const float edge = std::cos(glm::radians(lampAngle)), inner = std::cos(glm::radians(0.6f * lampAngle));
    return base + glm::smoothstep(edge, inner, glm::dot(direction, toKey)) * lamp;
  }
};

const Surroundings* surroundingsOf(std::string_view stage) {
  static constexpr std::array<Surroundings, 3> known{{
      {"table", {0.50f, 0.46f, 0.42f}, {0.26f, 0.22f, 0.18f}, {0.16f, 0.10f, 0.06f}, {1.2f, 1.1f, 0.95f}, 34},
      {"window",
       {0.26f, 0.26f, 0.26f},
       {0.30f, 0.28f, 0.26f},
       {0.24f, 0.17f, 0.10f},
       {1.6f, 1.7f, 1.85f},
       42},
      {"dark",
       {0.03f, 0.03f, 0.035f},
       {0.02f, 0.02f, 0.025f},
       {0.05f, 0.04f, 0.03f},
       {1.8f, 1.65f, 1.4f},
       18},
  }};
  for (const Surroundings& each : known)
    if (each.stage == stage) return &each;
  return nullptr;
}

// The middle of a pixel of an equirectangular picture.
glm::vec3 directionAt(int row, int column, int width, int height) {
  const float pi = std::numbers::pi_v<float>;
  const float polar = pi * (static_cast<float>(row) + 0.5f) / static_cast<float>(height);
  const float azimuth = 2 * pi * ((static_cast<float>(column) + 0.5f) / static_cast<float>(width) - 0.5f);
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth)};
}

}  // namespace

Environment::Environment() {
  const LoadedPng picture = loadPng(resourceRoot() / "assets" / "textures" / "sky.png");
  width_ = picture.width;
  height_ = picture.height;
  light_.reserve(picture.rgba.size() / 4);
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    light_.push_back(brightest * glm::vec3(linear(picture.rgba[i]), linear(picture.rgba[i + 1]),
                                           linear(picture.rgba[i + 2])));
}

Environment::Environment(std::string_view stage, glm::vec3 toKey) : width_(128), height_(64) {
  const Surroundings& around = *surroundingsOf(stage);
  light_.reserve(static_cast<std::size_t>(width_ * height_));
  for (int row = 0; row < height_; ++row)
    for (int column = 0; column < width_; ++column)
      light_.push_back(around.lightFrom(directionAt(row, column, width_, height_), toKey));
}

bool hasSurroundings(std::string_view stage) { return surroundingsOf(stage) != nullptr; }

glm::vec3 Environment::lightFrom(glm::vec3 direction) const {
  const float pi = std::numbers::pi_v<float>;
  const auto width = static_cast<float>(width_), height = static_cast<float>(height_);
  const float x = (std::atan2(direction.x, direction.z) / (2 * pi) + 0.5f) * width - 0.5f;
  const float y = std::acos(std::clamp(direction.y, -1.0f, 1.0f)) / pi * height - 0.5f;
  const auto at = [&](int column, int row) {
    column = (column + width_) % width_;
    row = std::clamp(row, 0, height_ - 1);
    return light_[static_cast<std::size_t>(row * width_ + column)];
  };
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const float right = x - std::floor(x), down = y - std::floor(y);
  return glm::mix(glm::mix(at(column, row), at(column + 1, row), right),
                  glm::mix(at(column, row + 1), at(column + 1, row + 1), right), down);
}

std::array<glm::vec3, 9> Environment::irradiance() const {
  const float pi = std::numbers::pi_v<float>;
  std::array<glm::vec3, 9> sums{};
  const auto width = static_cast<float>(width_), height = static_cast<float>(height_);
  for (int row = 0; row < height_; ++row) {
    const float polar = pi * (static_cast<float>(row) + 0.5f) / height;
    const float solidAngle = 2 * pi * pi / (width * height) * std::sin(polar);
    for (int column = 0; column < width_; ++column) {
      const glm::vec3 direction = directionAt(row, column, width_, height_);
      const std::array<float, 9> basis = harmonics(direction);
      const glm::vec3 light = solidAngle * light_[static_cast<std::size_t>(row * width_ + column)];
      for (std::size_t i = 0; i < 9; ++i) sums[i] += basis[i] * light;
    }
  }
  // Clamped cosine over pi, by degree; then the polynomial's terms instead of the harmonics.
  constexpr float degree0 = 1, degree1 = 2.0f / 3, degree2 = 0.25f;
  std::array<glm::vec3, 9> terms{};
  const std::array<float, 9> factors{0.282095f * degree0, 0.488603f * degree1, 0.488603f * degree1,
                                     0.488603f * degree1, 1.092548f * degree2, 1.092548f * degree2,
                                     1.092548f * degree2, 0.315392f * degree2, 0.546274f * degree2};
  for (std::size_t i = 0; i < 9; ++i) terms[i] = factors[i] * sums[i];
  terms[0] -= terms[7];
  terms[7] *= 3.0f;
  return terms;
}

gl::Texture Environment::makeCubeMap() const {
  std::array<std::vector<std::array<std::uint8_t, 4>>, 6> faces;
  std::array<const void*, 6> pointers{};
  for (int face = 0; face < 6; ++face) {
    auto& pixels = faces[static_cast<std::size_t>(face)];
    for (int y = 0; y < cubeSize; ++y) {
      for (int x = 0; x < cubeSize; ++x) {
        const auto place = [](int i) { return 2 * (static_cast<float>(i) + 0.5f) / cubeSize - 1; };
        const glm::vec3 light = lightFrom(glm::normalize(cubeDirection(face, place(x), place(y))));
        // Square roots, as on the canvas: 8 bits are enough then.
        const glm::vec3 root = 255.0f * glm::sqrt(glm::clamp(light / brightest, 0.0f, 1.0f)) + 0.5f;
        pixels.push_back({static_cast<std::uint8_t>(root.x), static_cast<std::uint8_t>(root.y),
                          static_cast<std::uint8_t>(root.z), 255});
      }
    }
    pointers[static_cast<std::size_t>(face)] = pixels.data();
  }
  return gl::Texture::makeCube("sky", cubeSize, {}, pointers);
}

}  // namespace clothsim
