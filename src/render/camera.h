// An orbit camera: it looks at a target from a distance, with azimuth and elevation.
#pragma once

#include <glm/glm.hpp>

#include "cloth/cloth.h"
#include "scene/scene.h"

namespace clothsim {

class Camera {
 public:
  // From the scene's camera keys; what is absent is chosen so that cloth and colliders fill the view well.
  Camera(const Scene& scene, const Cloth& cloth);

  void orbit(double azimuthRadians, double elevationRadians);  // elevation stops short of the poles
  void pan(double right, double up);                           // in view heights at the target's distance
  void zoom(double factor);                                    // distance is multiplied by it
  void reset();                                                // as constructed

  [[nodiscard]] glm::mat4 view() const;
  [[nodiscard]] glm::mat4 projection(double aspect) const;
  [[nodiscard]] glm::vec3 eye() const;
  [[nodiscard]] glm::vec3 target() const { return now_.target; }

 private:
  struct Place {
    glm::vec3 target{0};
    double distance = 1, azimuth = 0, elevation = 0, fov = 35;  // [m], [rad], [rad], [degrees]
  };
  Place now_, start_;
};

}  // namespace clothsim
