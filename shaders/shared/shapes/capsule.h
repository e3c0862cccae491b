// All points within `radius` of the segment from (0, -sizeY, 0) to (0, sizeY, 0).
LAW Nearest nearestOnCapsule(ColliderParams capsule, vec3 p) {
  real halfLength = capsule.sizeY;
  real above = halfLength < p.y ? halfLength : p.y;
  real y = above < -halfLength ? -halfLength : above;
  precise real beyond = p.y - y;
  vec3 d = vec3(p.x, beyond, p.z);
  precise real lengthSquared = sumOfProducts(d, d);
  precise real inverseLength = inverseSquareRoot(lengthSquared);
  precise real distance = lengthSquared * inverseLength - capsule.radius;
  precise vec3 normal = inverseLength * d;
  return Nearest(distance, normal);
}
