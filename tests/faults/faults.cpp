#include "faults/faults.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace clothsim::test {
namespace {

struct Injection {
  Fault fault = Fault::none;
  int n = 0;
  bool forGood = false;
  std::atomic<int>* calls = nullptr;  // seen by the parent, too
} injection;

bool fails(Fault fault) {
  if (injection.fault != fault) return false;
  const int call = ++*injection.calls;
  return injection.forGood ? call >= injection.n : call == injection.n;
}

// Of the C library; a call of that name from here would come back to us.
template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

Outcome runWithFault(Fault fault, int n, bool forGood, const char* output, const std::function<int()>& work) {
  static auto* const calls = static_cast<std::atomic<int>*>(
      ::mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  *calls = 0;
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    const int file = ::open(output, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    ::close(file);
    ::setenv("CLOTHSIM_THREADS", "1", 1);
    injection = {fault, n, forGood, calls};
    const int code = work();
    injection.fault = Fault::none;
    ::_exit(code);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), *calls};
}

}  // namespace clothsim::test

using clothsim::test::fails;
using clothsim::test::Fault;
using clothsim::test::next;

// Those of C++ that are not here call one of these.
void* operator new(std::size_t size) {
  void* const memory = fails(Fault::allocate) ? nullptr : std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  void* const memory =
      fails(Fault::allocate) ? nullptr : std::aligned_alloc(step, (size + step - 1) / step * step);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

#pragma GCC visibility push(default)  // the system's libraries call them, too
extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if (fails(Fault::open)) return errno = EMFILE, -1;
  static auto* const real = next<int(const char*, int, ...)>("open");
  return real(path, flags, mode);
}

std::FILE* fopen(const char* path, const char* mode) {
  if (fails(Fault::open)) return errno = EMFILE, nullptr;
  static auto* const real = next<std::FILE*(const char*, const char*)>("fopen");
  return real(path, mode);
}

ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  static auto* const real = next<ssize_t(int, const void*, std::size_t)>("write");
  if (!fails(Fault::write)) return real(descriptor, bytes, count);
  // As a disk that fills up: a part still finds room.
  const clothsim::test::Injection& now = clothsim::test::injection;
  if (now.forGood && *now.calls == now.n && count > 1) return real(descriptor, bytes, count / 2);
  return errno = ENOSPC, -1;
}

// Of no use to a test, and slow.
int fsync(int) { return fails(Fault::synchronise) ? (errno = EIO, -1) : 0; }

int close(int descriptor) {
  static auto* const real = next<int(int)>("close");
  const int result = real(descriptor);  // it is gone all the same
  if (fails(Fault::close)) return errno = EIO, -1;
  return result;
}

int fclose(std::FILE* file) {
  static auto* const real = next<int(std::FILE*)>("fclose");
  const int result = real(file);
  if (fails(Fault::close)) return errno = EIO, EOF;
  return result;
}

int rename(const char* from, const char* to) noexcept {
  if (fails(Fault::rename)) return errno = EIO, -1;
  static auto* const real = next<int(const char*, const char*)>("rename");
  return real(from, to);
}

int stat(const char* path, struct stat* status) noexcept {
  if (fails(Fault::stat)) return errno = EIO, -1;
  static auto* const real = next<int(const char*, struct stat*)>("stat");
  return real(path, status);
}

int lstat(const char* path, struct stat* status) noexcept {
  if (fails(Fault::stat)) return errno = EIO, -1;
  static auto* const real = next<int(const char*, struct stat*)>("lstat");
  return real(path, status);
}

int access(const char* path, int mode) noexcept {
  if (fails(Fault::stat)) return errno = EIO, -1;
  static auto* const real = next<int(const char*, int)>("access");
  return real(path, mode);
}
}
#pragma GCC visibility pop
