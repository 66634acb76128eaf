// SPDX-License-Identifier: MIT
#pragma once

/// Which instructions this processor has, and its operating system allows. The compiler's `__builtin_cpu_supports`
/// needs a library that not every compiler links; it then answers no.
namespace meshhood {

struct Processor {
  bool sse4 = false;    // SSE 4.2
  bool avx2 = false;    // with FMA, F16C, BMI 1 and 2
  bool avx512 = false;  // with F, BW, DQ, VL
};

[[nodiscard]] Processor this_processor();

}  // namespace meshhood
