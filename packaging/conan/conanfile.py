# SPDX-License-Identifier: MIT
"""The libraries for Conan: `conan create packaging/conan --build=missing` in a checkout."""

import re
from pathlib import Path

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

REPOSITORY = Path(__file__).resolve().parents[2]


class Meshhood(ConanFile):
    name = "meshhood"
    description = "The connected component of a mesh inside a ball around a vertex: exact, indexed"
    license = "MIT"
    topics = ("mesh", "neighborhood", "geometry")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False], "with_io": [True, False]}
    default_options = {"shared": False, "fPIC": True, "with_io": True}
    implements = ["auto_shared_fpic"]

    def set_version(self):
        text = load(self, REPOSITORY / "include/meshhood/version.h")
        self.version = ".".join(re.findall(r"define MESHHOOD_VERSION_\w+ (\d+)", text))

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "NOTICE", "cmake/*", "include/*", "src/*", "io/*"):
            copy(self, pattern, REPOSITORY, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def validate(self):
        check_min_cppstd(self, 20)
        if self.settings.compiler == "msvc" and self.options.with_io:
            raise ConanInvalidConfiguration("meshhood::io has not been tried with Visual C++: set with_io=False")

    def requirements(self):
        self.requires("highway/[>=1.0.3]", visible=False)
        self.requires("xxhash/[>=0.8]", visible=False)
        if self.options.with_io:
            self.requires("fmt/[>=9]", visible=False)
            self.requires("fast_float/[>=3.4]", visible=False)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["MESHHOOD_BUILD_IO"] = bool(self.options.with_io)
        toolchain.cache_variables["MESHHOOD_BUILD_CLI"] = False
        for library, header in (("highway", "HIGHWAY"), ("xxhash", "XXHASH")):
            includes = self.dependencies[library].cpp_info.aggregated_components().includedirs
            toolchain.cache_variables[f"MESHHOOD_{header}_INCLUDE_DIR"] = includes[0]
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        for text in ("LICENSE", "NOTICE"):
            copy(self, text, self.source_folder, Path(self.package_folder, "licenses"))
        for folder in ("cmake", "pkgconfig"):
            rmdir(self, Path(self.package_folder, "lib", folder))  # CMakeDeps and PkgConfigDeps write these
        rmdir(self, Path(self.package_folder, "share"))

    def package_info(self):
        core = self.cpp_info.components["meshhood"]
        core.set_property("cmake_target_name", "meshhood::meshhood")
        core.libs = ["meshhood"]
        if self.settings.os in ("Linux", "FreeBSD"):
            core.system_libs = ["pthread", "m"]
        if self.options.with_io:
            io = self.cpp_info.components["io"]
            io.set_property("cmake_target_name", "meshhood::io")
            io.set_property("pkg_config_name", "meshhood-io")
            io.libs = ["meshhood_io"]
            io.requires = ["meshhood"]
