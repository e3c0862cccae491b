#include "measure/energies.h"

#include <algorithm>
#include <cmath>

namespace clothsim {
namespace {

double squaredLength(Vec3d a, Vec3d b) { return dot(b - a, b - a); }

double membraneEnergy(const Cloth& cloth, const Cuts& cuts, const State& state) {
  double sum = 0;
  for (const Membrane& membrane : cloth.lists().membranes) {
    if (isLost(cuts, cloth, membrane.triangle)) continue;
    const double scale = cloth.pieces()[cloth.pieceOf(membrane.corners[0])].restScale;
    std::array<double, 3> e{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = membrane.corners[(k + 1) % 3], b = membrane.corners[(k + 2) % 3];
      e[k] = 0.5 * (squaredLength(vectorOf(state.positions[a]), vectorOf(state.positions[b])) -
                    scale * scale * squaredLength(cloth.positions()[a], cloth.positions()[b]));
    }
    const auto [x, y, z] = timesRoots(membrane.roots, e);
    sum += 0.5 * (x * x + y * y + z * z);
  }
  return sum;
}

}  // namespace

Energies energies(const Cloth& cloth, std::span<const Spring> springs, const Scene& scene, const Cuts& cuts,
                  const State& state) {
  Energies sum;
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Particle4& x = state.positions[i];
    if (x.w <= 0) continue;
    const Vec3d v = vectorOf(state.velocities[i]);
    const double mass = 1 / static_cast<double>(x.w);
    sum.kinetic += 0.5 * mass * dot(v, v);
    sum.gravity += mass * dot(scene.gravity, cloth.positions()[i] - vectorOf(x));
  }
  for (const Spring& spring : springs) {
    if (isCut(cuts, cloth, spring)) continue;
    const double l = length(vectorOf(state.positions[spring.a]) - vectorOf(state.positions[spring.b]));
    sum.maxStrain = std::max(sum.maxStrain, l / spring.restLength - 1);
    sum.springs += 0.5 * spring.stiffness * (l - spring.restLength) * (l - spring.restLength);
  }
  sum.springs += membraneEnergy(cloth, cuts, state);
  return sum;
}

ParticleFacts factsOf(std::uint32_t particle, const Cloth& cloth, std::span<const Spring> springs,
                      const Cuts& cuts, const State& state) {
  ParticleFacts facts{.speed = length(vectorOf(state.velocities[particle]))};
  for (const Spring& spring : springs) {
    if ((spring.a != particle && spring.b != particle) || isCut(cuts, cloth, spring)) continue;
    const double l = length(vectorOf(state.positions[spring.a]) - vectorOf(state.positions[spring.b]));
    const double strain = l / spring.restLength - 1;
    if (std::abs(strain) <= std::abs(facts.strain)) continue;
    facts.strain = strain;
    facts.force = spring.stiffness * (l - spring.restLength);
  }
  return facts;
}

}  // namespace clothsim
