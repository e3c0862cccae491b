// m c S / R (1 - r^2 / R^2)^2 towards an attractor (src/scene/forces/attractors.h). An implicit step takes it
// for a spring: (1 - r^2 / R^2)^2 is as it is, which bounds the slope of a pull from above, and pushes have
// none.
LAW ParticleForce attraction(vec3 x, vec3 v, real mass, uint source) {
  const real zero = real(0.0);
  precise vec3 d = vec3(step.attractors[source].x, step.attractors[source].y, step.attractors[source].z) - x;
  precise real inside = real(1.0) - step.attractors[source].inverseRadiusSquared * sumOfProducts(d, d);
  precise real pulled = step.attractors[source].pull * (inside * inside);
  real pull = zero < inside ? pulled : zero;
  precise vec3 acceleration = pull * d;
  precise vec3 force = mass * canonical(acceleration);
  precise real pulls = mass * pull;
  real stiffness = zero < pull ? pulls : zero;
  return ParticleForce(force, zero, stiffness);
}
