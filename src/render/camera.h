// An orbit camera: it looks at a target from a distance, with azimuth and elevation.
#pragma once

#include <glm/glm.hpp>

#include "cloth/cloth.h"
#include "scene/scene.h"

namespace clothsim {

// What lies over a picture at its edges, as parts of its width or height, 0 to 0.8 on both sides together.
struct CoveredEdges {
  double left = 0, right = 0, bottom = 0, top = 0;
  friend bool operator==(const CoveredEdges&, const CoveredEdges&) = default;
};

class Camera {
 public:
  // From the scene's camera keys; what is absent is chosen so that cloth and solids, wherever they may go,
  // fill what is free of a picture of that aspect (width / height). A given position is kept, and the picture
  // taken from farther away when it is narrower than 16 : 9.
  Camera(const Scene& scene, const Cloth& cloth, double aspect = 16.0 / 9.0,
         const CoveredEdges& covered = {});

  void orbit(double azimuthRadians, double elevationRadians);  // elevation stops short of the poles
  void pan(double right, double up);                           // in view heights at the target's distance
  void zoom(double factor);                                    // distance is multiplied by it
  // From the positive end of an axis (0 to 2: x, y, z), or of its other end; where it looks from there
  // already, from the opposite one.
  void lookFrom(int axis, bool fromPositiveEnd = true);
  void reset();  // as constructed
  // Takes over where reset() leads to, and goes there if it stands at its own start.
  void setHome(const Camera& other);

  [[nodiscard]] glm::mat4 view() const;
  [[nodiscard]] glm::mat4 projection(double aspect) const;
  [[nodiscard]] glm::vec3 eye() const;
  // With which a scene has this camera at its start, in a picture of this aspect; `own` where it was not
  // moved.
  [[nodiscard]] CameraSettings settings(CameraSettings own) const;
  [[nodiscard]] glm::vec3 target() const { return now_.target; }

 private:
  struct Place {
    glm::vec3 target{0};
    double distance = 1, azimuth = 0, elevation = 0, fov = 35;  // [m], [rad], [rad], [degrees]
    friend bool operator==(const Place&, const Place&) = default;
  };
  Place now_, start_;
  double back_ = 1;  // by how much a scene's own camera is farther away, in narrow pictures
};

// For a picture of so many pixels. A scene's own camera stands where the scene puts it, whatever it crops.
[[nodiscard]] Camera pictureCamera(const Scene& scene, const Cloth& cloth, int width, int height);

}  // namespace clothsim
