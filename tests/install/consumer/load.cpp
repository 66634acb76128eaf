// SPDX-License-Identifier: MIT
// Loads the plugin. Usage: load PLUGIN
#include <cstdio>

#include <dlfcn.h>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  void* const plugin = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  if (plugin == nullptr) {
    std::printf("%s\n", dlerror());
    return 1;
  }
  const auto count = reinterpret_cast<int (*)(double)>(dlsym(plugin, "count_in_square"));
  std::printf("%d of 4 vertices within 1, by a plugin\n", count(1.0));
  return count(1.0) == 3 && count(-1.0) == -1 && dlclose(plugin) == 0 ? 0 : 1;
}
