// Raw frames go to ffmpeg's standard input. It is started without a shell, and its end of the connection is a
// socket rather than a pipe: writing to a socket whose reader has died can be told not to raise SIGPIPE,
// which would end the whole program.
#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "export/export.h"

extern char** environ;

namespace clothsim {
namespace {

std::vector<std::string> ffmpegArguments(const std::string& output, int width, int height,
                                         double framesPerSecond) {
  std::array<char, 32> rate;
  const auto end = std::to_chars(rate.data(), rate.data() + rate.size(), framesPerSecond).ptr;
  return {"ffmpeg", "-hide_banner", "-nostdin", "-loglevel", "error", "-y",
          // what comes in
          "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size",
          std::to_string(width) + "x" + std::to_string(height), "-framerate", std::string(rate.data(), end),
          "-i", "pipe:0",
          // what goes out: yuv420p, which every player shows, takes even sizes only; colours are said to be
          // BT.709 and are
          "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", "-c:v", "libx264",
          "-preset", "medium", "-crf", "18", "-pix_fmt", "yuv420p", "-colorspace", "bt709",
          "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv", "-movflags", "+faststart",
          output};
}

}  // namespace

struct VideoWriter::Pipe {
  std::filesystem::path path, temporaryPath;
  std::size_t frameBytes = 0;
  pid_t ffmpeg = -1;           // -1 once it has been waited for
  int input = -1;              // our end of its standard input
  std::FILE* words = nullptr;  // a nameless file that takes what it says

  ~Pipe() {
    if (input >= 0) ::close(input);
    if (ffmpeg > 0) {
      ::kill(ffmpeg, SIGKILL);
      waitForEnd();
    }
    if (words != nullptr) std::fclose(words);
    std::error_code ignored;  // after close() there is nothing left to remove
    std::filesystem::remove(temporaryPath, ignored);
  }

  void start(const std::vector<std::string>& arguments);
  // Whether it ended well.
  bool waitForEnd() {
    int status = 0;
    while (::waitpid(ffmpeg, &status, 0) < 0 && errno == EINTR) continue;
    ffmpeg = -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  [[noreturn]] void fail();
};

void VideoWriter::Pipe::start(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  words = std::tmpfile();
  int ends[2];
  if (words == nullptr || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw InputOutputError("cannot start ffmpeg for '" + path.string() + "': " + std::strerror(errno));
  ::fcntl(::fileno(words), F_SETFD, FD_CLOEXEC);
  input = ends[0];

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(words), STDERR_FILENO);
  const int error = ::posix_spawnp(&ffmpeg, argv[0], &actions, nullptr, argv.data(), environ);
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
  std::string said(2000, '\0');
  std::rewind(words);
  said.resize(std::fread(said.data(), 1, said.size(), words));
  while (!said.empty() && said.back() == '\n') said.pop_back();
  throw InputOutputError("cannot write '" + path.string() + "': ffmpeg failed" +
                         (said.empty() ? "" : ": " + said));
}

VideoWriter::VideoWriter(const std::filesystem::path& path, int width, int height, double framesPerSecond)
    : pipe_(std::make_unique<Pipe>()) {
  pipe_->path = path;
  pipe_->temporaryPath = temporaryNameBeside(path);
  pipe_->frameBytes = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  pipe_->start(ffmpegArguments(pipe_->temporaryPath.string(), width, height, framesPerSecond));
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::addFrame(std::span<const std::uint8_t> rgb) {
  assert(rgb.size() == pipe_->frameBytes && "a frame of the size given at the start");
  while (!rgb.empty()) {
    const ssize_t written = ::send(pipe_->input, rgb.data(), rgb.size(), MSG_NOSIGNAL);
    if (written >= 0)
      rgb = rgb.subspan(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      pipe_->fail();
  }
}

void VideoWriter::close() {
  ::close(pipe_->input);
  pipe_->input = -1;
  if (!pipe_->waitForEnd()) pipe_->fail();
  std::error_code error;
  std::filesystem::rename(pipe_->temporaryPath, pipe_->path, error);
  if (error) throw InputOutputError("cannot write '" + pipe_->path.string() + "': " + error.message());
}

}  // namespace clothsim
