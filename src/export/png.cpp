#include <cassert>

#include <stb/stb_image_write.h>

#include "core/error.h"
#include "core/files.h"
#include "export/export.h"

namespace clothsim {

void savePng(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb) {
  assert(rgb.size() == 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) &&
         "three bytes a pixel");
  std::string bytes;
  const auto append = [](void* target, void* data, int size) {
    static_cast<std::string*>(target)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &bytes, width, height, 3, rgb.data(), 3 * width) == 0)
    throw InputOutputError("cannot write '" + path.string() + "': a picture of " + std::to_string(width) +
                           " x " + std::to_string(height) + " pixels could not be encoded as PNG");
  writeFileAtomically(path, bytes);
}

}  // namespace clothsim
