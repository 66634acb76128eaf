// SPDX-License-Identifier: MIT
// Writes a file in which every second byte is uninitialized: `no_uninitialized_bytes.sh` must find that.
#include <cstddef>
#include <memory>

#include "io/file_writer.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  constexpr std::size_t kBytes = 4096;
  const auto bytes = std::make_unique_for_overwrite<char[]>(kBytes);  // NOLINT(modernize-avoid-c-arrays): no values
  for (std::size_t i = 0; i < kBytes; i += 2) bytes[i] = 'x';
  meshhood::io::FileWriter file(argv[1]);
  file.write({bytes.get(), kBytes});
  file.commit();
}
