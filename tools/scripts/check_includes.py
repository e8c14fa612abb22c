#!/usr/bin/env python3
"""Checks that every include follows the layers of the modules, and prints them.

    check_includes.py             lists includes that point upward; fails where there is one
    check_includes.py --list      prints every include between two modules, with its count
    check_includes.py --diagram   prints the modules as the diagram that CONTRIBUTING.md shows

The layers are read from CMake: `nearfield_module(NAME LINK ...)` for the engine and the passes,
`target_link_libraries(nearfield_NAME ...)` for the folders of tools. A file may include files of
its own module and of the modules that it links, directly or through others. Tools and examples
include nothing of the engine but the public headers.
"""

import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]((?:engine|passes|tools)/[^>"]+)[>"]', re.MULTILINE)
# Programs whose target is not named like their folder.
PROGRAMS = {"nearfield_program": "cli", "bench_peers": "peers"}


def engine_layers():
    """The modules that each module links directly, in the order of CMakeLists.txt."""
    layers = {}
    text = (ROOT / "CMakeLists.txt").read_text()
    for name, linked in re.findall(r"nearfield_module\((\w+)(?: LINK ([^)]*))?\)", text):
        direct = layers.setdefault(name, [])
        direct += [word for word in linked.split() if word in layers and word not in direct]
    return layers


def tool_layers():
    """The folders of tools that each folder of tools links directly."""
    layers = {f"tools/{entry.name}": [] for entry in (ROOT / "tools").iterdir() if entry.is_dir()}
    for path in sorted((ROOT / "tools").rglob("CMakeLists.txt")):
        for target, linked in re.findall(r"target_link_libraries\((\w+)([^)]*)\)", path.read_text()):
            folder = "tools/" + PROGRAMS.get(target, target.removeprefix("nearfield_"))
            if folder in layers:
                words = ("tools/" + word.removeprefix("nearfield_") for word in linked.split())
                layers[folder] += [word for word in words if word in layers]
    return layers


def all_below(layers, name):
    """The modules that `name` may include: itself and everything it links."""
    found, waiting = set(), [name]
    while waiting:
        module = waiting.pop()
        if module not in found:
            found.add(module)
            waiting += layers[module]
    return found


def module_of(path):
    """The module of a file, given relative to the top of the project; None outside of modules."""
    parts = pathlib.PurePosixPath(path).parts
    if parts[0] == "passes":
        return "passes"
    if parts[0] == "engine" and len(parts) > 2:
        return parts[1]
    return f"tools/{parts[1]}" if parts[0] == "tools" and len(parts) > 2 else None


def sources():
    """All C++ files that stand in a module, or should."""
    for top in ("engine", "passes", "tools", "examples"):
        for path in sorted((ROOT / top).rglob("*.[ch]pp")):
            yield path, path.relative_to(ROOT).as_posix()


def check(layers):
    """The includes between modules, counted, and a line for each fault."""
    below = {name: all_below(layers, name) for name in layers}
    arrows, faults = collections.Counter(), []
    for path, name in sources():
        module = module_of(name)
        if module not in layers and not name.startswith("examples/"):
            faults.append(f"{name}: stands in no module")
            continue
        for match in INCLUDE.finditer(path.read_text()):
            target = module_of(match[1])
            if target != module:
                arrows[module or "examples", target] += 1
            if module is None or target not in below[module]:
                faults.append(f"{name}: includes {match[1]}, which is not below {module or 'examples'}")
    return arrows, faults


def diagram(layers):
    """The modules as a Mermaid flow chart, the topmost first; an arrow for each direct link."""
    lines = ["flowchart TD"]
    for name, linked in reversed(layers.items()):
        if linked:
            lines.append(f"    {name} --> {' & '.join(linked)}")
    return "\n".join(lines)


def main():
    engine = engine_layers()
    layers = engine | tool_layers()
    arguments = sys.argv[1:]
    if arguments == ["--diagram"]:
        print(diagram(engine))
        return 0
    if arguments not in ([], ["--list"]):
        print(__doc__, file=sys.stderr)
        return 2
    arrows, faults = check(layers)
    if arguments:
        for (source, target), count in sorted(arrows.items()):
            print(f"{source} -> {target}: {count}")
    shown = f"```mermaid\n{diagram(engine)}\n```"
    if shown not in (ROOT / "CONTRIBUTING.md").read_text():
        faults.append("CONTRIBUTING.md: the diagram is not the one that --diagram prints")
    print("\n".join(faults) or f"{sum(arrows.values())} includes between modules, all downward")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
