// SPDX-License-Identifier: MIT
#include "processor_time.h"

#include <ctime>

namespace meshhood::cli {

double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace meshhood::cli
