// SPDX-License-Identifier: MIT
#include "machine.h"

#include <fstream>
#include <string>

namespace meshhood::cli {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

}  // namespace

Machine this_machine() {
#if defined(__clang__)
  const std::string compiler = __VERSION__;
#else
  const std::string compiler = "g++ " __VERSION__;
#endif
  return {processor(), compiler, MESHHOOD_BUILD_TYPE};
}

}  // namespace meshhood::cli
