#include "cloth/contact_memory.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>

#include "core/error.h"

namespace clothsim {

void checkContactMemory(const Scene& scene, double memory) {
  if (scene.solver.selfCollision != SelfCollision::averaged) return;
  constexpr double reach = 1.4, most = 7, bytesAPair = 30;  // solver/self_collision.cpp; measured
  double needed = 0;
  for (const ClothSettings& cloth : scene.cloths) {
    if (cloth.isMesh()) continue;
    const double dx = cloth.width / (cloth.numWidthPoints - 1),
                 dy = cloth.height / (cloth.numHeightPoints - 1);
    const double thickness = cloth.thicknessInUse();
    const double radius = reach * std::min(2 * thickness, most * std::min(dx, dy));
    const double pairs = std::numbers::pi * radius * radius / (dx * dy);
    needed += static_cast<double>(cloth.numWidthPoints) * cloth.numHeightPoints *
              (BYTES_A_PARTICLE + bytesAPair * pairs);
  }
  if (!(needed > memory)) return;  // also for a single particle, whose spacing is none
  std::array<char, 256> text{};
  std::snprintf(
      text.data(), text.size(),
      "the particles and their contacts within 2 cloth.thickness need about %.1f GB; this machine has "
      "%.1f GB. Lower thickness, use fewer points, or solver.self_collision \"robust\" or false.",
      needed / 1e9, memory / 1e9);
  throw SceneError(text.data());
}

}  // namespace clothsim
