// An orbit camera: it looks at a target from a distance, with azimuth and elevation.
#pragma once

#include <glm/glm.hpp>

#include "cloth/cloth.h"
#include "scene/scene.h"

namespace clothsim {

class Camera {
 public:
  // From the scene's camera keys; what is absent is chosen so that cloth and colliders fill a picture of that
  // aspect (width / height) well. One narrower than 16 : 9 is taken from farther away.
  Camera(const Scene& scene, const Cloth& cloth, double aspect = 16.0 / 9.0);

  void orbit(double azimuthRadians, double elevationRadians);  // elevation stops short of the poles
  void pan(double right, double up);                           // in view heights at the target's distance
  void zoom(double factor);                                    // distance is multiplied by it
  void reset();                                                // as constructed
  // Takes over where reset() leads to, and goes there if it stands at its own start.
  void setHome(const Camera& other);

  [[nodiscard]] glm::mat4 view() const;
  [[nodiscard]] glm::mat4 projection(double aspect) const;
  [[nodiscard]] glm::vec3 eye() const;
  [[nodiscard]] glm::vec3 target() const { return now_.target; }

 private:
  struct Place {
    glm::vec3 target{0};
    double distance = 1, azimuth = 0, elevation = 0, fov = 35;  // [m], [rad], [rad], [degrees]
    friend bool operator==(const Place&, const Place&) = default;
  };
  Place now_, start_;
};

}  // namespace clothsim
