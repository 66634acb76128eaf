// SPDX-License-Identifier: MIT
#pragma once

#include "meshhood/progress.h"

namespace meshhood::cli {

/// While it lives, Ctrl-C and the signals to hang up and to terminate do not end the program but are remembered, so
/// that what was begun can be undone. One object at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Whether there has been such a signal.
  [[nodiscard]] bool requested() const;

  /// For a call that is to end where there has been.
  [[nodiscard]] meshhood::Progress watch() const;
};

}  // namespace meshhood::cli
