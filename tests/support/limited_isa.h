// SPDX-License-Identifier: MIT
#pragma once

#include "simd/kernels.h"

namespace meshhood::test {

/// Limits the kernels of all searches while it lives.
class LimitedIsa {
 public:
  explicit LimitedIsa(Isa isa) : before_(best_isa()) { limit_isa(isa); }
  LimitedIsa(const LimitedIsa&) = delete;
  LimitedIsa& operator=(const LimitedIsa&) = delete;
  ~LimitedIsa() { limit_isa(before_); }

 private:
  Isa before_;
};

}  // namespace meshhood::test
