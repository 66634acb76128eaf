# SPDX-License-Identifier: MIT
"""A library of headers of this machine, in place of the recipe of ConanCenter, which is not reached here."""

from pathlib import Path

from conan import ConanFile
from conan.tools.files import copy

HEADERS = {
    "fast_float": ("FastFloat::fast_float", ["fast_float/*"]),
    "fmt": ("fmt::fmt", ["fmt/*"]),
    "highway": ("highway::highway", ["hwy/*"]),
    "xxhash": ("xxHash::xxhash", ["xxhash.h", "xxh3.h"]),
}
FILE_NAMES = {"fast_float": "FastFloat", "xxhash": "xxHash"}


class SystemLibrary(ConanFile):
    package_type = "header-library"

    def package(self):
        for pattern in HEADERS[self.name][1]:
            copy(self, pattern, "/usr/include", Path(self.package_folder, "include"))

    def package_info(self):
        self.cpp_info.set_property("cmake_target_name", HEADERS[self.name][0])
        self.cpp_info.set_property("cmake_file_name", FILE_NAMES.get(self.name, self.name))
        self.cpp_info.bindirs = self.cpp_info.libdirs = []
        if self.name == "fmt":
            self.cpp_info.defines = ["FMT_HEADER_ONLY"]
