#include "measure/energies.h"

#include <algorithm>
#include <cmath>

namespace clothsim {
namespace {}  // namespace

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
    if (isCut(cuts, spring)) continue;
    const double l = length(vectorOf(state.positions[spring.a]) - vectorOf(state.positions[spring.b]));
    sum.maxStrain = std::max(sum.maxStrain, l / spring.restLength - 1);
    sum.springs += 0.5 * spring.stiffness * (l - spring.restLength) * (l - spring.restLength);
  }
  return sum;
}

namespace {

double strainOnMesh(const Cloth& cloth, const State& state, std::uint32_t particle) {
  const SpringLists& lists = cloth.lists();
  double strain = 0;
  for (std::uint32_t n = lists.springsOf.starts[particle]; n < lists.springsOf.starts[particle + 1]; ++n) {
    const MeshSpring& spring = lists.springs[lists.springsOf.entries[n]];
    const double rest = length(cloth.positions()[spring.a] - cloth.positions()[spring.b]);
    const double l = length(vectorOf(state.positions[spring.a]) - vectorOf(state.positions[spring.b]));
    if (std::abs(l / rest - 1) > std::abs(strain)) strain = l / rest - 1;
  }
  return strain;
}

}  // namespace

double strainAt(const Cloth& cloth, const Cuts& cuts, const State& state, std::uint32_t particle) {
  const Piece& piece = cloth.pieces()[cloth.pieceOf(particle)];
  if (piece.isMesh) return strainOnMesh(cloth, state, particle);
  const std::uint32_t place = particle - piece.firstParticle;
  const auto columns = static_cast<std::uint32_t>(piece.columns);
  const int column = static_cast<int>(place % columns), row = static_cast<int>(place / columns);
  double strain = 0;
  for (const IncidentSpring& spring : incidentSprings) {
    if (!piece.slotEnabled[spring.slot] || !piece.contains(column + spring.columns, row + spring.rows))
      continue;
    const std::uint32_t other = piece.particle(column + spring.columns, row + spring.rows);
    if (isCut(cuts, spring.owned ? particle : other, spring.slot)) continue;
    const double rest = piece.hasRestLengthTable
                            ? length(cloth.positions()[particle] - cloth.positions()[other])
                            : piece.nominalLength[spring.slot];
    const double l = length(vectorOf(state.positions[particle]) - vectorOf(state.positions[other]));
    if (std::abs(l / rest - 1) > std::abs(strain)) strain = l / rest - 1;
  }
  return strain;
}

}  // namespace clothsim
