// What moves: positions and velocities of all particles at a time. The layout is that of the shader storage
// buffers.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cloth/cuts.h"
#include "core/vec.h"
#include "scene/scene.h"
#include "solver/step_clock.h"

namespace clothsim {

class Cloth;

struct alignas(16) Particle4 {  // one vec4 of a storage buffer
  float x = 0, y = 0, z = 0, w = 0;
};

[[nodiscard]] inline Vec3d vectorOf(const Particle4& p) { return Vec3f{p.x, p.y, p.z}.cast<double>(); }

// How far friction of an implicit step holds two parts of the cloth's surface back, or one and a small
// collider, from where it took hold of them (solver/implicit.h).
struct PairSlip {
  std::uint32_t place = 0;  // in the order in which a step finds pairs (solver/surface.h)
  std::array<std::uint32_t, 4> particles{};
  float x = 0, y = 0, z = 0;  // [m]
  float heldLimit = 0;        // as State::elasticSlips' w
};

struct State {
  std::vector<Particle4> positions;   // xyz [m], w the inverse mass [1/kg], 0: pinned
  std::vector<Particle4> velocities;  // xyz [m/s]; of the half step before under `verlet`. w: unused
  StepClock clock;
  Integrator integrator = Integrator::verlet;
  // How far friction of implicit steps holds particles back from where it took hold of them on a collider
  // (solver/implicit.h), xyz [m]; w: how much friction could hold then, at least 2^-40 [N], or 0 where no
  // collider held. Empty: nothing is remembered.
  std::vector<Particle4> elasticSlips;
  std::vector<PairSlip> pairSlips;  // the same where cloth touches cloth, ascending by place
  // What `bdf2` looks back at (solver/implicit.h): a third of what the last step changed of each particle's
  // place [m] and velocity [m/s], one after the other, and how many steps before the next one were usual, up
  // to USUAL_STEPS. Empty and 0: the next step is backward Euler.
  std::vector<Particle4> histories;
  std::uint32_t usualSteps = 0;
  Cuts cuts;  // empty: none
  // Particles that a person has pinned or freed, ascending: no path moves them.
  std::vector<std::uint32_t> offPath;
};

// On the lattice, at time 0.
[[nodiscard]] State stateAtRest(const Cloth& cloth);

// Empties elasticSlips and pairSlips where they hold only zeros, as before anything has touched.
void dropZeroSlips(State& state);

// To be called where particles are moved by something else than a step.
void forgetHistory(State& state);

// Adds a particle to State::offPath.
void leavePath(std::vector<std::uint32_t>& offPath, std::uint32_t particle);

// FNV-1a, 64 bit, over little-endian x, y, z, vx, vy, vz in index order.
[[nodiscard]] std::uint64_t stateHash(const State& state);
[[nodiscard]] std::string hashText(std::uint64_t hash);  // 16 hex digits

}  // namespace clothsim
