// A program that runs beside the test, and ends with it.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace clothsim::test {

class Process {
 public:
  // What it prints, on either stream, goes to the file `output`.
  Process(const std::vector<std::string>& command, const std::string& output) {
    std::vector<char*> argv;
    for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ < 0) throw std::system_error(errno, std::generic_category(), "fork");  // kill(-1) would end all
    if (pid_ != 0) return;
    ::signal(SIGINT, SIG_DFL);  // ignored by what a script runs in the background
    const int file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  ~Process() {
    if (exitCode_.has_value()) return;
    ::kill(pid_, SIGTERM);
    if (!waitFor(std::chrono::seconds(5))) ::kill(pid_, SIGKILL);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // Its exit code (128 + the signal's number, where a signal ended it), or nothing when it goes on for longer
  // than that.
  std::optional<int> waitFor(std::chrono::milliseconds time) {
    for (const auto end = std::chrono::steady_clock::now() + time; !exitCode_.has_value();) {
      int status = 0;
      if (::waitpid(pid_, &status, WNOHANG) == pid_)
        exitCode_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      else if (std::chrono::steady_clock::now() > end)
        break;
      else
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return exitCode_;
  }
  void send(int signal) { ::kill(pid_, signal); }
  [[nodiscard]] bool running() { return !waitFor(std::chrono::milliseconds(0)).has_value(); }

 private:
  pid_t pid_ = -1;
  std::optional<int> exitCode_;
};

}  // namespace clothsim::test
