#include "render/piece_looks.h"

#include <algorithm>

#include "cloth/material_look.h"

namespace clothsim {

std::vector<PieceLook> looksOf(const Scene& scene, bool thick) {
  std::vector<PieceLook> looks;
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    const RenderSettings settings = lookOf(scene, i);
    looks.push_back({settings, shadingModelOf(settings, thick)});
  }
  if (std::all_of(looks.begin(), looks.end(),
                  [&](const PieceLook& look) { return look.settings == looks.front().settings; }))
    looks.resize(1);
  return looks;
}

}  // namespace clothsim
