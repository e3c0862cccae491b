#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/files.h"
#include "core/fnv.h"
#include "export/export.h"
#include "export/formats.h"
#include "support/temporary_folder.h"
#include "support/throws.h"
#include "unit/export/small_cloth.h"

namespace clothsim {
namespace {

using test::messageThrownBy;

class StateFile : public testing::Test {
 protected:
  Cloth cloth_{test::smallScene()};
  State state_ = test::smallState(cloth_);
  std::string bytes_ = formatStateFile(state_);

  static std::string withChecksum(const std::string& bytes) {
    Fnv1a hash;
    hash.add(bytes);
    const std::uint64_t sum = hash.value();
    return bytes + std::string(reinterpret_cast<const char*>(&sum), sizeof sum);
  }
  std::string refusalOf(const std::string& bytes) {
    return messageThrownBy<InputOutputError>(
        [&] { (void)parseStateFile(bytes, cloth_.particleCount(), "a.state"); });
  }
};

TEST_F(StateFile, ReadsBackEveryBitThatWasWritten) {
  state_.positions[1].x = -0.0f;
  state_.velocities[2].y = std::bit_cast<float>(0x00000001u);  // the smallest denormal
  test::TemporaryFolder folder;
  saveState(state_, cloth_, folder / "a.state");
  const State back = loadState(folder / "a.state", cloth_);

  EXPECT_EQ(back.clock, state_.clock);
  EXPECT_EQ(back.integrator, state_.integrator);
  ASSERT_EQ(back.positions.size(), state_.positions.size());
  ASSERT_EQ(back.velocities.size(), state_.velocities.size());
  const std::size_t size = state_.positions.size() * sizeof(Particle4);
  EXPECT_EQ(std::memcmp(back.positions.data(), state_.positions.data(), size), 0);
  EXPECT_EQ(std::memcmp(back.velocities.data(), state_.velocities.data(), size), 0);
}

TEST_F(StateFile, IsRefusedWhenCutOffAnywhere) {
  for (std::size_t length = 0; length < bytes_.size(); ++length)
    EXPECT_THROW((void)parseStateFile(bytes_.substr(0, length), cloth_.particleCount(), "a.state"),
                 InputOutputError)
        << "of " << bytes_.size() << " bytes " << length << " were kept";
  EXPECT_NE(refusalOf(bytes_.substr(0, bytes_.size() - 1)).find("cut off"), std::string::npos);
}

TEST_F(StateFile, IsRefusedWhenAnyByteIsDamaged) {
  for (std::size_t place = 0; place < bytes_.size(); ++place) {
    std::string damaged = bytes_;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x10);
    EXPECT_THROW((void)parseStateFile(damaged, cloth_.particleCount(), "a.state"), InputOutputError)
        << "byte " << place;
  }
}

TEST_F(StateFile, IsRefusedWhenSomethingFollowsIt) {
  EXPECT_NE(refusalOf(bytes_ + "x").find("added to"), std::string::npos);
}

TEST_F(StateFile, OfAnotherSceneIsRefusedWithBothParticleCounts) {
  const std::string message =
      messageThrownBy<InputOutputError>([&] { (void)parseStateFile(bytes_, 2500, "runs/a.state"); });
  EXPECT_NE(message.find("runs/a.state"), std::string::npos) << message;
  EXPECT_NE(message.find("6 particles"), std::string::npos) << message;
  EXPECT_NE(message.find("2500"), std::string::npos) << message;
}

TEST_F(StateFile, SaysWherePinsAndMassesAreNotThoseOfTheScene) {
  State state = stateAtRest(cloth_);
  EXPECT_EQ(remarkOfState(state, cloth_), "");
  state.positions[1].w = 2 * state.positions[1].w + 1;
  EXPECT_NE(remarkOfState(state, cloth_).find("1 has another mass"), std::string::npos);
  state.positions[2].w = state.positions[2].w == 0 ? 1.0f : 0.0f;
  EXPECT_NE(remarkOfState(state, cloth_).find("1 particle is pinned there"), std::string::npos);
}

TEST_F(StateFile, OfALaterVersionIsRefusedWithBothVersions) {
  bytes_[8] = 6;
  EXPECT_NE(refusalOf(bytes_).find("version 6"), std::string::npos);
}

TEST_F(StateFile, IsNotMistakenForWhatIsNone) {
  EXPECT_NE(refusalOf("index,x,y,z,vx,vy,vz\n0,0,0,0,0,0,0\n").find("no state file"), std::string::npos);
}

TEST_F(StateFile, ThatDoesNotExistIsNamedInTheMessage) {
  const std::string message =
      messageThrownBy<InputOutputError>([&] { (void)loadState("/nowhere/a.state", cloth_); });
  EXPECT_NE(message.find("/nowhere/a.state"), std::string::npos) << message;
}

TEST_F(StateFile, WithAParticleThatIsNowhereIsRefused) {
  const State sound = state_;
  state_.positions[3].y = std::bit_cast<float>(0x7f800000u);
  EXPECT_NE(refusalOf(formatStateFile(state_)).find("place or velocity of particle 3 is inf"),
            std::string::npos);
  state_ = sound;
  state_.velocities[5].z = std::bit_cast<float>(0x7fc12345u);
  EXPECT_NE(refusalOf(formatStateFile(state_)).find("place or velocity of particle 5 is nan"),
            std::string::npos);
}

TEST_F(StateFile, KeepsWhatStepsOfSecondOrderLookBackAt) {
  state_.histories.assign(12, {1e-3f, 0, -2e-3f, 0});
  state_.histories[11].z = 0.25f;
  state_.usualSteps = 2;
  const State back = parseStateFile(formatStateFile(state_), 6, "a.state");
  ASSERT_EQ(back.histories.size(), 12u);
  EXPECT_EQ(std::memcmp(back.histories.data(), state_.histories.data(), 12 * sizeof(Particle4)), 0);
  EXPECT_EQ(back.usualSteps, 2u);
  state_.usualSteps = 3;
  EXPECT_NE(refusalOf(formatStateFile(state_)).find("3 usual steps"), std::string::npos);
  state_.usualSteps = 2;
  state_.histories[7].x = std::bit_cast<float>(0x7f800000u);
  EXPECT_NE(refusalOf(formatStateFile(state_)).find("changed of particle 3"), std::string::npos);
  state_.histories.pop_back();
  EXPECT_NE(refusalOf(formatStateFile(state_)).find("11 changes of the last step"), std::string::npos);
}

// Versions 1 and 2, put together by hand.
TEST_F(StateFile, OfAnOlderVersionIsReadAndLeavesTheStepLengthToTheScene) {
  const std::string older = bytes_.substr(0, 8) + '\1' + bytes_.substr(9, 23) + bytes_.substr(56, 32 * 6);
  const State first = parseStateFile(withChecksum(older), 6, "a.state");
  std::string lists = older + std::string("\0\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0\4\0\0\0", 20);
  lists[8] = '\2';
  const State second = parseStateFile(withChecksum(lists), 6, "a.state");
  for (const State& state : {first, second}) {
    EXPECT_EQ(state.clock, (StepClock{12345678901, 0, 0, 0}));
    EXPECT_EQ(std::memcmp(state.velocities.data(), state_.velocities.data(), 6 * sizeof(Particle4)), 0);
  }
  EXPECT_EQ(second.offPath, std::vector<std::uint32_t>{4});
}

TEST_F(StateFile, IsRefusedWhenItsTimeIsNone) {
  const auto refusal = [&](std::size_t place, double value) {
    std::string bytes = bytes_.substr(0, bytes_.size() - 8);
    std::memcpy(bytes.data() + place, &value, sizeof value);
    return refusalOf(withChecksum(bytes));
  };
  for (const std::size_t place : {32, 40})
    for (const double value : {-1.0, std::nan(""), HUGE_VAL})
      EXPECT_NE(refusal(place, value).find("its time is no time"), std::string::npos)
          << place << ' ' << value;
  EXPECT_NE(refusal(48, 1.0).find("its time is no time"), std::string::npos) << "an origin behind the step";
}

TEST_F(StateFile, WithAnInverseMassThatNoBodyHasIsRefused) {
  for (const auto& [mass, found] : {std::pair{-1.0f, "-1"},
                                    {std::bit_cast<float>(0x7f800000u), "inf"},
                                    {std::bit_cast<float>(0x7fc00000u), "nan"}}) {
    state_.positions[4].w = mass;
    const std::string message = refusalOf(formatStateFile(state_));
    EXPECT_NE(message.find(std::string("the inverse mass of particle 4 is ") + found), std::string::npos)
        << message;
  }
  state_.positions[4].w = 0;
  EXPECT_EQ(parseStateFile(formatStateFile(state_), 6, "a.state").positions[4].w, 0) << "a pinned one";
}

class HandledStateFile : public StateFile {
 protected:
  HandledStateFile() {
    state_.cuts = {0, 1, 2, 63, 32, 0};
    state_.offPath = {1, 5};
    bytes_ = formatStateFile(state_);
  }
  // The bytes with one of them changed and a checksum that fits.
  std::string forged(std::size_t place, char value) {
    std::string bytes = bytes_.substr(0, bytes_.size() - 8);
    bytes[place] = value;
    return withChecksum(bytes);
  }
};

TEST_F(HandledStateFile, ReadsBackCutsAndPinsByHand) {
  const State back = parseStateFile(bytes_, cloth_.particleCount(), "a.state");
  EXPECT_EQ(back.cuts, state_.cuts);
  EXPECT_EQ(back.offPath, state_.offPath);
  EXPECT_EQ(back.clock, state_.clock);
  EXPECT_EQ(bytes_.size(), 56 + 32 * 6 + 8 + 6 + 8 + 2 * 4 + 8u);
}

TEST_F(HandledStateFile, IsRefusedWhenCutOffOrDamagedAnywhere) {
  for (std::size_t place = 0; place < bytes_.size(); ++place) {
    EXPECT_THROW((void)parseStateFile(bytes_.substr(0, place), 6, "a.state"), InputOutputError) << place;
    std::string damaged = bytes_;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x10);
    EXPECT_THROW((void)parseStateFile(damaged, 6, "a.state"), InputOutputError) << place;
  }
  EXPECT_NE(refusalOf(bytes_ + "x").find("added to"), std::string::npos);
}

TEST_F(HandledStateFile, IsRefusedWhenItsListsMakeNoSense) {
  const std::size_t cuts = 56 + 32 * 6;
  EXPECT_NE(refusalOf(forged(cuts + 8, 64)).find("the cuts of particle 0 are 64"), std::string::npos);
  EXPECT_NE(refusalOf(forged(cuts + 8 + 6 + 8, 5)).find("ascending"), std::string::npos);
  EXPECT_NE(refusalOf(forged(cuts + 8 + 6 + 8 + 4, 6)).find("below 6"), std::string::npos);
  EXPECT_NE(refusalOf(forged(cuts + 7, '\x7f')).find("cut off"), std::string::npos) << "a count beyond all";
  EXPECT_NE(refusalOf(forged(cuts, 5)), "");
}

// Version 4.
TEST_F(StateFile, HoldsWhatFrictionRemembersWhereThereIsSome) {
  state_.elasticSlips.assign(6, {});
  state_.elasticSlips[4] = {1e-5f, 0, -2e-5f, 0.25f};
  const std::string bytes = formatStateFile(state_);
  EXPECT_EQ(bytes.size(), bytes_.size() + 8 + 16 * 6 + 8);
  EXPECT_EQ(bytes[8], '\4');
  const State back = parseStateFile(bytes, 6, "a.state");
  ASSERT_EQ(back.elasticSlips.size(), 6u);
  EXPECT_EQ(std::memcmp(back.elasticSlips.data(), state_.elasticSlips.data(), 16 * 6), 0);
  state_.elasticSlips[5].y = std::bit_cast<float>(0x7fc00000u);
  EXPECT_NE(refusalOf(formatStateFile(state_)).find("the elastic slip of particle 5"), std::string::npos);
  state_.elasticSlips.resize(2);
  EXPECT_NE(refusalOf(formatStateFile(state_)).find("elastic slips of 2 particles"), std::string::npos);
}

TEST_F(StateFile, HoldsWhatFrictionRemembersOfPairs) {
  state_.pairSlips = {{7, {0, 1, 2, 3}, 1e-5f, 0, 0, 0.5f}, {7, {0, 2, 3, 4}, 0, -1e-6f, 0, 0.25f}};
  const std::string bytes = formatStateFile(state_);
  EXPECT_EQ(bytes.size(), bytes_.size() + 8 + 8 + 36 * 2);
  const State back = parseStateFile(bytes, 6, "a.state");
  ASSERT_EQ(back.pairSlips.size(), 2u);
  EXPECT_EQ(std::memcmp(back.pairSlips.data(), state_.pairSlips.data(), 36 * 2), 0);
  state_.pairSlips[1].place = 6;
  EXPECT_NE(refusalOf(formatStateFile(state_)).find("ascending"), std::string::npos);
  state_.pairSlips[1] = {8, {0, 2, 3, 4}, 0, std::bit_cast<float>(0x7f800000u), 0, 0};
  EXPECT_NE(refusalOf(formatStateFile(state_)).find("the elastic slip of pair 1"), std::string::npos);
}

// The layout in formats.h, read by hand.
TEST_F(StateFile, HasTheDocumentedLayout) {
  ASSERT_EQ(bytes_.size(), 56 + 32 * 6 + 8 + 8 + 8u);
  EXPECT_EQ(bytes_.substr(0, 8), "clothsim");
  EXPECT_EQ(bytes_.substr(8, 4), std::string("\3\0\0\0", 4));
  EXPECT_EQ(bytes_.substr(12, 4), std::string("\1\0\0\0", 4));                  // euler
  EXPECT_EQ(bytes_.substr(16, 8), std::string("\6\0\0\0\0\0\0\0", 8));          // six particles
  EXPECT_EQ(bytes_.substr(24, 8), std::string("\x35\x1c\xdc\xdf\2\0\0\0", 8));  // 12345678901
  double stepLength = 0, originTime = 0;
  std::memcpy(&stepLength, bytes_.data() + 32, 8);
  std::memcpy(&originTime, bytes_.data() + 40, 8);
  EXPECT_EQ(stepLength, 0.25);
  EXPECT_EQ(originTime, 7.5);
  EXPECT_EQ(bytes_.substr(48, 8), std::string("\3\0\0\0\0\0\0\0", 8));
  float y = 0;
  std::memcpy(&y, bytes_.data() + 56 + 4, 4);
  EXPECT_EQ(y, state_.positions[0].y);
}

}  // namespace
}  // namespace clothsim
