#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <memory>
#include <vector>

#include "core/error.h"
#include "export/export.h"
#include "support/temporary_folder.h"
#include "support/throws.h"

namespace clothsim {
namespace {

TEST(SavePng, ReadsBackToTheSamePixelsTopRowFirst) {
  const int width = 5, height = 3;
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < width * height * 3; ++i) rgb.push_back(static_cast<std::uint8_t>(i * 5));
  test::TemporaryFolder folder;
  savePng(folder / "a.png", width, height, rgb);

  int w = 0, h = 0, channels = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load((folder / "a.png").c_str(), &w, &h, &channels, 0), stbi_image_free);
  ASSERT_NE(pixels, nullptr);
  EXPECT_EQ(w, width);
  EXPECT_EQ(h, height);
  ASSERT_EQ(channels, 3);
  EXPECT_EQ(std::vector<std::uint8_t>(pixels.get(), pixels.get() + rgb.size()), rgb);
  EXPECT_EQ(folder.fileCount(), 1);
}

TEST(SavePng, NamesThePathThatItCannotWrite) {
  const std::vector<std::uint8_t> rgb(3, 0);
  const std::string message =
      test::messageThrownBy<InputOutputError>([&] { savePng("/nowhere/a.png", 1, 1, rgb); });
  EXPECT_NE(message.find("/nowhere/a.png"), std::string::npos) << message;
}

}  // namespace
}  // namespace clothsim
