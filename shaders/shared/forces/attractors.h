// m c S / R (1 - r^2 / R^2)^2 towards each attractor (src/scene/forces/attractors.h). An implicit step takes
// it for a spring: (1 - r^2 / R^2)^2 is as it is, which bounds the slope of a pull from above, and pushes
// have none.
LAW ParticleForce attraction(vec3 x, vec3 v, real mass) {
  const real zero = real(0.0);
  vec3 force = vec3(zero, zero, zero);
  real stiffness = zero;
  for (uint k = 0u; k < step.attractorCount; ++k) {
    precise vec3 d = vec3(step.attractors[k].x, step.attractors[k].y, step.attractors[k].z) - x;
    precise real inside = real(1.0) - step.attractors[k].inverseRadiusSquared * sumOfProducts(d, d);
    precise real pulled = step.attractors[k].pull * (inside * inside);
    real pull = zero < inside ? pulled : zero;
    precise vec3 acceleration = pull * d;
    precise vec3 more = force + mass * canonical(acceleration);
    precise real stiffer = stiffness + mass * pull;
    force = more;
    stiffness = zero < pull ? stiffer : stiffness;
  }
  return ParticleForce(force, zero, stiffness);
}
