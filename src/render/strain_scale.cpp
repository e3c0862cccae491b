#include "render/strain_scale.h"

#include "shared/render_layout.h"

namespace clothsim {

std::vector<StrainStop> strainScale(const RenderSettings& settings) {
  constexpr std::array<std::array<float, 3>, STRAIN_STOPS> colors{{{0.04f, 0.16f, 0.42f},
                                                                   {0.14f, 0.42f, 0.66f},
                                                                   {0.55f, 0.75f, 0.86f},
                                                                   {0.93f, 0.92f, 0.89f},
                                                                   {0.95f, 0.71f, 0.48f},
                                                                   {0.84f, 0.38f, 0.14f},
                                                                   {0.52f, 0.09f, 0.05f}}};
  std::vector<StrainStop> stops;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double place = 2 * static_cast<double>(i) / (STRAIN_STOPS - 1) - 1;
    stops.push_back({place * settings.strainRange, colors[i]});
  }
  return stops;
}

}  // namespace clothsim
