#include <array>
#include <string_view>

#include "core/error.h"
#include "core/files.h"
#include "export/export.h"
#include "export/formats.h"

namespace clothsim {
namespace {

using Format = std::string (*)(const State&, const Cloth&);

struct Extension {
  std::string_view name;
  Format format;
};
constexpr std::array<Extension, 6> extensions{{
    {".csv", [](const State& state, const Cloth&) { return formatCsv(state); }},
    {".ply", formatPly},
    {".obj", [](const State& state, const Cloth& cloth) { return formatObj(state, cloth); }},
    {".glb", formatGlb},
    {".npz", [](const State& state, const Cloth& cloth) { return formatNpz(state, cloth); }},
    {".state", [](const State& state, const Cloth&) { return formatStateFile(state); }},
}};

// Null for an extension that no format has.
Format formatFor(const std::filesystem::path& path) {
  const std::string wanted = path.extension().string();
  for (const Extension& extension : extensions)
    if (extension.name == wanted) return extension.format;
  return nullptr;
}

}  // namespace

bool canSaveStateAs(const std::filesystem::path& path) { return formatFor(path) != nullptr; }

void saveState(const State& state, const Cloth& cloth, const std::filesystem::path& path) {
  const Format format = formatFor(path);
  if (format == nullptr)
    throw UsageError("cannot save '" + path.string() + "': its extension is '" + path.extension().string() +
                     "', expected " + std::string(STATE_EXTENSIONS));
  writeFileAtomically(path, format(state, cloth));
}

State loadState(const std::filesystem::path& path, const Cloth& cloth) {
  constexpr std::uintmax_t largestFile = std::uintmax_t{4} << 30;  // more than a sheet of 8192 x 8192 has
  return parseStateFile(readFile(path, largestFile), cloth.particleCount(), path.string(),
                        cloth.lists().triangles.size());
}

}  // namespace clothsim
