#include <array>
#include <cmath>
#include <string_view>

#include "core/error.h"
#include "core/files.h"
#include "export/export.h"
#include "export/formats.h"
#include "solver/state.h"

namespace clothsim {
namespace {

using Format = std::string (*)(const State&, const Cloth&, const Scene*);

struct Extension {
  std::string_view name;
  Format format;
};
constexpr std::array<Extension, 6> extensions{{
    {".csv", [](const State& state, const Cloth&, const Scene*) { return formatCsv(state); }},
    {".ply", [](const State& state, const Cloth& cloth, const Scene*) { return formatPly(state, cloth); }},
    {".obj", [](const State& state, const Cloth& cloth, const Scene*) { return formatObj(state, cloth); }},
    {".glb", formatGlb},
    {".npz", [](const State& state, const Cloth& cloth, const Scene*) { return formatNpz(state, cloth); }},
    {".state", [](const State& state, const Cloth&, const Scene*) { return formatStateFile(state); }},
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

void saveState(const State& state, const Cloth& cloth, const std::filesystem::path& path,
               const Scene* looksOf) {
  const Format format = formatFor(path);
  if (format == nullptr)
    throw UsageError("cannot save '" + path.string() + "': its extension is '" + path.extension().string() +
                     "', expected " + std::string(STATE_EXTENSIONS));
  writeFileAtomically(path, format(state, cloth, looksOf));
}

State loadState(const std::filesystem::path& path, const Cloth& cloth) {
  constexpr std::uintmax_t largestFile = std::uintmax_t{4} << 30;  // more than a sheet of 8192 x 8192 has
  return parseStateFile(readFile(path, largestFile), cloth.particleCount(), path.string(),
                        cloth.lists().triangles.size());
}

std::string remarkOfState(const State& state, const Cloth& cloth) {
  const State atStart = stateAtRest(cloth);
  std::size_t pins = 0, masses = 0;
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const float own = state.positions[i].w, ofScene = atStart.positions[i].w;
    if ((own == 0) != (ofScene == 0))
      ++pins;
    else if (std::abs(own - ofScene) > 1e-5f * ofScene)
      ++masses;
  }
  if (pins + masses == 0) return "";
  const auto many = [](std::size_t count, const char* one, const char* several) {
    return count == 0 ? std::string() : std::to_string(count) + (count == 1 ? one : several);
  };
  return "the state's own pins and masses are kept: " +
         many(pins, " particle is pinned there and not in the scene, or the other way round",
              " particles are pinned there and not in the scene, or the other way round") +
         (pins > 0 && masses > 0 ? ", " : "") +
         many(masses, " has another mass than in the scene", " have another mass than in the scene");
}

}  // namespace clothsim
