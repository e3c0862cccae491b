#include "export/usd_binary.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.h"
#include "core/interrupt.h"
#include "export/child_words.h"

extern char** environ;

namespace clothsim {
namespace {

constexpr int textDescriptor = 3, binaryDescriptor = 4;  // their numbers in Python

constexpr const char* importLibrary = "from pxr import Sdf";
// The library writes only to files that have a name with an extension of its own.
constexpr const char* convert = R"(import os, shutil, tempfile
from pxr import Sdf
with open("/proc/self/fd/3") as text:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    if not layer.ImportFromString(text.read()):
        raise SystemExit("the text form cannot be read")
with tempfile.TemporaryDirectory() as folder:
    name = os.path.join(folder, "cloth.usdc")
    if not layer.Export(name):
        raise SystemExit("the binary form cannot be written to " + folder)
    with open(name, "rb") as made, os.fdopen(4, "wb") as binary:
        shutil.copyfileobj(made, binary)
)";

std::string python() {
  const char* const wish = std::getenv("CLOTHSIM_PYTHON");
  return wish != nullptr && *wish != '\0' ? wish : "python3";
}

struct PythonRun {
  bool endedWell = false;
  std::string said;  // the last line that it wrote to stderr
};

// Runs a Python program that may have two files open; -1 for none.
PythonRun runPython(const char* program, int text, int binary) {
  const std::string name = python();
  std::array<char*, 4> arguments{const_cast<char*>(name.c_str()), const_cast<char*>("-c"),
                                 const_cast<char*>(program), nullptr};
  const int words = ::memfd_create("Python's words", MFD_CLOEXEC);
  if (words < 0) return {false, std::strerror(errno)};
  // Above the numbers that they take in Python, where none overwrites another.
  const int textCopy = text < 0 ? -1 : ::fcntl(text, F_DUPFD_CLOEXEC, 10);
  const int binaryCopy = binary < 0 ? -1 : ::fcntl(binary, F_DUPFD_CLOEXEC, 10);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, words, STDERR_FILENO);
  if (textCopy >= 0) posix_spawn_file_actions_adddup2(&actions, textCopy, textDescriptor);
  if (binaryCopy >= 0) posix_spawn_file_actions_adddup2(&actions, binaryCopy, binaryDescriptor);
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (textCopy >= 0) ::close(textCopy);
  if (binaryCopy >= 0) ::close(binaryCopy);

  PythonRun run;
  if (error != 0) {
    run.said = name + " does not start: " + std::strerror(error);
  } else {
    int status = 0;
    pid_t ended = -1;
    while ((ended = ::waitpid(child, &status, 0)) < 0 && errno == EINTR)
      if (isInterrupted()) ::kill(child, SIGKILL);
    run.endedWell = ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    run.said = lastWords(words);
    run.said.erase(0, run.said.rfind('\n') + 1);  // what a traceback ends with says what is wrong
  }
  ::close(words);
  return run;
}

}  // namespace

bool isUsdBinary(const std::filesystem::path& path) {
  return path.extension() == ".usdc" || path.extension() == ".usd";
}

void checkUsdLibrary(const std::filesystem::path& path) {
  const PythonRun run = runPython(importLibrary, -1, -1);
  stopIfInterrupted();
  if (run.endedWell) return;
  throw InputOutputError(
      path.string() + ": cannot be written: the binary form of USD is made by Pixar's library, which " +
      python() + " does not have. Install it (`pip install usd-core`; CLOTHSIM_PYTHON names another " +
      "Python), or save .usda, the text form.");
}

void makeUsdBinary(const std::filesystem::path& path, int text, GrowingFile& file) {
  const PythonRun run = runPython(convert, text, file.descriptor());
  stopIfInterrupted();
  if (!run.endedWell)
    throw InputOutputError(path.string() + ": cannot be written: Pixar's USD library failed: " + run.said);
}

}  // namespace clothsim
