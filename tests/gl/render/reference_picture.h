// Stored pictures, and what a broken shader does to the comparison with them.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/files.h"
#include "export/export.h"
#include "gl/render/picture.h"
#include "render/textures.h"
#include "support/command.h"
#include "support/temporary_folder.h"

namespace clothsim::test {

constexpr double TOLERANCE = 1.0;  // of 255, mean over the picture

inline std::filesystem::path referenceFile(const std::string& name) {
  return std::filesystem::path(TEST_DATA) / "gl/render/references" / (name + ".png");
}

inline Image loadReference(const std::string& name) {
  const LoadedPng png = loadPng(referenceFile(name));
  Image image{png.width, png.height, {}};
  for (std::size_t i = 0; i < png.rgba.size(); i += 4)
    for (std::size_t channel = 0; channel < 3; ++channel)
      image.rgb.push_back(static_cast<std::uint8_t>(png.rgba[i + channel] >> 8));
  return image;
}

// References were stored on llvmpipe (Mesa 22.3.6) and looked at; CLOTHSIM_STORE_REFERENCES=1 stores them
// anew.
inline double differenceFromReference(const std::string& name, const Image& image) {
  if (std::getenv("CLOTHSIM_STORE_REFERENCES") != nullptr)
    savePng(referenceFile(name), image.width, image.height, image.rgb);
  return meanDifference(image, loadReference(name));
}

// A copy of shaders and assets, for a process that is to look for its own there: a program does so once.
struct ResourceCopy {
  TemporaryFolder root;

  ResourceCopy() {
    for (const char* folder : {"shaders", "assets"})
      std::filesystem::copy(std::filesystem::path(SOURCE_ROOT) / folder, root / folder,
                            std::filesystem::copy_options::recursive);
  }
  // False when `from` is not there: the shader has changed, so must the test.
  [[nodiscard]] bool change(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = readFile(root / ("shaders/" + file));
    const std::size_t place = text.find(from);
    if (place == std::string::npos) return false;
    std::ofstream(root / ("shaders/" + file)) << text.replace(place, from.size(), to);
    return true;
  }
  // Runs tests of this program there.
  [[nodiscard]] CommandResult runTests(const std::string& filter) const {
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    return runCommand("CLOTHSIM_ROOT='" + root.path().string() + "' '" + self + "' --gtest_filter='" +
                      filter + "' 2>&1");
  }
};

}  // namespace clothsim::test
