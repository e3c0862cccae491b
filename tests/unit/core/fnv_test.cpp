#include "core/fnv.h"

#include <gtest/gtest.h>

namespace clothsim {
namespace {

std::uint64_t hashOf(std::string_view text) {
  Fnv1a hash;
  hash.add(text);
  return hash.value();
}

// The vectors of the FNV authors' own test suite (draft-eastlake-fnv, section on FNV-1a 64 bit).
TEST(Fnv1a, GivesThePublishedValues) {
  EXPECT_EQ(hashOf(""), 0xcbf29ce484222325u);
  EXPECT_EQ(hashOf("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(hashOf("foobar"), 0x85944171f73967e8u);
}

TEST(Fnv1a, TakesTheBytesOfAFloatLowestFirst) {
  Fnv1a ofFloat;
  ofFloat.add(1.0f);  // 0x3f800000
  EXPECT_EQ(ofFloat.value(), hashOf(std::string_view("\x00\x00\x80\x3f", 4)));
}

}  // namespace
}  // namespace clothsim
