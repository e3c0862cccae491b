// Collide on the CPU: particles out of colliders; the twin of shaders/sim/collide.glsl.
#pragma once

#include "solver/cpu/passes.h"
#include "solver/cpu/symmetric.h"

namespace clothsim::cpu {

// One row of the grid, in place on `after`: particles that are inside a collider, or went through it on the
// way from `before.positions` (carried along with a moving collider), go to its surface as the friction law
// says; each move dx adds dx / h to the velocity. May run more than once in a step, after any pass that moves
// particles. At the end no particle is inside the collider that was handled last.
void collide(const PassArguments<float>& arguments, int row);
void collide(const PassArguments<double>& arguments, int row);

// What particles must not cross in an implicit step (solver/implicit.h): the plane in which a particle's way
// d from the start of the step touches the collider that it is in, or was in last, n.d = offset. Where n is
// 0, none.
template <class Real>
struct ContactPlanes {
  Components<Real> normals;   // n
  std::vector<Real> offsets;  // [m]
  // How far the moving collider carries the particle along, less the elastic slip [m]: what differs from it
  // is what friction acts on.
  Components<Real> carries;
  // What the step before remembers, and this one leaves: elastic slips [m], and what held (LEAST_HELD) [N].
  Components<Real> elasticSlips, newElasticSlips;
  std::vector<Real> heldLimits, newHeldLimits;
  std::vector<Real> frictions;  // Coulomb's coefficient; 0 under CS184's law
  // Of the Newton step: what push and friction add to the Hessian [N/m], and the largest friction [N]. 0
  // where the plane does not hold.
  SymmetricField<Real> blocks;
  std::vector<Real> limits;

  void resize(std::size_t particles) {
    normals.resize(particles);
    offsets.resize(particles);
    carries.resize(particles);
    elasticSlips.resize(particles);
    newElasticSlips.resize(particles);
    heldLimits.resize(particles);
    newHeldLimits.resize(particles);
    frictions.resize(particles);
    blocks.resize(particles);
    limits.resize(particles);
  }
};

// One row of the grid: the planes of particles at `places`. Where several colliders are touched, the last of
// the scene's counts; what touches nothing keeps its plane. With a margin [m], only of particles that have no
// plane: that of the first collider whose surface is nearer.
void findPlanes(const PassArguments<float>& arguments, const Components<float>& places,
                ContactPlanes<float>& planes, int row, float margin = 0);
void findPlanes(const PassArguments<double>& arguments, const Components<double>& places,
                ContactPlanes<double>& planes, int row, double margin = 0);

// How a point of the cloth that goes from `start` to `place` in the step meets a collider.
template <class Real>
struct Touch {
  Vec3<Real> normal;  // of the collider's surface, outward, towards where the point came from
  Real depth;         // how far the point is behind that surface; negative before it [m]
  Vec3<Real> carry;   // how far a moving collider carries the point along [m]
};
template <class Real>
[[nodiscard]] Touch<Real> touchAt(const PassArguments<Real>& arguments, std::uint32_t collider,
                                  Vec3<Real> start, Vec3<Real> place);

// A place in the collider's own frame at the end of the step: one of then, or one of the start of the step,
// carried along.
template <class Real>
[[nodiscard]] Vec3<Real> placeInFrame(const ColliderParams<Real>& collider, Vec3<Real> x);
template <class Real>
[[nodiscard]] Vec3<Real> startInFrame(const ColliderParams<Real>& collider, Vec3<Real> x);
// A direction of the own frame of a collider that is no sphere, in the world.
template <class Real>
[[nodiscard]] Vec3<Real> directionInWorld(const ColliderParams<Real>& collider, Vec3<Real> direction);

}  // namespace clothsim::cpu
