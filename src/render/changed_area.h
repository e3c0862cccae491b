// Which part of a picture differs from the one before it: where cloth and moving solids are and were, and
// where their shadows fall. The rest can be kept, pixel for pixel.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "render/colliders.h"
#include "render/flat_bounds.h"
#include "render/shadow_footprint.h"

namespace clothsim {

// Parts of a picture one above the other, each as wide as what it shows.
class PixelBands {
 public:
  static constexpr int HEIGHT = 32;
  PixelBands(int width, int height);
  void add(const FlatBounds& seen);  // [pixels]; what is outside of the picture is left out
  [[nodiscard]] std::span<const PixelRect> bands() const { return bands_; }

 private:
  int width_;
  std::vector<PixelRect> bands_;
};

class ChangedArea {
 public:
  struct View {
    glm::mat4 clipFromWorld, shadowFromWorld;
    int width, height;  // of the picture [pixels]
    float reach = 0;    // how far from the particles the surface may be [m]
    friend bool operator==(const View&, const View&) = default;
  };
  struct Area {
    PixelRect picture;
    FlatBounds shadow;  // in the shadow map, 0 to 1 in each coordinate
  };
  // Where cloth is seen, and where in the shadow map, with all that filters there look at.
  struct ClothPlace {
    FlatBounds picture;  // [pixels]
    ShadowFootprint shadow;
  };

  // None: a particle has no place in the picture.
  [[nodiscard]] static std::optional<ClothPlace> placeOf(const Cloth& cloth,
                                                         std::span<const glm::vec4> particles,
                                                         const View& view);
  // What has changed since the last call. None: everything, as when a plane has moved. Where the camera has
  // moved, all of the picture, but not of the shadow map.
  [[nodiscard]] std::optional<Area> next(const View& view, const ClothPlace& place,
                                         const Colliders& colliders);
  // Where a plane is seen that a picture without shadows, and with nothing before it or below it, does not
  // show already: where the shadows of particles and solids may fall, and where it hides any.
  // None: that is unknown.
  [[nodiscard]] static std::optional<PixelBands> shadowsOn(const PlaneDisc& plane, const View& view,
                                                           const ClothPlace& place,
                                                           std::span<const glm::vec4> particles,
                                                           const Colliders& colliders);
  // The next picture is new everywhere.
  void forget() { last_.reset(); }

 private:
  struct Seen {
    View view;
    std::vector<SolidPlace> solids;
    std::vector<PlaneDisc> planes;
    ClothPlace cloth;
  };
  std::optional<Seen> last_;
};

}  // namespace clothsim
