#include "commands/run_files.h"

#include <algorithm>

#include "core/error.h"
#include "core/files.h"
#include "export/export.h"
#include "output/picture_output.h"

namespace clothsim {
namespace {

// The names of options.saves that are not pictures.
std::vector<std::string> filesOf(const RunOptions& options) {
  std::vector<std::string> files;
  std::remove_copy_if(options.saves.begin(), options.saves.end(), std::back_inserter(files), isPicture);
  return files;
}

void addName(std::string& list, const std::string& name) { list += (list.empty() ? "" : ", ") + name; }

}  // namespace

bool numbersFrames(const std::string& save) {
  return hasFrameNumber(save) || (isSequence(save) && !isPointCache(save));
}

bool holdsFrames(const std::string& save) { return isSequence(save) || isFilm(save); }

void checkFrameNumber(const std::string& flag, const std::string& name) {
  const std::string foreign = foreignFrameNumber(name);
  if (holdsFrames(name) && (hasFrameNumber(name) || !foreign.empty()))
    throw UsageError(flag + " " + name +
                     ": a file of this kind holds all frames; leave the number out of its name");
  if (foreign.empty()) return;
  std::string right = name;
  right.replace(name.find(foreign), foreign.size(), "%04d");
  throw UsageError(flag + " " + name + ": expected %04d for the number of a frame, found " + foreign +
                   "; write " + right);
}

std::string earlyEndText(const std::vector<std::string>& names, int frame, const std::string& trace) {
  std::string written = trace, missing;
  for (const std::string& name : names) {
    if (!holdsFrames(name) && !hasFrameNumber(name))
      addName(missing, name);
    else
      addName(written, isPointCache(name) ? name + " with " + restMeshBeside(name).string() : name);
  }
  std::string text;
  if (!written.empty())
    text += "\nWritten, with what there was to save up to frame " + std::to_string(frame) + ": " + written;
  if (!missing.empty()) text += "\nNot written, for want of a last frame: " + missing;
  return text;
}

RunFiles::RunFiles(const RunOptions& options, Simulation& simulation, int frames)
    : options_(options),
      files_(filesOf(options), options.every, frames, simulation, options.firstFrame),
      pictures_(options, simulation.scene(), frames) {}

void RunFiles::add(Simulation& simulation, const RunSummary& seen, int frame) {
  pictures_.add(simulation, frame);  // first, since an interrupt ends drawing
  isWhole_ = false;
  files_.add(simulation, seen.state, frame);
  isWhole_ = true;
  if (!options_.trace.empty()) trace_.add(seen, simulation);
  lastFrame_ = frame;
}

void RunFiles::finish() {
  files_.finish();
  pictures_.finish();
  writeTrace();
}

std::string RunFiles::finishEarly() {
  try {
    writeTrace();
    if (isWhole_) {
      files_.finish();
      pictures_.finish();
    }
    return earlyEndText(isWhole_ ? options_.saves : std::vector<std::string>(), lastFrame_, options_.trace);
  } catch (const Error& error) {
    return "\nNot all that there was to save up to frame " + std::to_string(lastFrame_) +
           " could be written: " + error.what();
  }
}

std::vector<Warning> RunFiles::warnings() const {
  std::vector<Warning> warnings;
  for (const std::string& loss : files_.losses()) warnings.push_back({"file", std::nullopt, loss, loss});
  return warnings;
}

void RunFiles::writeTrace() const {
  if (options_.trace.empty()) return;
  writeFileAtomically(options_.trace, options_.trace.ends_with(".npz") ? trace_.npz() : trace_.csv());
}

}  // namespace clothsim
