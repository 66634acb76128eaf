// SPDX-License-Identifier: MIT
// A compiler that cannot compile this is not installed completely; the tests then skip it.
#include <vector>

int main() { return static_cast<int>(std::vector<int>().size()); }
