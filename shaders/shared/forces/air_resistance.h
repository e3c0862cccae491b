// -a |v| v, in an implicit step -a |v| v'.
LAW ParticleForce airResistance(vec3 x, vec3 v, real mass, uint source) {
  precise real speedSquared = sumOfProducts(v, v);
  precise real speed = speedSquared * inverseSquareRoot(speedSquared);
  precise real damping = step.airResistance * speed;
  precise real against = -damping;
  precise vec3 force = against * v;
  return ParticleForce(force, damping, real(0.0));
}
