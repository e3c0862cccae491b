// Draws the cloth from the particle buffer in which it is simulated, with its colliders, a floor and a
// background.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cloth/cloth.h"
#include "core/shared.h"
#include "gl/api.h"
#include "render/camera.h"
#include "render/image.h"
#include "render/picking.h"
#include "render/quality.h"
#include "render/springs_overlay.h"
#include "render/strain_scale.h"
#include "scene/pose.h"

namespace clothsim {

struct DrawTime {
  std::string pass;
  double seconds;
};

class Renderer {
 public:
  // Builds what does not move: indices, texture coordinates, sphere mesh, programs. @throws OpenGlError
  Renderer(const Shared<Cloth>& cloth, const Shared<Scene>& scene, const RenderOptions& options);
  ~Renderer();

  // `positions` is a buffer of one vec4 a particle. `time` [s] places moving colliders. Draws into the
  // framebuffer `target` (0: the window) of `width` x `height` pixels. Neither reads back nor uploads
  // positions.
  void draw(GLuint positions, const Camera& camera, double time, GLuint target, int width, int height);
  // The same for a software renderer, into a framebuffer whose top row comes first. Where it still holds the
  // last picture, only what has changed is written.
  void drawOver(GLuint positions, const Camera& camera, double time, const gl::Framebuffer& target);

  // Exposure `number` of `count` (render/exposure.h), of the same state, camera and size as those before it;
  // 0 begins a new mean. Shows the mean of those so far in `target`.
  void expose(int number, int count, GLuint positions, const Camera& camera, double time, GLuint target,
              int width, int height);
  // The velocities of the state that is exposed next, a vec4 a particle [m/s], for camera.shutter; 0: of
  // none.
  void setVelocities(GLuint velocities);
  // The mean of the exposures so far once more.
  void showMean(GLuint target, int width, int height);

  // draw(), with the time that each pass of it takes; waits for each.
  std::vector<DrawTime> timeDraw(GLuint positions, const Camera& camera, double time, GLuint target,
                                 int width, int height);

  // Colours, colliders, camera-independent looks from an edited scene with the same grids.
  void configure(const Shared<Scene>& scene);
  void setView(const ViewOptions& view);
  // Samples, shadows and what is kept between pictures, from now on. The segments of spheres stay. @throws as
  // the constructor
  void setOptions(const RenderOptions& options);
  // The scene is drawn in so many times width and height pixels, > 0 to 1, and stretched.
  void setScale(double scale);
  // Cut cloth: its drawn triangles, their normals and their shadow. Empty: whole again.
  void setCuts(const Cuts& cuts);

  // What lies under a place of the picture that draw() would make; x, y in pixels from the top left. Reads
  // one pixel back, and waits for it.
  [[nodiscard]] Pick pick(GLuint positions, const Camera& camera, double time, int width, int height,
                          double x, double y);

  // Of the last picture drawn with a model that measures it (the strain map): the largest l/L - 1 of the cell
  // sides and diagonals at a particle. Reads one value back.
  [[nodiscard]] double strainAt(std::uint32_t particle) const;

  // Compiles every shader anew from the files as they are now. Returns what is wrong, with file and line, and
  // goes on with the programs it had; none when all is well.
  [[nodiscard]] std::optional<std::string> reloadShaders();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Draws into an off-screen framebuffer and reads the picture back: the mean of so many exposures.
// `before` is called with the number of each; what it throws ends the picture.
[[nodiscard]] Image renderImage(Renderer& renderer, GLuint positions, const Camera& camera, double time,
                                int width, int height, int exposures = 1,
                                const std::function<void(int)>& before = {});

}  // namespace clothsim
