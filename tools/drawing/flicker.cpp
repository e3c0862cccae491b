// How much pictures of cloth at rest flicker while the camera goes slowly around it:
//   flicker settle FILE SCENE COLUMNSxROWS FRAMES       stores the particles after so many frames
//   flicker FILE SCENE COLUMNSxROWS QUALITY FRAMES TARGET EYE [KEY=VALUE...]
// TARGET and EYE are places, x,y,z. Of each two pictures, 0.2 degrees apart, those points of the cloth are
// compared that a camera between the two sees; both pictures are read between their pixels there, so that
// none is sharper than the other. Prints how many points a pair of pictures has, the mean difference of the
// channels in steps of 255, and which share of the points differ by more than 16. It also builds against
// older commits (tools/validate drawing).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/context.h"
#include "render/renderer.h"
#include "scene_io/scene_io.h"
#include "simulation/simulation.h"

using namespace clothsim;

namespace {

constexpr int WIDTH = 640, HEIGHT = 360,
              BORDER = 3;  // [pixels]; so far inside of what is seen as one surface
constexpr double STEP = 0.2 * 3.14159265358979 / 180, LARGE = 16;
constexpr double FLAT = 0.02;  // of the distance: neighbouring pixels of one surface differ by less

Scene sceneOf(const char* name, const std::string& size) {
  Scene scene = loadSceneByName(name);
  const std::size_t x = size.find('x');
  static_cast<void>(
      changeResolution(scene, std::stoi(size.substr(0, x)), std::stoi(size.substr(x + 1)), false));
  return scene;
}

int settle(char** words) {
  Simulation simulation(sceneOf(words[3], words[4]), "cpu");
  simulation.stepFrames(std::stoi(words[5]));
  const std::vector<Particle4> positions = simulation.state().positions;
  std::ofstream file(words[2], std::ios::binary);
  file.write(reinterpret_cast<const char*>(positions.data()),
             static_cast<std::streamsize>(positions.size() * sizeof(Particle4)));
  return file.good() ? 0 : 1;
}

std::vector<Particle4> positionsIn(const char* path, std::size_t count) {
  std::vector<Particle4> positions(count);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(positions.data()),
            static_cast<std::streamsize>(count * sizeof(Particle4)));
  if (!file) throw std::runtime_error(std::string(path) + " has not the particles of the scene");
  return positions;
}

glm::dvec3 placeOf(const std::string& text) {
  glm::dvec3 place;
  std::sscanf(text.c_str(), "%lf,%lf,%lf", &place.x, &place.y, &place.z);
  return place;
}

Camera cameraAt(Scene scene, const Cloth& cloth, glm::dvec3 target, glm::dvec3 eye, double frame) {
  const glm::dvec3 off = eye - target;
  const double c = std::cos(STEP * frame), s = std::sin(STEP * frame);
  scene.camera.position = Vec3d{target.x + c * off.x + s * off.z, eye.y, target.z - s * off.x + c * off.z};
  scene.camera.target = Vec3d{target.x, target.y, target.z};
  scene.camera.fov = 30;
  return Camera(scene, cloth);
}

// Where a point is in the picture [pixels], and its distance in z.
glm::dvec3 projected(const glm::dmat4& clipFromWorld, glm::dvec3 point) {
  const glm::dvec4 clip = clipFromWorld * glm::dvec4(point, 1);
  return {(0.5 + 0.5 * clip.x / clip.w) * WIDTH, (0.5 - 0.5 * clip.y / clip.w) * HEIGHT, clip.w};
}

glm::dmat4 clipOf(const Camera& camera) {
  return glm::dmat4(camera.projection(double(WIDTH) / HEIGHT) * camera.view());
}

struct Seen {
  double depth = INFINITY;
  glm::dvec3 point{0};
};

void fill(const std::array<glm::dvec3, 3>& world, const std::array<glm::dvec3, 3>& p,
          std::vector<Seen>& pixels) {
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  if (std::abs(area) < 1e-12) return;
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
  for (int y = std::max(0, int(top - 0.5)); y < std::min(HEIGHT, int(bottom + 1.5)); ++y)
    for (int x = std::max(0, int(left - 0.5)); x < std::min(WIDTH, int(right + 1.5)); ++x) {
      const double dx = x + 0.5 - p[0].x, dy = y + 0.5 - p[0].y;
      const double b = (dx * (p[2].y - p[0].y) - dy * (p[2].x - p[0].x)) / area,
                   c = ((p[1].x - p[0].x) * dy - (p[1].y - p[0].y) * dx) / area, a = 1 - b - c;
      if (a < 0 || b < 0 || c < 0) continue;
      const double depth = 1 / (a / p[0].z + b / p[1].z + c / p[2].z);
      Seen& pixel = pixels[std::size_t(y * WIDTH + x)];
      if (depth >= pixel.depth) continue;
      const glm::dvec3 point =
          depth * (a / p[0].z * world[0] + b / p[1].z * world[1] + c / p[2].z * world[2]);
      pixel = {depth, point};
    }
}

// Points of the triangles under the middles of pixels, of which all around see the same surface.
std::vector<glm::dvec3> pointsSeen(const Cloth& cloth, const std::vector<Particle4>& positions,
                                   const glm::dmat4& clipFromWorld) {
  std::vector<Seen> pixels(std::size_t(WIDTH * HEIGHT));
  for (const auto& corners : cloth.triangles()) {
    std::array<glm::dvec3, 3> world, p;
    for (std::size_t k = 0; k < 3; ++k) {
      const Particle4& particle = positions[corners[k]];
      world[k] = {particle.x, particle.y, particle.z};
      p[k] = projected(clipFromWorld, world[k]);
    }
    if (p[0].z > 0 && p[1].z > 0 && p[2].z > 0) fill(world, p, pixels);
  }
  std::vector<glm::dvec3> points;
  for (int y = BORDER; y + BORDER < HEIGHT; ++y)
    for (int x = BORDER; x + BORDER < WIDTH; ++x) {
      const Seen& here = pixels[std::size_t(y * WIDTH + x)];
      bool isInside = std::isfinite(here.depth);
      for (int j = -BORDER; j <= BORDER && isInside; ++j)
        for (int i = -BORDER; i <= BORDER; ++i)
          isInside = isInside && std::abs(pixels[std::size_t((y + j) * WIDTH + x + i)].depth - here.depth) <
                                     FLAT * here.depth * std::max({std::abs(i), std::abs(j), 1});
      if (isInside) points.push_back(here.point);
    }
  return points;
}

glm::dvec3 colorAt(const Image& image, glm::dvec3 place) {
  const double x = std::clamp(place.x - 0.5, 0.0, WIDTH - 1.001),
               y = std::clamp(place.y - 0.5, 0.0, HEIGHT - 1.001);
  const int column = int(x), row = int(y);
  const double u = x - column, v = y - row;
  const auto at = [&](int i, int j) {
    const std::size_t k = std::size_t(3 * ((row + j) * WIDTH + column + i));
    return glm::dvec3(image.rgb[k], image.rgb[k + 1], image.rgb[k + 2]);
  };
  return (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1));
}

struct Picture {
  Image image;
  glm::dmat4 clipFromWorld;
};

int measure(char** words, int count) {
  Scene scene = sceneOf(words[2], words[3]);
  for (int i = 8; i < count; ++i) setSceneValue(scene, words[i]);
  const Cloth cloth(scene);
  const std::vector<Particle4> positions = positionsIn(words[1], cloth.particleCount());
  const int frames = std::stoi(words[5]);
  const glm::dvec3 target = placeOf(words[6]), eye = placeOf(words[7]);
  const gl::HeadlessContext context;
  const gl::Buffer<Particle4> buffer("positions", positions);
  const Quality quality = qualityNamed(words[4]).value();
  RenderOptions options = withQuality({}, quality, gl::currentContextInfo().software);
#if __has_include("render/exposure.h")
  const int exposures = quality == Quality::final ? FINAL_EXPOSURES : 1;
  options = forExposures(options, exposures);
#endif
  Renderer renderer(cloth, scene, options);
  const auto pictureAt = [&](int frame) {
    const Camera camera = cameraAt(scene, cloth, target, eye, frame);
#if __has_include("render/exposure.h")
    return Picture{renderImage(renderer, buffer.name(), camera, 0, WIDTH, HEIGHT, exposures), clipOf(camera)};
#else
    return Picture{renderImage(renderer, buffer.name(), camera, 0, WIDTH, HEIGHT), clipOf(camera)};
#endif
  };
  double sum = 0, large = 0, points = 0;
  Picture before = pictureAt(0);
  for (int frame = 1; frame < frames; ++frame) {
    const Picture after = pictureAt(frame);
    const Camera between = cameraAt(scene, cloth, target, eye, frame - 0.5);
    for (const glm::dvec3& point : pointsSeen(cloth, positions, clipOf(between))) {
      const glm::dvec3 step = glm::abs(colorAt(before.image, projected(before.clipFromWorld, point)) -
                                       colorAt(after.image, projected(after.clipFromWorld, point)));
      const double mean = (step.x + step.y + step.z) / 3;
      sum += mean;
      large += mean > LARGE ? 1 : 0;
      points += 1;
    }
    before = after;
  }
  if (const char* file = std::getenv("FLICKER_PICTURE")) {
    std::ofstream out(file, std::ios::binary);
    out << "P6 " << WIDTH << " " << HEIGHT << " 255\n";
    out.write(reinterpret_cast<const char*>(before.image.rgb.data()),
              std::streamsize(before.image.rgb.size()));
  }
  std::printf("%.0f %.3f %.5f\n", points / (frames - 1), sum / points, large / points);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  if (count < 6) {
    std::fprintf(stderr, "usage: see the beginning of tools/drawing/flicker.cpp\n");
    return 2;
  }
  try {
    return std::string(words[1]) == "settle" ? settle(words) : measure(words, count);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "flicker: %s\n", error.what());
    return 1;
  }
}
