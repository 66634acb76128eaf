// SPDX-License-Identifier: MIT
#pragma once

#include "shared/distance.h"

namespace meshhood {

/// Where the segment from `inside`, a point of the ball, to `outside` leaves the ball; `outside` if that is inside too.
[[nodiscard]] Point exit_point(const Point& inside, const Point& outside, const Point& center, double radius);

}  // namespace meshhood
