// SPDX-License-Identifier: MIT
// The least that a compiler must manage before its word about our sources counts.
#include <vector>

int main() { return static_cast<int>(std::vector<int>().size()); }
