#include "viewer/viewer_facts.h"
#include "core/formatted.h"

#include <algorithm>
#include <cstdio>

#include "gl/context.h"
#include "render/quality.h"

namespace clothsim {
namespace {

// 9216 -> "9,216"
std::string withCommas(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

// "gpu", "llvmpipe (LLVM 15.0.6, 256 bits)" -> "GPU: llvmpipe"; "gpu", "NVIDIA H200/PCIe/SSE2" -> "GPU:
// NVIDIA H200"; "cpu", "CPU, 2 threads" -> "CPU: 2 threads"
std::string backendText(const Solver& solver) {
  std::string device = solver.device();
  if (device.starts_with("CPU, ")) device.erase(0, 5);
  device.erase(std::min(device.size(), device.find_first_of("(/")));
  return (solver.backend() == "gpu" ? "GPU: " : "CPU: ") + device;
}

// "50 x 50"; several cloths are separated by commas, "5 of 8 x 11" where they are alike.
std::string gridSizes(const Cloth& cloth) {
  std::vector<std::pair<std::string, int>> sizes;
  for (const Piece& piece : cloth.pieces()) {
    const std::string size =
        piece.isMesh ? "mesh of " + withCommas(piece.endTriangle - piece.firstTriangle) + " triangles"
                     : std::to_string(piece.columns) + " \u00d7 " + std::to_string(piece.rows);
    if (!sizes.empty() && sizes.back().first == size)
      ++sizes.back().second;
    else
      sizes.emplace_back(size, 1);
  }
  std::string text;
  for (const auto& [size, count] : sizes)
    text += (text.empty() ? "" : ", ") + (count > 1 ? std::to_string(count) + " of " : "") + size;
  return text;
}

OverlayFacts::Row speedRow(const OpenScene& open, const SpeedMeter& meter, double tempo) {
  const double factor = meter.realTimeFactor();
  if (!meter.isMeasured()) return {"speed", "measuring", false, true};
  const bool slow = factor < 0.95 * tempo;
  // A software renderer is the CPU, and slower than the CPU backend.
  const bool cpuMayBeFaster = slow && gl::currentContextInfo().software && open.backend() == "gpu";
  return {"speed",
          formatted(slow || tempo < 1 ? "%.2f" : "%.1f", factor) + "\u00d7 real time" +
              (tempo < 1 ? formatted(" of %g\u00d7", tempo) : "") +
              (cpuMayBeFaster ? ", B: try the CPU" : ""),
          slow, true};
}

}  // namespace

std::string viewerTitle(const OpenScene& open, const SpeedMeter& meter, bool paused) {
  const double rate = meter.framesPerSecond();
  return open.name() + " - " + open.backend() +
         (paused     ? " - paused at frame " + std::to_string(open.facts().frameSinceStart)
          : rate > 0 ? formatted(" - %.0f fps", rate)
                     : "") +
         " - clothsim";
}

OverlayFacts viewerFacts(const OpenScene& open, const SpeedMeter& meter, bool paused, double tempo,
                         std::optional<int> exposures, const std::vector<Warning>& warnings) {
  const Simulation& simulation = open.session().simulation();
  OverlayFacts facts;
  facts.title = open.name();
  facts.rows = {{"backend", backendText(simulation.solver()), false, true},
                {"cloth", gridSizes(simulation.cloth()) + " = " +
                              withCommas(simulation.cloth().particleCount()) + " particles"},
                {"integrator", integratorName(open.scene().solver.integrator), false, true},
                {"time", formatted("%.2f s", open.time())}};
  const SessionFacts now = open.facts();
  if (paused)
    facts.rows.push_back({"speed",
                          now.frame < now.newestFrame ? "in the past (P: resume)" : "paused (P: resume)",
                          true, true});
  else
    facts.rows.push_back(speedRow(open, meter, tempo));
  if (meter.isMeasured() && !paused)
    facts.rows.push_back({"display", formatted("%.0f frames/s", meter.framesPerSecond())});
  if (exposures)
    facts.rows.push_back(
        {"picture", "refined " + std::to_string(*exposures) + " of " + std::to_string(FINAL_EXPOSURES)});
  for (const Warning& warning : warnings) facts.rows.push_back({warning.kind, warning.brief, true, true});
  facts.rows.push_back({"help", "F1 lists the keys", false, true});
  return facts;
}

}  // namespace clothsim
