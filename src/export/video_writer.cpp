// Raw frames go to ffmpeg's standard input. It is started without a shell, and its end of the connection is a
// socket rather than a pipe: writing to a socket whose reader has died can be told not to raise SIGPIPE,
// which would end the whole program. It writes to a file that we opened, and hears no name that it could take
// for an option or a protocol. In a process group of its own it is left alone by Ctrl-C, which is for us to
// answer.
#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "core/interrupt.h"
#include "core/temporary_file.h"
#include "export/child_words.h"
#include "export/export.h"

extern char** environ;

namespace clothsim {
namespace {

constexpr int filmDescriptor =
    3;  // the film's number in ffmpeg, which opens it anew through /proc, also to read

constexpr std::array mp4Words{
    // yuv420p, which every player shows, takes even sizes only. The colours are converted to BT.709, and
    // labelled so.
    "-vf",
    "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
    "-c:v",
    "libx264",
    "-preset",
    "medium",
    "-crf",
    "18",
    "-pix_fmt",
    "yuv420p",
    "-colorspace",
    "bt709",
    "-color_primaries",
    "bt709",
    "-color_trc",
    "bt709",
    "-color_range",
    "tv",
    "-movflags",
    "+faststart",
    "-f",
    "mp4"};
constexpr std::array webpWords{"-c:v", "libwebp_anim", "-quality", "75", "-loop", "0", "-f", "webp"};

std::vector<std::string> ffmpegArguments(const std::filesystem::path& path, int width, int height,
                                         double framesPerSecond) {
  std::array<char, 32> rate;
  const auto end = std::to_chars(rate.data(), rate.data() + rate.size(), framesPerSecond).ptr;
  std::vector<std::string> arguments{"ffmpeg", "-hide_banner", "-nostdin", "-loglevel", "error", "-y",
                                     // The input.
                                     "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size",
                                     std::to_string(width) + "x" + std::to_string(height), "-framerate",
                                     std::string(rate.data(), end), "-i", "pipe:0"};
  const auto add = [&](const auto& words) { arguments.insert(arguments.end(), words.begin(), words.end()); };
  path.extension() == ".webp" ? add(webpWords) : add(mp4Words);
  arguments.push_back("file:/proc/self/fd/" + std::to_string(filmDescriptor));
  return arguments;
}

}  // namespace

bool isFilm(const std::string& name) { return name.ends_with(".mp4") || name.ends_with(".webp"); }

struct VideoWriter::Pipe {
  Pipe(const std::filesystem::path& wanted, std::size_t bytes)
      : path(wanted), film(wanted, regularFile(wanted)), frameBytes(bytes) {}

  std::filesystem::path path;
  TemporaryFile film;
  std::size_t frameBytes;
  pid_t ffmpeg = -1;  // -1 before it was started and once it has been waited for
  int input = -1;     // our end of its standard input
  int words = -1;     // a file in memory that takes its messages

  ~Pipe() {
    if (input >= 0) ::close(input);
    if (ffmpeg > 0) {
      ::kill(ffmpeg, SIGKILL);
      waitForEnd();
    }
    if (words >= 0) ::close(words);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  // ffmpeg seeks within the film it writes, which a device or a pipe does not allow.
  static Destination regularFile(const std::filesystem::path& path) {
    Destination destination = destinationOf(path);
    if (!destination.isReplaced)
      throw InputOutputError(path.string() + ": cannot be written: a film needs a regular file");
    return destination;
  }
  void start(const std::vector<std::string>& arguments);
  // Whether it ended well.
  bool waitForEnd() {
    int status = 0;
    pid_t ended = -1;
    while ((ended = ::waitpid(ffmpeg, &status, 0)) < 0 && errno == EINTR)
      if (isInterrupted()) ::kill(ffmpeg, SIGKILL);
    ffmpeg = -1;
    return ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  [[noreturn]] void fail();
};

void VideoWriter::Pipe::start(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  words = ::memfd_create("ffmpeg's words", MFD_CLOEXEC);
  int ends[2];
  if (words < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw InputOutputError("cannot start ffmpeg for '" + path.string() + "': " + std::strerror(errno));
  input = ends[0];

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, words, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&actions, film.descriptor(), filmDescriptor);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);  // of its own
  const int error = ::posix_spawnp(&ffmpeg, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error == 0) return;
  ffmpeg = -1;
  if (error == ENOENT)
    throw InputOutputError(
        "cannot write '" + path.string() +
        "': the program ffmpeg is not installed. Install it (`apt-get install ffmpeg`), or write numbered "
        "pictures instead: --out frame_%04d.png");
  throw InputOutputError("cannot write '" + path.string() +
                         "': ffmpeg does not start: " + std::strerror(error));
}

void VideoWriter::Pipe::fail() {
  if (ffmpeg > 0) waitForEnd();
  const std::string said = lastWords(words);
  throw InputOutputError("cannot write '" + path.string() + "': ffmpeg failed" +
                         (said.empty() ? "" : ": " + said));
}

VideoWriter::VideoWriter(const std::filesystem::path& path, int width, int height, double framesPerSecond)
    : pipe_(std::make_unique<Pipe>(path,
                                   3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))) {
  pipe_->start(ffmpegArguments(path, width, height, framesPerSecond));
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::addFrame(std::span<const std::uint8_t> rgb) {
  assert(rgb.size() == pipe_->frameBytes && "a frame of the size given at the start");
  while (!rgb.empty()) {
    const ssize_t written = ::send(pipe_->input, rgb.data(), rgb.size(), MSG_NOSIGNAL);
    if (written >= 0)
      rgb = rgb.subspan(static_cast<std::size_t>(written));
    else if (errno != EINTR)  // part of a picture would spoil the film: who calls stops after it
      pipe_->fail();
  }
}

void VideoWriter::close() {
  ::close(pipe_->input);
  pipe_->input = -1;
  const bool endedWell = pipe_->waitForEnd();
  stopIfInterrupted();
  if (!endedWell) pipe_->fail();
  pipe_->film.publish();
}

}  // namespace clothsim
