// All points within `radius` of the box with corners (+-sizeX, +-sizeY, +-sizeZ).
LAW Nearest nearestOnBox(ColliderParams box, vec3 p) {
  const real zero = real(0.0), one = real(1.0);
  vec3 magnitude = vec3(p.x < zero ? -p.x : p.x, p.y < zero ? -p.y : p.y, p.z < zero ? -p.z : p.z);
  precise vec3 beyond = magnitude - vec3(box.sizeX, box.sizeY, box.sizeZ);
  bool beyondX = zero < beyond.x, beyondY = zero < beyond.y, beyondZ = zero < beyond.z;
  bool outside = beyondX || beyondY || beyondZ;
  vec3 d = vec3(beyondX ? beyond.x : zero, beyondY ? beyond.y : zero, beyondZ ? beyond.z : zero);
  precise real lengthSquared = sumOfProducts(d, d);
  precise real inverseLength = inverseSquareRoot(lengthSquared);
  precise vec3 outward = inverseLength * d;
  precise real toEdge = lengthSquared * inverseLength;
  // Within the inner box the nearest face counts.
  bool faceX = !(beyond.x < beyond.y) && !(beyond.x < beyond.z);
  bool faceY = !faceX && !(beyond.y < beyond.z);
  bool faceZ = !faceX && !faceY;
  real toFace = faceX ? beyond.x : faceY ? beyond.y : beyond.z;
  vec3 face = vec3(faceX ? one : zero, faceY ? one : zero, faceZ ? one : zero);
  precise real distance = (outside ? toEdge : toFace) - box.radius;
  vec3 normal = outside ? outward : face;
  return Nearest(distance, vec3(p.x < zero ? -normal.x : normal.x, p.y < zero ? -normal.y : normal.y,
                                p.z < zero ? -normal.z : normal.z));
}
