#!/usr/bin/env bash
# Checks the vcpkg and Conan recipes as far as possible without either tool: they parse, their
# version is that of the headers, and every path and option in them exists.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

python3 - "$SOURCE" <<'CHECK'
import ast, json, pathlib, re, sys

source = pathlib.Path(sys.argv[1])
header = (source / "include/nearfield/version.hpp").read_text()
version = re.search(r'#define NEARFIELD_VERSION "(.*)"', header).group(1)
folder = source / "packaging"

manifest = json.loads((folder / "vcpkg/nearfield/vcpkg.json").read_text())
assert manifest["version"] == version, f"vcpkg.json is of version {manifest['version']}, not {version}"

port = folder / "vcpkg/nearfield/portfile.cmake"
top = (port.parent / re.search(r"CURRENT_PORT_DIR}/([./]*)", port.read_text()).group(1)).resolve()
assert top == source.resolve(), f"the port takes its sources from {top}"

recipe = (folder / "conan/conanfile.py").read_text()
for text in recipe, (folder / "conan/test_package/conanfile.py").read_text():
    ast.parse(text)
found = re.search(r"export_sources.*?for pattern in \((.*?)\):", recipe, re.DOTALL).group(1)
patterns = ast.literal_eval(f"({found})")
for pattern in patterns:
    assert list(source.glob(pattern)), f"the Conan recipe packs {pattern}, which is nowhere"
needed = {"CMakeLists.txt", "LICENSE", "cmake/*", "engine/*", "include/*", "passes/*", "shaders/*"}
assert needed <= set(patterns), f"the Conan recipe leaves out {needed - set(patterns)}"

consumer = re.search(r"PROJECT_SOURCE_DIR}/(\S*main\.cpp)",
                     (folder / "conan/test_package/CMakeLists.txt").read_text()).group(1)
assert (folder / "conan/test_package" / consumer).is_file(), f"{consumer} is nowhere"

project = (source / "CMakeLists.txt").read_text()
for text in recipe, port.read_text():
    for option in set(re.findall(r"NEARFIELD_[A-Z_]+", text)) - {"NEARFIELD_VERSION"}:
        assert f"option({option} " in project, f"{option} is no option of the project"
CHECK
