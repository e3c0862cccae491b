// Spring forces along a row, computed in two ways.
#pragma once

#include <cstddef>

namespace trial {

struct Row {
  const float *x, *y, *z;  // of particles; one more than springs, and up to a vector behind it
  float *forceX, *forceY, *forceZ;
};

// Of springs that join each particle to the next one.
void forcesByHighway(const Row& row, std::ptrdiff_t springs, float stiffness, float restLength);

}  // namespace trial
