#include "solver/state.h"

#include <gtest/gtest.h>

namespace clothsim {
namespace {

State twoParticles() {
  State state;
  state.positions = {{1, 2, 3, 9}, {-1, 0.5f, 0, 9}};
  state.velocities = {{4, 5, 6, 0}, {0, 0, -2, 0}};
  return state;
}

// By an independent implementation:
//   python3 -c "import struct; h=0xcbf29ce484222325
//   for b in struct.pack('<12f',1,2,3,4,5,6,-1,.5,0,0,0,-2): h=((h^b)*0x100000001b3)%2**64
//   print('%016x'%h)"
TEST(StateHash, IsFnv1aOverPositionAndVelocityOfEachParticleInTurn) {
  EXPECT_EQ(hashText(stateHash(twoParticles())), "0c54ebcd31ac6f68");
}

TEST(StateHash, LeavesMassStepAndIntegratorAside) {
  State other = twoParticles();
  other.positions[0].w = 0;
  other.clock.step = 7;
  other.integrator = Integrator::euler;
  EXPECT_EQ(stateHash(other), stateHash(twoParticles()));
}

TEST(StateHash, SeesTheSignOfAZero) {
  State other = twoParticles();
  other.velocities[1].x = -0.0f;
  EXPECT_NE(stateHash(other), stateHash(twoParticles()));
}

TEST(StateHash, OfNoParticlesIsFnvsOffset) { EXPECT_EQ(hashText(stateHash(State{})), "cbf29ce484222325"); }

TEST(HashText, KeepsLeadingZeros) { EXPECT_EQ(hashText(0x00000000000000ffu), "00000000000000ff"); }

}  // namespace
}  // namespace clothsim
