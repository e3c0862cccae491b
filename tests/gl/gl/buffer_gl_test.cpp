#include "gl/buffer.h"

#include <array>
#include <numeric>

#include "gl/gl_test.h"

namespace clothsim {
namespace {

using BufferTest = GlTest;

TEST_F(BufferTest, ComesBackFromTheGpuAsItWentUp) {
  std::vector<float> numbers(1000);
  std::iota(numbers.begin(), numbers.end(), 0.5f);
  const gl::Buffer<float> buffer("numbers", numbers);
  EXPECT_EQ(buffer.download(), numbers);
}

TEST_F(BufferTest, AnUploadReplacesOnlyTheElementsItNames) {
  gl::Buffer<int> buffer("six", std::array{0, 1, 2, 3, 4, 5});
  buffer.upload(std::array{20, 30}, 2);
  EXPECT_EQ(buffer.download(), (std::vector{0, 1, 20, 30, 4, 5}));
}

TEST_F(BufferTest, OfNoElementsIsValidAndEmpty) {
  const gl::Buffer<int> buffer("none", std::size_t{0});
  EXPECT_NE(buffer.name(), 0u);
  EXPECT_TRUE(buffer.download().empty());
}

TEST_F(BufferTest, MovingLeavesOneOwner) {
  gl::Buffer<int> first("one", std::array{7});
  const GLuint name = first.name();
  gl::Buffer<int> second = std::move(first);
  EXPECT_EQ(second.name(), name);
  EXPECT_EQ(second.download(), std::vector{7});
}

TEST_F(BufferTest, CarriesItsLabelForDebuggers) {
  const gl::Buffer<int> buffer("positions", std::array{1});
  std::array<char, 32> label{};
  glGetObjectLabel(GL_BUFFER, buffer.name(), static_cast<GLsizei>(label.size()), nullptr, label.data());
  EXPECT_STREQ(label.data(), "positions");
}

}  // namespace
}  // namespace clothsim
