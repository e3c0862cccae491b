// The colours of the strain map, for its legend.
#pragma once

#include <array>
#include <vector>

#include "scene/scene.h"

namespace clothsim {

struct StrainStop {
  double strain;              // l/L - 1; linear between stops, constant beyond the first and the last
  std::array<float, 3> srgb;  // 0 to 1
};
// From blue (compressed) over grey (at rest) to red (stretched); safe for colour-blind eyes, since lightness
// falls to both sides and no red stands against green.
[[nodiscard]] std::vector<StrainStop> strainScale(const RenderSettings& settings);

}  // namespace clothsim
