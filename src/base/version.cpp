// SPDX-License-Identifier: MIT
#include "meshhood/version.h"

namespace meshhood {

const char detail::MESHHOOD_HEADERS = 0;

}  // namespace meshhood
