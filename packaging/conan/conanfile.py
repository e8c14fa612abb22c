"""Conan 2 recipe: packages what `cmake --install` puts in place.

    conan create packaging/conan --build=missing
"""

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rm

required_conan_version = ">=2.0"


class NearfieldConan(ConanFile):
    name = "nearfield"
    description = "2D proximity queries between arbitrary polygons on a Vulkan GPU"
    license = "MIT"
    topics = ("geometry", "collision", "proximity", "vulkan")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False]}
    default_options = {"shared": False}

    @property
    def _top(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        header = load(self, os.path.join(self._top, "include", "nearfield", "version.hpp"))
        self.version = re.search(r'#define NEARFIELD_VERSION "(.*)"', header).group(1)

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "*.md", "LICENSE", "cmake/*", "docs/*", "engine/*",
                        "include/*", "passes/*", "shaders/*", "tools/debug/*"):
            copy(self, pattern, src=self._top, dst=self.export_sources_folder,
                 excludes=("build*", "tests/*"))

    def requirements(self):
        self.requires("eigen/3.4.0", visible=False)
        self.requires("highway/[>=1.0 <2]")
        self.requires("vulkan-headers/[>=1.3]", transitive_headers=True)

    def build_requirements(self):
        self.tool_requires("cmake/[>=3.25]")
        self.tool_requires("glslang/[>=1.3]")

    def validate(self):
        check_min_cppstd(self, 20)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        # Highway's own CMake package, which nearfield searches for, has another name.
        dependencies = CMakeDeps(self)
        dependencies.set_property("highway", "cmake_file_name", "hwy")
        dependencies.set_property("highway", "cmake_target_name", "hwy::hwy")
        dependencies.generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update({
            "NEARFIELD_BUILD_TESTS": False,
            "NEARFIELD_BUILD_TOOLS": False,
            "NEARFIELD_WARNINGS_AS_ERRORS": False,
        })
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        # A package contains one kind of library, but the install step installs both.
        library, files = (("libnearfield.a", "nearfield-static*") if self.options.shared
                          else ("libnearfield.so*", "nearfield-shared*"))
        rm(self, library, os.path.join(self.package_folder, "lib"))
        rm(self, files, os.path.join(self.package_folder, "lib", "cmake", "nearfield"))

    def package_info(self):
        self.cpp_info.libs = ["nearfield"]
        self.cpp_info.set_property("cmake_file_name", "nearfield")
        self.cpp_info.set_property("cmake_target_name", "nearfield::nearfield")
        self.cpp_info.set_property("pkg_config_name", "nearfield")
        if not self.options.shared:
            self.cpp_info.system_libs = ["dl"]
