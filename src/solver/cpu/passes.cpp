#include "solver/cpu/passes.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "core/exact_math.h"

// Loops along a row are compiled for several instruction sets, chosen when the program starts; with
// contraction off (CMakeLists.txt) all of them give the same bits. Sanitizer builds and other compilers take
// the plain one.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define VECTOR_CLONES
#endif
#define INLINE [[gnu::always_inline]] inline

namespace clothsim::cpu {
namespace {

// A stretch of particles [begin, end) of one row, as indices into the arrays.
struct Stretch {
  std::ptrdiff_t begin, end;
};

// Those particles of the row whose neighbours from `firstOffset` to `lastOffset` columns away are on the
// grid.
template <class Real>
Stretch stretch(const StepParams<Real>& step, int row, int firstOffset = 0, int lastOffset = 0) {
  const auto columns = static_cast<std::ptrdiff_t>(step.columns);
  const std::ptrdiff_t start = static_cast<std::ptrdiff_t>(step.firstParticle) + row * columns;
  return {start + std::max(0, -firstOffset), start + columns - std::max(0, lastOffset)};
}

template <class Real>
std::ptrdiff_t indexOffset(const StepParams<Real>& step, int columns, int rows) {
  return columns + rows * static_cast<std::ptrdiff_t>(step.columns);
}

template <class Real>
INLINE Vec3<Real> load(const Real* x, const Real* y, const Real* z, std::ptrdiff_t i) {
  return {x[i], y[i], z[i]};
}

// Hooke's law: k (l - L) along the unit vector from a to b.
template <class Real>
INLINE Vec3<Real> springForce(Vec3<Real> a, Vec3<Real> b, Real stiffness, Real restLength) {
  const Vec3<Real> d = b - a;
  const Real lengthSquared = dot(d, d);
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real length = lengthSquared * inverseLength;
  const Real scale = (stiffness * (length - restLength)) * inverseLength;
  return scale * d;
}

// A third of the force of the air on triangle (a, b, c): pressure along its normal, rho C_d / 2 A (u.n)|u.n|
// n, and lift across the relative wind u, rho C_l / 2 A |u|^2 (e.n) (n - (e.n) e) with e = u/|u|. `normal` is
// 2 A n, and the factors of the step hold rho C / 12. Both terms are even in n: it does not matter to which
// side it points.
template <class Real>
INLINE Vec3<Real> windForce(const StepParams<Real>& step, Vec3<Real> a, Vec3<Real> b, Vec3<Real> c,
                            Vec3<Real> va, Vec3<Real> vb, Vec3<Real> vc) {
  constexpr Real third = static_cast<Real>(1.0 / 3.0);
  const Vec3<Real> normal = cross(b - a, c - a);
  const Real normalSquared = dot(normal, normal);
  const Real inverseNormal = inverseSquareRoot(normalSquared);
  const Vec3<Real> air{step.airVelocityX, step.airVelocityY, step.airVelocityZ};
  const Vec3<Real> u = air - third * ((va + vb) + vc);
  const Real speedSquared = dot(u, u);
  const Real inverseSpeed = inverseSquareRoot(speedSquared);
  const Real speed = speedSquared * inverseSpeed;
  const Real through = dot(u, normal);
  const Real across = through * inverseNormal;  // u.n
  const Real acrossMagnitude = across < Real(0) ? -across : across;
  const Real alongNormal = step.dragFactor * (across * acrossMagnitude) + step.liftFactor * (across * speed);
  const Real alongWind = step.liftFactor * ((across * through) * inverseSpeed);
  const Vec3<Real> force = alongNormal * normal - alongWind * u;
  const bool degenerate = normalSquared < static_cast<Real>(0x1p-100);
  return {degenerate ? Real(0) : force.x, degenerate ? Real(0) : force.y, degenerate ? Real(0) : force.z};
}

// The triangles at a grid point in ascending number (cloth/cloth.h), corners as (columns, rows) from the
// point.
struct Corner {
  int columns, rows;
};
constexpr std::array<std::array<Corner, 3>, 6> triangleFan{{{{{0, -1}, {-1, 0}, {0, 0}}},
                                                            {{{0, -1}, {0, 0}, {1, -1}}},
                                                            {{{1, -1}, {0, 0}, {1, 0}}},
                                                            {{{-1, 0}, {-1, 1}, {0, 0}}},
                                                            {{{0, 0}, {-1, 1}, {0, 1}}},
                                                            {{{0, 0}, {0, 1}, {1, 0}}}}};

// Adds the forces of one incident spring to every particle of the stretch. `rest` is null when all lengths
// are nominal.
template <class Real>
INLINE void addSpring(const PassArguments<Real>& arguments, Stretch particles, std::ptrdiff_t other,
                      const SpringParams<Real>& spring, const Real* rest) {
  const Real *x = arguments.before.positions.x.data(), *y = arguments.before.positions.y.data(),
             *z = arguments.before.positions.z.data();
  Real *fx = arguments.forces.x.data(), *fy = arguments.forces.y.data(), *fz = arguments.forces.z.data();
  const Real stiffness = spring.stiffness, nominal = spring.restLength;
  if (rest == nullptr) {
#pragma omp simd
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
      const Vec3<Real> f = springForce(load(x, y, z, i), load(x, y, z, i + other), stiffness, nominal);
      fx[i] = fx[i] + f.x;
      fy[i] = fy[i] + f.y;
      fz[i] = fz[i] + f.z;
    }
  } else {
#pragma omp simd
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
      const Vec3<Real> f = springForce(load(x, y, z, i), load(x, y, z, i + other), stiffness, rest[i]);
      fx[i] = fx[i] + f.x;
      fy[i] = fy[i] + f.y;
      fz[i] = fz[i] + f.z;
    }
  }
}

template <class Real>
INLINE void addSprings(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  for (const IncidentSpring& incident : incidentSprings) {
    const SpringParams<Real>& spring = step.springs[incident.slot];
    const int otherRow = row + incident.rows;
    if (spring.enabled == 0 || otherRow < 0 || otherRow >= static_cast<int>(step.rows)) continue;
    const Stretch particles = stretch(step, row, incident.columns, incident.columns);
    const std::ptrdiff_t other = indexOffset(step, incident.columns, incident.rows);
    const Real* rest = nullptr;
    if (step.useRestLengthTable != 0)
      rest = arguments.restLengths + static_cast<std::size_t>(incident.slot) * step.totalParticles +
             (incident.owned ? 0 : other);
    addSpring(arguments, particles, other, spring, rest);
  }
}

template <class Real>
INLINE void addWind(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  const Components<Real>&p = arguments.before.positions, &v = arguments.before.velocities;
  const Real *x = p.x.data(), *y = p.y.data(), *z = p.z.data(), *vx = v.x.data(), *vy = v.y.data(),
             *vz = v.z.data();
  Real *fx = arguments.forces.x.data(), *fy = arguments.forces.y.data(), *fz = arguments.forces.z.data();
  for (const auto& [a, b, c] : triangleFan) {
    const auto [firstRow, lastRow] = std::minmax({a.rows, b.rows, c.rows});
    if (row + firstRow < 0 || row + lastRow >= static_cast<int>(step.rows)) continue;
    const auto [firstColumn, lastColumn] = std::minmax({a.columns, b.columns, c.columns});
    const Stretch particles = stretch(step, row, firstColumn, lastColumn);
    const std::ptrdiff_t ia = indexOffset(step, a.columns, a.rows), ib = indexOffset(step, b.columns, b.rows),
                         ic = indexOffset(step, c.columns, c.rows);
#pragma omp simd
    for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
      const Vec3<Real> f =
          windForce(step, load(x, y, z, i + ia), load(x, y, z, i + ib), load(x, y, z, i + ic),
                    load(vx, vy, vz, i + ia), load(vx, vy, vz, i + ib), load(vx, vy, vz, i + ic));
      fx[i] = fx[i] + f.x;
      fy[i] = fy[i] + f.y;
      fz[i] = fz[i] + f.z;
    }
  }
}

// -a |v| v
template <class Real>
INLINE void addAirResistance(const PassArguments<Real>& arguments, int row) {
  const Components<Real>& v = arguments.before.velocities;
  const Real *vx = v.x.data(), *vy = v.y.data(), *vz = v.z.data();
  Real *fx = arguments.forces.x.data(), *fy = arguments.forces.y.data(), *fz = arguments.forces.z.data();
  const Real airResistance = arguments.step.airResistance;
  const Stretch particles = stretch(arguments.step, row);
#pragma omp simd
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Vec3<Real> velocity = load(vx, vy, vz, i);
    const Real speedSquared = dot(velocity, velocity);
    const Real speed = speedSquared * inverseSquareRoot(speedSquared);
    const Real scale = airResistance * speed;
    fx[i] = fx[i] - scale * velocity.x;
    fy[i] = fy[i] - scale * velocity.y;
    fz[i] = fz[i] - scale * velocity.z;
  }
}

template <class Real>
INLINE void gatherForcesRow(const PassArguments<Real>& arguments, int row) {
  const Stretch particles = stretch(arguments.step, row);
  std::fill(&arguments.forces.x[0] + particles.begin, &arguments.forces.x[0] + particles.end, Real(0));
  std::fill(&arguments.forces.y[0] + particles.begin, &arguments.forces.y[0] + particles.end, Real(0));
  std::fill(&arguments.forces.z[0] + particles.begin, &arguments.forces.z[0] + particles.end, Real(0));
  addSprings(arguments, row);
  if (arguments.step.hasWind != 0) addWind(arguments, row);
  if (arguments.step.airResistance > Real(0)) addAirResistance(arguments, row);
}

// One component of x' = x + h v', v' = (1 - damping) v + h (g + w f); pinned particles rest.
template <class Real>
INLINE void integrateComponent(const StepParams<Real>& step, Stretch particles, Real gravity,
                               const Real* inverseMass, const Real* force, const Real* position,
                               const Real* velocity, Real* newPosition, Real* newVelocity) {
  const Real timeStep = step.timeStep, velocityKept = step.velocityKept;
#pragma omp simd
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Real acceleration = gravity + inverseMass[i] * force[i];
    const Real v = velocityKept * velocity[i] + timeStep * acceleration;
    const Real x = position[i] + timeStep * v;
    const bool pinned = inverseMass[i] == Real(0);
    newVelocity[i] = pinned ? Real(0) : canonical(v);
    newPosition[i] = pinned ? position[i] : canonical(x);
  }
}

template <class Real>
INLINE void integrateRow(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  const Stretch particles = stretch(step, row);
  const auto& [before, after, f] = std::tie(arguments.before, arguments.after, arguments.forces);
  integrateComponent(step, particles, step.gravityX, arguments.inverseMasses, f.x.data(),
                     before.positions.x.data(), before.velocities.x.data(), after.positions.x.data(),
                     after.velocities.x.data());
  integrateComponent(step, particles, step.gravityY, arguments.inverseMasses, f.y.data(),
                     before.positions.y.data(), before.velocities.y.data(), after.positions.y.data(),
                     after.velocities.y.data());
  integrateComponent(step, particles, step.gravityZ, arguments.inverseMasses, f.z.data(),
                     before.positions.z.data(), before.velocities.z.data(), after.positions.z.data(),
                     after.velocities.z.data());
}

// Where the particle was at the start of the step, carried along with a moving collider.
template <class Real>
INLINE Vec3<Real> carried(const ColliderParams<Real>& collider, Vec3<Real> x) {
  const Vec3<Real> d = x - Vec3<Real>{collider.pivotX, collider.pivotY, collider.pivotZ};
  const Vec3<Real> turn{dot({collider.turnXX, collider.turnXY, collider.turnXZ}, d),
                        dot({collider.turnYX, collider.turnYY, collider.turnYZ}, d),
                        dot({collider.turnZX, collider.turnZY, collider.turnZZ}, d)};
  const Vec3<Real> move = turn + Vec3<Real>{collider.shiftX, collider.shiftY, collider.shiftZ};
  return x + move;
}

template <class Real>
struct Contact {
  bool touches;
  Vec3<Real> surface;  // where CS184 puts a particle without friction
};

// Inside the sphere: the nearest point of its surface.
template <class Real>
INLINE Contact<Real> sphereContact(const ColliderParams<Real>& sphere, Vec3<Real> x) {
  const Vec3<Real> center{sphere.pointX, sphere.pointY, sphere.pointZ};
  const Vec3<Real> d = x - center;
  const Real distanceSquared = dot(d, d);
  const Real scale = sphere.radius * inverseSquareRoot(distanceSquared);
  return {distanceSquared < sphere.radiusSquared, center + scale * d};
}

// Crossed since `previous`: the foot of the perpendicular, a little off on the side it came from.
template <class Real>
INLINE Contact<Real> planeContact(const ColliderParams<Real>& plane, Real offset, Vec3<Real> previous,
                                  Vec3<Real> x) {
  const Vec3<Real> point{plane.pointX, plane.pointY, plane.pointZ};
  const Vec3<Real> normal{plane.normalX, plane.normalY, plane.normalZ};
  const Real heightBefore = dot(previous - point, normal);
  const Real height = dot(x - point, normal);
  const bool wasAbove = !(heightBefore < Real(0));
  const bool isAbove = !(height < Real(0));
  const Real side = wasAbove ? offset : -offset;
  const Real lift = side - height;
  return {wasAbove != isAbove, x + lift * normal};
}

template <bool moving, class Real>
INLINE Vec3<Real> previousPosition(const ColliderParams<Real>& collider, Vec3<Real> start) {
  if constexpr (moving) {
    return carried(collider, start);
  } else {
    return start;
  }
}

template <std::uint32_t type, class Real>
INLINE Contact<Real> findContact(const ColliderParams<Real>& collider, Real offset, Vec3<Real> previous,
                                 Vec3<Real> x) {
  if constexpr (type == COLLIDER_SPHERE) {
    return sphereContact(collider, x);
  } else {
    return planeContact(collider, offset, previous, x);
  }
}

// One collider and a stretch of particles; compiled for each type, at rest and moving, so that the loop runs
// in vector registers.
template <std::uint32_t type, bool moving, class Real>
INLINE void collideWith(const PassArguments<Real>& arguments, const ColliderParams<Real>& collider,
                        Stretch particles) {
  const Components<Real>& old = arguments.before.positions;
  Components<Real>&p = arguments.after.positions, &v = arguments.after.velocities;
  const Real *x0 = old.x.data(), *y0 = old.y.data(), *z0 = old.z.data();
  Real *x = p.x.data(), *y = p.y.data(), *z = p.z.data(), *vx = v.x.data(), *vy = v.y.data(),
       *vz = v.z.data();
  const Real* inverseMasses = arguments.inverseMasses;
  const Real offset = arguments.step.planeOffset, inverseTimeStep = arguments.step.inverseTimeStep;
#pragma omp simd
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Vec3<Real> now = load(x, y, z, i), start = load(x0, y0, z0, i);
    const Vec3<Real> velocity = load(vx, vy, vz, i);
    const Vec3<Real> previous = previousPosition<moving>(collider, start);
    const Contact<Real> contact = findContact<type>(collider, offset, previous, now);
    const Vec3<Real> corrected = previous + collider.motionKept * (contact.surface - previous);
    const Vec3<Real> kicked = velocity + inverseTimeStep * (corrected - now);
    const bool moves = contact.touches & (inverseMasses[i] > Real(0));
    x[i] = moves ? canonical(corrected.x) : now.x;
    y[i] = moves ? canonical(corrected.y) : now.y;
    z[i] = moves ? canonical(corrected.z) : now.z;
    vx[i] = moves ? canonical(kicked.x) : velocity.x;
    vy[i] = moves ? canonical(kicked.y) : velocity.y;
    vz[i] = moves ? canonical(kicked.z) : velocity.z;
  }
}

template <class Real>
INLINE void collideRow(const PassArguments<Real>& arguments, int row) {
  const Stretch particles = stretch(arguments.step, row);
  for (std::uint32_t k = 0; k < arguments.step.colliderCount; ++k) {
    const ColliderParams<Real> collider = arguments.colliders[k];
    const bool isSphere = collider.type == COLLIDER_SPHERE, moving = collider.moving != 0;
    if (isSphere && moving)
      collideWith<COLLIDER_SPHERE, true>(arguments, collider, particles);
    else if (isSphere)
      collideWith<COLLIDER_SPHERE, false>(arguments, collider, particles);
    else if (moving)
      collideWith<COLLIDER_PLANE, true>(arguments, collider, particles);
    else
      collideWith<COLLIDER_PLANE, false>(arguments, collider, particles);
  }
}

template <class Real>
INLINE void kickComponent(const StepParams<Real>& step, Stretch particles, Real gravity,
                          const Real* inverseMass, const Real* force, const Real* velocity,
                          Real* newVelocity) {
  for (std::ptrdiff_t i = particles.begin; i < particles.end; ++i) {
    const Real acceleration = gravity + inverseMass[i] * force[i];
    const Real v = velocity[i] + step.kickTime * acceleration;
    newVelocity[i] = inverseMass[i] == Real(0) ? Real(0) : canonical(v);
  }
}

// The spring from `a`, its owner, to `b`: when longer than the limit, both ends move half of the excess
// towards each other, or the free end all of it.
template <class Real>
INLINE void limitSpring(const PassArguments<Real>& arguments, std::ptrdiff_t a, std::ptrdiff_t b,
                        Real limit) {
  Components<Real>&p = arguments.after.positions, &v = arguments.after.velocities;
  const Vec3<Real> xa{p.x[a], p.y[a], p.z[a]}, xb{p.x[b], p.y[b], p.z[b]};
  const Vec3<Real> d = xb - xa;
  const Real lengthSquared = dot(d, d);
  const Real limitSquared = limit * limit;
  const bool freeA = arguments.inverseMasses[a] > Real(0), freeB = arguments.inverseMasses[b] > Real(0);
  if (!(limitSquared < lengthSquared) || !(freeA || freeB)) return;
  const Real inverseLength = inverseSquareRoot(lengthSquared);
  const Real length = lengthSquared * inverseLength;
  const Real excess = (length - limit) * inverseLength;
  const Real share = freeA && freeB ? Real(0.5) * excess : excess;
  const Vec3<Real> move = share * d;
  const Vec3<Real> kick = arguments.step.inverseTimeStep * move;
  if (freeA) {
    p.x[a] = canonical(xa.x + move.x);
    p.y[a] = canonical(xa.y + move.y);
    p.z[a] = canonical(xa.z + move.z);
    v.x[a] = canonical(v.x[a] + kick.x);
    v.y[a] = canonical(v.y[a] + kick.y);
    v.z[a] = canonical(v.z[a] + kick.z);
  }
  if (freeB) {
    p.x[b] = canonical(xb.x - move.x);
    p.y[b] = canonical(xb.y - move.y);
    p.z[b] = canonical(xb.z - move.z);
    v.x[b] = canonical(v.x[b] - kick.x);
    v.y[b] = canonical(v.y[b] - kick.y);
    v.z[b] = canonical(v.z[b] - kick.z);
  }
}

}  // namespace

VECTOR_CLONES void gatherForces(const PassArguments<float>& arguments, int row) {
  gatherForcesRow(arguments, row);
}
void gatherForces(const PassArguments<double>& arguments, int row) { gatherForcesRow(arguments, row); }

VECTOR_CLONES void integrate(const PassArguments<float>& arguments, int row) { integrateRow(arguments, row); }
void integrate(const PassArguments<double>& arguments, int row) { integrateRow(arguments, row); }

VECTOR_CLONES void collide(const PassArguments<float>& arguments, int row) { collideRow(arguments, row); }
void collide(const PassArguments<double>& arguments, int row) { collideRow(arguments, row); }

template <class Real>
void kick(const PassArguments<Real>& arguments, int row) {
  const StepParams<Real>& step = arguments.step;
  const Stretch particles = stretch(step, row);
  const auto& [before, after, f] = std::tie(arguments.before, arguments.after, arguments.forces);
  kickComponent(step, particles, step.gravityX, arguments.inverseMasses, f.x.data(),
                before.velocities.x.data(), after.velocities.x.data());
  kickComponent(step, particles, step.gravityY, arguments.inverseMasses, f.y.data(),
                before.velocities.y.data(), after.velocities.y.data());
  kickComponent(step, particles, step.gravityZ, arguments.inverseMasses, f.z.data(),
                before.velocities.z.data(), after.velocities.z.data());
}

template <class Real>
void limitStrain(const PassArguments<Real>& arguments, const LimitColor& color, std::uint32_t j) {
  const StepParams<Real>& step = arguments.step;
  const SpringOffset& offset = springOffsets[color.slot];
  const std::ptrdiff_t other = indexOffset(step, offset.columns, offset.rows);
  const std::uint32_t row = color.firstRow + color.rowStep * (j / color.rowRun) + j % color.rowRun;
  const std::uint32_t count =
      ownerCount(color.firstColumn, color.columnStep, color.columnRun, color.endColumn);
  const Real* rest = arguments.restLengths + static_cast<std::size_t>(color.slot) * step.totalParticles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t column =
        color.firstColumn + color.columnStep * (i / color.columnRun) + i % color.columnRun;
    const std::ptrdiff_t owner =
        static_cast<std::ptrdiff_t>(step.firstParticle) + row * step.columns + column;
    const Real limit =
        step.useRestLengthTable != 0 ? step.limitFactor * rest[owner] : step.springs[color.slot].limitLength;
    limitSpring(arguments, owner, owner + other, limit);
  }
}

template void kick(const PassArguments<float>&, int);
template void kick(const PassArguments<double>&, int);
template void limitStrain(const PassArguments<float>&, const LimitColor&, std::uint32_t);
template void limitStrain(const PassArguments<double>&, const LimitColor&, std::uint32_t);

}  // namespace clothsim::cpu
