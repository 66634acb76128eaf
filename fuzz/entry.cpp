// SPDX-License-Identifier: MIT
// The entry point of libFuzzer.
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <sys/time.h>
#include <unistd.h>

#include "target.h"

namespace {

constexpr time_t kSeconds = 5;

extern "C" [[noreturn]] void give_up(int /*signal*/) {
  constexpr const char* kWords = "meshhood: one input took more than 5 s of processor time\n";
  static_cast<void>(write(STDERR_FILENO, kWords, std::strlen(kWords)));
  std::abort();  // libFuzzer then keeps the input
}

/// Limits the processor time of an input. The limit of libFuzzer itself counts wall time, by which any input can be
/// slow on a busy machine.
void limit_time(time_t seconds) {
  static_cast<void>(std::signal(SIGPROF, give_up));
  const itimerval limit{.it_interval = {}, .it_value = {.tv_sec = seconds, .tv_usec = 0}};
  static_cast<void>(setitimer(ITIMER_PROF, &limit, nullptr));
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  limit_time(kSeconds);
  meshhood::fuzz::run(std::as_bytes(std::span(data, size)));
  limit_time(0);  // the fuzzer itself is not limited
  return 0;
}
