// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <stdexcept>

#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

namespace meshhood::bench {

/// Keeps the calling process on one of its processors until the end of the scope.
class Pinned {
 public:
  explicit Pinned(int processor) {
    sched_getaffinity(0, sizeof(before_), &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(processor, &one);
    sched_setaffinity(0, sizeof(one), &one);
  }
  Pinned(const Pinned&) = delete;
  Pinned& operator=(const Pinned&) = delete;
  ~Pinned() { sched_setaffinity(0, sizeof(before_), &before_); }

 private:
  cpu_set_t before_{};
};

/// The first two processors that this process may use; none if there are fewer.
inline std::optional<std::array<int, 2>> two_processors() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  sched_getaffinity(0, sizeof(allowed), &allowed);
  std::array<int, 2> found{};
  std::size_t count = 0;
  for (int processor = 0; processor < CPU_SETSIZE && count < found.size(); ++processor) {
    if (CPU_ISSET(processor, &allowed)) found[count++] = processor;
  }
  if (count < found.size()) return std::nullopt;
  return found;
}

/// The wall-clock seconds in which two processes finish `f()` at once, each on a processor of its own. They share
/// nothing that they write, so two threads on this machine can hardly do twice the work in less time. Calls `f` only
/// from the one thread of this process, and in a copy of the process.
template <class F>
double two_processes(const std::array<int, 2>& processors, F&& f) {
  std::array<int, 2> start{};  // read by the other process, which begins when it is closed
  if (pipe(start.data()) != 0) throw std::runtime_error("cannot create a pipe");
  const pid_t other = fork();
  if (other < 0) throw std::runtime_error("cannot create a process");
  if (other == 0) {
    const Pinned pinned(processors[1]);
    close(start[1]);
    char unused = 0;
    while (read(start[0], &unused, 1) > 0) {
    }
    f();
    _exit(0);
  }
  const Pinned pinned(processors[0]);
  close(start[0]);
  const auto begin = std::chrono::steady_clock::now();
  close(start[1]);
  f();
  waitpid(other, nullptr, 0);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace meshhood::bench
