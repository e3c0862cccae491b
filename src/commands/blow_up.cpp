#include "commands/blow_up.h"

#include <algorithm>

#include "commands/run_files.h"
#include "core/error.h"
#include "core/files.h"
#include "export/formats.h"

namespace clothsim {
namespace {

namespace fs = std::filesystem;

// Quoted so that a shell reads it as one word.
std::string quoted(const std::string& word) {
  const bool plain = word.find_first_not_of(
                         "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                         "_-+=./:,%@") == std::string::npos;
  if (plain && !word.empty()) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string keyOf(const std::string& setting) { return setting.substr(0, setting.find('=')); }

// A name beside that of a file whose frames end at `frame`.
std::string nameFrom(const std::string& name, int frame) {
  fs::path path = name;
  const std::string extension = path.extension().string();
  return path.replace_filename(path.stem().string() + "-from" + std::to_string(frame) + extension).string();
}

// The options that save the rest of the run, and overwrite nothing of what is there.
std::string optionsToSave(const RunOptions& run, int lastFrame) {
  const int number = run.firstFrame + lastFrame;
  std::string options;
  for (const std::string& save : run.saves)
    options += " --save " + quoted(holdsFrames(save) ? nameFrom(save, number) : save);
  if (run.every != 1) options += " --every " + std::to_string(run.every);
  if (number != 0 && std::ranges::any_of(run.saves, numbersFrames))
    options += " --first-frame " + std::to_string(number);
  if (!run.trace.empty()) options += " --trace " + quoted(nameFrom(run.trace, number));
  return options;
}

// The command line that continues from the state, with the settings in `changes`.
std::string commandToGoOn(const BlowUpContext& context, const std::string& stateFile,
                          const std::vector<std::string>& changes) {
  std::string command = "clothsim run -f " + quoted(context.scene.scene);
  if (const auto& size = context.scene.resolution)
    command += " --resolution " + std::to_string(size->columns) + "x" + std::to_string(size->rows);
  std::vector<std::string> settings = context.scene.settings;
  for (const std::string& change : changes)
    std::erase_if(settings, [&](const std::string& setting) { return keyOf(setting) == keyOf(change); });
  settings.insert(settings.end(), changes.begin(), changes.end());
  for (const std::string& setting : settings) command += " --set " + quoted(setting);
  if (context.backend != "gpu") command += " --backend " + context.backend;
  command +=
      " --from " + quoted(stateFile) + " --frames " + std::to_string(context.frames - context.frame + 1);
  return context.run == nullptr ? command : command + optionsToSave(*context.run, context.frame - 1);
}

// The first name under which no file lies, or a file with the same bytes.
fs::path freeStateName(const fs::path& folder, const std::string& stem, const std::string& bytes) {
  for (int i = 1;; ++i) {
    const fs::path path = folder / (stem + (i > 1 ? "-" + std::to_string(i) : "") + ".state");
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(path, ignored))) return path;
    if (fs::is_regular_file(path, ignored) && fs::file_size(path, ignored) == bytes.size() &&
        readFile(path) == bytes)
      return path;
  }
}

}  // namespace

void stopBlownUp(const Divergence& divergence, Simulation& simulation, const BlowUpContext& context) {
  std::string message =
      blowUpText(divergence, simulation.cloth(), simulation.scene(), context.frame) + context.filesText;
  if (context.replays) message += "\nA replay takes no --set: record it anew with these settings.";
  const std::string frame = std::to_string(context.frame - 1);
  try {
    const std::string bytes = formatStateFile(simulation.solver().state());
    const std::string stem = fs::path(context.scene.scene).stem().string() + "-frame" + frame + "-last-good";
    const fs::path path = freeStateName(context.outputFolder, stem, bytes);
    writeFileAtomically(path, bytes);
    message += "\nThe last good state, that of frame " + frame + ", is saved: " + path.string();
    const std::vector<std::string> changes = remedyFor(divergence, simulation.scene()).settings;
    if (!context.replays && !changes.empty())
      message += "\nTo go on from it: " + commandToGoOn(context, path.string(), changes);
  } catch (const Error& error) {
    message += "\nThe last good state, that of frame " + frame + ", could not be saved: " + error.what();
  }
  throw SimulationError(message);
}

}  // namespace clothsim
