// x' = x + h v', v' = (1 - damping) v + h (g + w f); pinned particles rest.
struct Particle {
  vec4 position;  // w: inverse mass
  vec3 velocity;
};

Particle integrateParticle(uint i, vec3 force) {
  vec4 x = positionAt(i);
  vec3 v = velocityAt(i);
  if (x.w == 0.0) return Particle(x, vec3(0.0));
  vec3 acceleration = accelerationOf(force, x.w);
  precise vec3 newV = step.velocityKept * v + step.timeStep * acceleration;
  precise vec3 newX = x.xyz + step.timeStep * newV;
  return Particle(vec4(canonical(newX), x.w), canonical(newV));
}
