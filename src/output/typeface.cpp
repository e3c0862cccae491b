#include "output/typeface.h"

#include <imgui.h>

#include <filesystem>

namespace clothsim {
namespace {

// The first of these that is there.
const char* typefaceFile() {
  for (const char* path :
       {"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Medium.ttf",
        "/usr/share/fonts/truetype/roboto/Roboto-Medium.ttf",
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"}) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path;
  }
  return nullptr;
}

// Latin, and the marks of punctuation: dashes, ellipsis, minus.
constexpr ImWchar characters[] = {0x20, 0xff, 0x2010, 0x2026, 0x2212, 0x2212, 0};

}  // namespace

ImFont* addTypeface(ImFontAtlas& atlas, float size, bool crisp) {
  ImFontConfig config;
  if (crisp) config.OversampleH = config.OversampleV = 1;
  if (const char* path = typefaceFile()) return atlas.AddFontFromFileTTF(path, size, &config, characters);
  config.SizePixels = size;
  return atlas.AddFontDefault(&config);
}

}  // namespace clothsim
