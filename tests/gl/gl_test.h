// What every test that needs OpenGL stands on: one context for the whole program, and no error left behind by
// a test.
#pragma once

#include <gtest/gtest.h>

#include "gl/buffer.h"
#include "gl/context.h"

namespace clothsim {

// A missing context fails the test that asks: CI has llvmpipe, so nothing here is ever skipped.
inline const gl::ContextInfo& testContext() {
  static const gl::HeadlessContext context;
  gl::uninitialisedWord = 0xffffffffu;
  return context.info();
}

class GlTest : public ::testing::Test {
 protected:
  void SetUp() override { testContext(); }
  void TearDown() override { EXPECT_NO_THROW(gl::checkErrors("the end of the test")); }
};

}  // namespace clothsim
