// SPDX-License-Identifier: MIT
#include "interrupt.h"

#include <array>
#include <csignal>
#include <cstddef>

namespace meshhood::cli {
namespace {

constexpr std::array kSignals{SIGINT, SIGHUP, SIGTERM};

volatile std::sig_atomic_t caught = 0;

void remember(int /*signal*/) { caught = 1; }

void set_handlers(void (*from)(int), void (*to)(int)) {
  for (const int signal : kSignals) {
    // A signal that is ignored stays so, for that is how nohup and background jobs ask for it.
    const auto previous = std::signal(signal, to);
    if (previous != from) std::signal(signal, previous);
  }
}

}  // namespace

Interrupt::Interrupt() {
  caught = 0;
  set_handlers(SIG_DFL, remember);
}

Interrupt::~Interrupt() { set_handlers(remember, SIG_DFL); }

bool Interrupt::requested() const { return caught != 0; }

meshhood::Progress Interrupt::watch() const {
  return [this](std::size_t, std::size_t) { return !requested(); };
}

}  // namespace meshhood::cli
