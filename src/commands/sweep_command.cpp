// `sweep`: simulates a scene with every combination of some values and puts the pictures on one sheet, with a
// table of measures.
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "commands/print_json.h"
#include "core/error.h"
#include "core/files.h"
#include "core/formatted.h"
#include "core/interrupt.h"
#include "core/progress.h"
#include "export/export.h"
#include "gl/context.h"
#include "output/contact_sheet.h"
#include "scene_io/describe.h"
#include "scene_io/variations.h"
#include "simulation/gpu/simulation_renderer.h"
#include "simulation/gpu/solvers.h"
#include "simulation/run_summary.h"

namespace clothsim {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::ordered_json;

// These two can be varied although they are not keys of a scene.
constexpr const char *frameWord = "frame", *resolutionWord = "resolution";
constexpr int longestSide = 16'384;  // of the sheet [pixels]

int parseFrame(const std::string& text) {
  int frame = -1;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), frame);
  if (code != std::errc() || end != text.data() + text.size() || frame < 0 || frame > 10'000'000)
    throw UsageError("--vary frame=" + text + ": expected the number of a frame, 0 to 10000000");
  return frame;
}

// The picture of a cell: its scene differs from that of the simulation in render and camera keys only.
struct Shot {
  std::size_t cell;
  Shared<Scene> scene;
};

// One simulation and the pictures to take of it, by frame.
struct PlannedRun {
  SceneOptions options;
  std::map<int, std::vector<Shot>> shots;
  [[nodiscard]] const Shared<Scene>& sharedScene() const { return shots.begin()->second.front().scene; }
  [[nodiscard]] const Scene& scene() const { return *sharedScene(); }
  [[nodiscard]] int lastFrame() const { return shots.rbegin()->first; }
};

// Whether a key changes only the picture and not the simulation.
bool isLook(const std::string& key) { return key.starts_with("render") || key.starts_with("camera"); }

bool varies(const SweepTable& table, const std::string& beginning) {
  return std::any_of(table.variations().begin(), table.variations().end(),
                     [&](const Variation& variation) { return variation.key.starts_with(beginning); });
}

void checkFrames(const SweepOptions& options, const SweepTable& table) {
  const bool variesFrame = varies(table, frameWord);
  if (variesFrame && options.frames)
    throw UsageError("--frames and --vary frame=... both say which frame to show; give one of them");
  if (!variesFrame && !options.frames) throw UsageError("--frames is required, or --vary frame=30,60,90");
}

// A value that is fixed beside --vary would be ignored.
void checkVaried(const SweepOptions& options, const SweepTable& table) {
  const auto isSet = [&](const std::string& key) -> std::string {
    if (key == resolutionWord && options.scene.resolution) return "--resolution";
    if (key == "render.shader" && !options.shader.empty()) return "--shader";
    const auto& settings = options.scene.settings;
    const bool isAmong = std::any_of(settings.begin(), settings.end(), [&](const std::string& setting) {
      return setting.starts_with(key + "=");
    });
    return isAmong ? "--set " + key + "=..." : "";
  };
  for (const Variation& variation : table.variations())
    if (const std::string other = isSet(variation.key); !other.empty())
      throw UsageError(other + " and --vary " + variation.key + "=... both set it; give one of them");
}

// Reads every scene before any is simulated, so that a mistake in the last one is reported at once.
std::vector<PlannedRun> planRuns(const SweepOptions& options, const SweepTable& table) {
  std::vector<PlannedRun> runs;
  std::map<std::vector<std::string>, std::size_t> known;
  std::vector<std::string> remarks;
  for (std::size_t cell = 0; cell < table.cells(); ++cell) {
    SceneOptions chosen = options.scene;
    int frame = options.frames.value_or(0);
    std::vector<std::string> choice;  // what the simulation depends on
    for (std::size_t i = 0; i < table.variations().size(); ++i) {
      const std::string &key = table.variations()[i].key, &value = table.value(cell, i);
      if (key == frameWord) {
        frame = parseFrame(value);
        continue;
      }
      if (!isLook(key)) choice.push_back(value);
      if (key == resolutionWord)
        chosen.resolution = parseSize(value, "--vary resolution");
      else
        chosen.varied.push_back(key + "=" + value);
    }
    RemarkedScene read = readScene(chosen);
    if (!options.shader.empty()) read.scene.render.shader = options.shader;
    for (const std::string& remark : read.remarks)
      if (std::find(remarks.begin(), remarks.end(), remark) == remarks.end()) remarks.push_back(remark);
    const auto [place, isNew] = known.emplace(choice, runs.size());
    if (isNew) runs.push_back({chosen, {}});
    runs[place->second].shots[frame].push_back({cell, std::move(read.scene)});
  }
  for (const std::string& remark : remarks) std::cerr << "clothsim: " << remark << '\n';
  return runs;
}

// The cameras by cell. All pictures are taken with one camera so that they can be compared: the one that
// stands farthest away. When the sweep varies the camera, each cell has its own.
std::vector<Camera> placeCameras(const SweepOptions& options, const SweepTable& table,
                                 const std::vector<PlannedRun>& runs) {
  const double aspect = static_cast<double>(options.width) / options.height;
  std::map<std::size_t, Camera> places;
  for (const PlannedRun& planned : runs) {
    const Cloth cloth(planned.scene());
    for (const auto& [frame, shots] : planned.shots)
      for (const Shot& shot : shots) places.emplace(shot.cell, Camera(*shot.scene, cloth, aspect));
  }
  const auto distance = [](const Camera& camera) { return glm::length(camera.eye() - camera.target()); };
  const auto farthest = std::max_element(places.begin(), places.end(), [&](const auto& a, const auto& b) {
    return distance(a.second) < distance(b.second);
  });
  std::vector<Camera> cameras;
  for (const auto& [cell, own] : places) {
    cameras.push_back(varies(table, "camera") ? own : farthest->second);
    cameras.back().orbit(options.view.right * radians, options.view.up * radians);
    cameras.back().zoom(1 / options.view.zoom);
  }
  return cameras;
}

struct Cell {
  SheetPicture picture;
  ordered_json measures;
};

// Simulates one combination and fills the cells that show it.
class SweepRun {
 public:
  SweepRun(const SweepOptions& options, const std::string& backend, const PlannedRun& planned,
           const std::vector<Camera>& cameras)
      : options_(options),
        planned_(planned),
        cameras_(cameras),
        simulation_(planned.sharedScene(), backend, makeSolver),
        renderer_(simulation_, {}) {
    summary_.watchesEnergy = true;
    summary_.add(simulation_);
  }

  // `atFrame` is called after every frame.
  template <class AtFrame>
  void run(std::vector<Cell>& cells, AtFrame atFrame) {
    show(cells);
    while (frame_ < planned_.lastFrame()) {
      stopIfInterrupted();
      const Clock::time_point start = Clock::now();
      simulation_.stepFrame();
      simulation_.finish();
      summary_.seconds += std::chrono::duration<double>(Clock::now() - start).count();
      if ((divergence_ = simulation_.checkFrame())) break;
      summary_.add(simulation_);
      ++frame_;
      show(cells);
      atFrame(frame_);
    }
    if (divergence_) showDivergence(cells);
    print(warnings(), which().empty() ? "" : which() + ": ");
  }
  [[nodiscard]] bool blewUp() const { return divergence_.has_value(); }
  [[nodiscard]] std::vector<Warning> warnings() const { return summary_.watch.warnings(planned_.scene()); }

 private:
  void show(std::vector<Cell>& cells) {
    const auto found = planned_.shots.find(frame_);
    if (found == planned_.shots.end()) return;
    for (const Shot& shot : found->second) cells[shot.cell] = cell(shot, frame_);
  }

  // Fills the cells of the frames after the divergence.
  void showDivergence(std::vector<Cell>& cells) {
    for (const auto& [frame, shots] : planned_.shots)
      for (const Shot& shot : shots)
        if (frame > frame_) cells[shot.cell] = cell(shot, frame);
    std::cerr << "clothsim: " << which() << " blew up "
              << divergenceText(*divergence_, simulation_.cloth(), planned_.scene()) << '\n';
  }

  // The varied settings.
  [[nodiscard]] std::string which() const {
    std::string text;
    for (const std::string& setting : planned_.options.varied) text += (text.empty() ? "" : ", ") + setting;
    return text;
  }

  Cell cell(const Shot& shot, int wantedFrame) {
    Cell cell;
    cell.measures = measures(wantedFrame);
    renderer_.renderer().configure(shot.scene);
    cell.picture.image = renderer_.picture(cameras_[shot.cell], options_.width, options_.height);
    if (wantedFrame > frame_) {
      cell.picture.alert = "blew up in frame " + std::to_string(frame_ + 1);
      cell.picture.caption =
          frame_ == 0 ? "shown as it began" : "shown as it was in frame " + std::to_string(frame_);
    } else {
      cell.picture.caption = "stretch " + formatted("%.1f", 100 * summary_.measures.maxStrain) +
                             " %,  lowest point " + formatted("%.3f", summary_.measures.minY) + " m";
    }
    return cell;
  }

  ordered_json measures(int wantedFrame) {
    const Scene& scene = planned_.scene();
    const bool isSound = wantedFrame == frame_;
    ordered_json json = ordered_json::object();
    json["frames"] = frame_;
    json["finite"] = isSound;
    json["divergence"] = isSound ? ordered_json(nullptr)
                                 : ordered_json(divergenceText(*divergence_, simulation_.cloth(), scene));
    json["backend"] = simulation_.solver().backend();
    json["device"] = simulation_.solver().device();
    json["particles"] = simulation_.cloth().particleCount();
    json["steps"] = frame_ * static_cast<std::int64_t>(scene.solver.simulationSteps);
    json["dt"] = stepLength(scene.solver);
    json["sim_seconds"] = frame_ / scene.solver.framesPerSec;
    json["seconds"] = summary_.seconds;
    json["ms_per_frame"] =
        frame_ > 0 ? ordered_json(1000 * summary_.seconds / frame_) : ordered_json(nullptr);
    summary_.write(json, simulation_);
    json["unconverged_steps"] = summary_.convergence.unconvergedSteps;
    json["last_update"] = summary_.convergence.lastUpdate;
    json["finite"] = isSound;
    return json;
  }

  const SweepOptions& options_;
  const PlannedRun& planned_;
  const std::vector<Camera>& cameras_;
  Simulation simulation_;
  SimulationRenderer renderer_;
  RunSummary summary_;
  int frame_ = 0;  // the last sound one
  std::optional<Divergence> divergence_;
};

// A key as `clothsim describe` lists it: without the number of the collider or the cloth.
std::string listedKey(const std::string& typed) {
  const std::size_t list = typed.find('.');
  const std::string first = typed.substr(0, list);
  if (list == std::string::npos) return typed;
  if (first == "sphere" || first == "plane") return "colliders[]" + typed.substr(list);
  const std::size_t number = typed.find_first_not_of("0123456789", list + 1);
  if (number == std::string::npos || number == list + 1 || typed[number] != '.') return typed;
  if (first == "colliders") return "colliders[]" + typed.substr(number);
  return first == "cloths" ? "cloth" + typed.substr(number) : typed;
}

// The unit of a key that was typed; "" for none.
std::string unitOf(const std::string& typed, const std::vector<FieldInfo>& fields) {
  const auto found =
      std::find_if(fields.begin(), fields.end(),
                   [key = listedKey(typed)](const FieldInfo& field) { return field.path == key; });
  return found == fields.end() ? "" : found->unit;
}

SheetHeading headingOf(const Variation& variation, const std::string& value,
                       const std::vector<FieldInfo>& fields) {
  double number = 0;
  const auto [end, code] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool isNumber = code == std::errc() && end == value.data() + value.size();
  const std::string unit = isNumber ? unitOf(variation.key, fields) : "";
  return {variation.key, unit.empty() ? value : value + " " + unit};
}

std::string subtitleOf(const SweepOptions& options, const std::vector<PlannedRun>& runs) {
  std::string text;
  if (options.frames) {
    const double rate = runs.front().scene().solver.framesPerSec;
    text = "after " + std::to_string(*options.frames) + (*options.frames == 1 ? " frame" : " frames");
    if (std::all_of(runs.begin(), runs.end(),
                    [&](const PlannedRun& planned) { return planned.scene().solver.framesPerSec == rate; }))
      text += " (" + formatted("%.2f", *options.frames / rate) + " s)";
  }
  for (const std::string& setting : options.scene.settings)
    if (!isLook(setting)) text += (text.empty() ? "" : ", ") + setting;
  return text;
}

// The sheet without its pictures.
ContactSheet makeSheet(const SweepOptions& options, const SweepTable& table,
                       const std::vector<PlannedRun>& runs) {
  const std::vector<FieldInfo> fields = describeFields();
  const Scene& scene = runs.front().scene();
  ContactSheet sheet;
  sheet.title = scene.name.empty() ? std::filesystem::path(options.scene.scene).stem().string() : scene.name;
  sheet.subtitle = subtitleOf(options, runs);
  sheet.columnCount = table.columns();
  sheet.pictureWidth = options.width;
  sheet.pictureHeight = options.height;
  sheet.pictures.resize(table.cells());
  if (table.isWrapped()) return sheet;
  for (std::size_t column = 0; column < table.columns(); ++column)
    sheet.columns.push_back(headingOf(table.variations()[0], table.value(column, 0), fields));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    sheet.rows.emplace_back();
    for (std::size_t i = 1; i < table.variations().size(); ++i)
      sheet.rows.back().push_back(
          headingOf(table.variations()[i], table.value(row * table.columns(), i), fields));
  }
  return sheet;
}

void checkSize(const ContactSheet& sheet, const SweepOptions& options) {
  const SheetPlan size = planOf(sheet);
  if (size.width <= longestSide && size.height <= longestSide) return;
  throw UsageError("a sheet of " + std::to_string(sheet.pictures.size()) + " pictures of " +
                   std::to_string(options.width) + "x" + std::to_string(options.height) + " would have " +
                   std::to_string(size.width) + "x" + std::to_string(size.height) + " pixels; at most " +
                   std::to_string(longestSide) + " a side can be written. Choose a smaller --size.");
}

// Moves the pictures of the cells into the sheet.
void fillSheet(ContactSheet& sheet, const SweepTable& table, std::vector<Cell>& cells) {
  const std::vector<FieldInfo> fields = describeFields();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    sheet.pictures[i] = std::move(cells[i].picture);
    if (table.isWrapped())
      sheet.pictures[i].heading = headingOf(table.variations()[0], table.value(i, 0), fields);
  }
  const bool isOneState = std::all_of(table.variations().begin(), table.variations().end(),
                                      [](const Variation& variation) { return isLook(variation.key); });
  if (isOneState)
    for (SheetPicture& picture : sheet.pictures) picture.caption = "";
}

// A field of a CSV file, quoted as RFC 4180 demands.
std::string csvWord(const ordered_json& value) {
  if (value.is_null()) return "";
  const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// The measures of a line, by name.
constexpr std::array measureColumns{
    "frames",
    "finite",
    "divergence",
    "max_strain",
    "peak_strain",
    "min_y",
    "kinetic_energy",
    "max_penetration",
    "self_contacts",
    "contact_sound",
    "unconverged_steps",
    "last_update",
    "backend",
    "device",
    "particles",
    "steps",
    "dt",
    "sim_seconds",
    "seconds",
    "ms_per_frame",
    "state_hash",
};

// A line for each cell: the varied values, then the measures by name. `centroid` makes three columns.
std::string formatTable(const SweepTable& table, const std::vector<Cell>& cells) {
  std::string text;
  for (const Variation& variation : table.variations()) text += csvWord(variation.key) + ",";
  for (const char* column : measureColumns) text += column + std::string(",");
  text += "centroid_x,centroid_y,centroid_z\n";
  for (std::size_t cell = 0; cell < table.cells(); ++cell) {
    for (std::size_t i = 0; i < table.variations().size(); ++i) text += csvWord(table.value(cell, i)) + ",";
    const ordered_json& measures = cells[cell].measures;
    for (const char* column : measureColumns) text += csvWord(measures.at(column)) + ",";
    const ordered_json& centroid = measures.at("centroid");
    text += csvWord(centroid[0]) + "," + csvWord(centroid[1]) + "," + csvWord(centroid[2]) + "\n";
  }
  return text;
}

ordered_json toJson(const SweepOptions& options, const SweepTable& table, const ContactSheet& sheet,
                    const std::vector<Cell>& cells) {
  const SheetPlan plan = planOf(sheet);
  ordered_json json = ordered_json::object();
  json["scene"] = options.scene.scene;
  json["columns"] = table.columns();
  json["rows"] = table.rows();
  for (const Variation& variation : table.variations())
    json["vary"].push_back({{"key", variation.key}, {"values", variation.values}});
  for (std::size_t cell = 0; cell < table.cells(); ++cell) {
    ordered_json entry = ordered_json::object();
    for (std::size_t i = 0; i < table.variations().size(); ++i)
      entry["values"][table.variations()[i].key] = table.value(cell, i);
    entry["pixels"] = {plan.pictures[cell].x, plan.pictures[cell].y, options.width, options.height};
    entry.update(cells[cell].measures);
    json["cells"].push_back(std::move(entry));
  }
  return json;
}

std::filesystem::path tableFile(const SweepOptions& options) {
  return std::filesystem::path(options.out).replace_extension(".csv");
}

}  // namespace

int sweepCommand(const SweepOptions& options) {
  if (!options.out.ends_with(".png"))
    throw UsageError("--out " + options.out + ": expected a name ending in .png, as sheet.png");
  std::vector<Variation> variations;
  for (const std::string& text : options.variations) variations.push_back(parseVariation(text));
  const SweepTable table(std::move(variations), static_cast<double>(options.width) / options.height);
  checkFrames(options, table);
  checkVaried(options, table);
  const std::vector<PlannedRun> runs = planRuns(options, table);
  ContactSheet sheet = makeSheet(options, table, runs);
  checkSize(sheet, options);
  checkWritable(options.out);
  checkWritable(tableFile(options));

  const gl::HeadlessContext context;
  const std::string backend = announcedBackend(options.backend);
  const std::vector<Camera> cameras = placeCameras(options, table, runs);
  std::int64_t framesDone = 0, framesInAll = 0;
  for (const PlannedRun& planned : runs) framesInAll += planned.lastFrame();
  Progress progress("sweeping", framesInAll);
  std::vector<Cell> cells(table.cells());
  std::vector<Warning> warnings;
  int blownUp = 0;
  for (const PlannedRun& planned : runs) {
    SweepRun run(options, backend, planned, cameras);
    run.run(cells, [&](int frame) { progress.update(framesDone + frame); });
    std::ranges::move(run.warnings(), std::back_inserter(warnings));
    blownUp += run.blewUp() ? 1 : 0;
    framesDone += planned.lastFrame();
  }
  progress.finish();

  fillSheet(sheet, table, cells);
  const Image page = drawSheet(sheet);
  writeFileAtomically(tableFile(options), formatTable(table, cells));
  savePng(options.out, page.width, page.height, page.rgb);
  if (options.json)
    printJson(toJson(options, table, sheet, cells));
  else
    std::printf("%s\n%s\n", options.out.c_str(), tableFile(options).string().c_str());
  if (options.strict && blownUp > 0)
    throw SimulationError("--strict: " + std::to_string(blownUp) +
                          (blownUp == 1 ? " simulation" : " simulations") + " blew up");
  checkStrict(options.strict, warnings);
  return 0;
}

}  // namespace clothsim
