#!/usr/bin/env python3
"""Compares every answer of two builds of the command line, bit for bit.

    compare_builds.py OLD NEW [--pairs N] [--techniques cpu,compute,raster] [--seed S]

OLD and NEW are two `nearfield` programs. Both answer every query about all pairs of the outlines in
tests/data, every scene there, and N random and degenerate pairs, by each technique. Numbers are
compared as the JSON prints them, which is enough digits to tell any two doubles apart; fields are
compared as files. Times and the statistics of the search are left out. Prints what differs first
and fails where anything does.
"""

import argparse
import itertools
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

DATA = pathlib.Path(__file__).resolve().parents[2] / "tests" / "data"
# Kinds of queries with what they need beside a tolerance; CPU_KINDS are the CPU's alone.
KINDS = [
    ("penetration", {}),
    ("penetration", {"points": "vertices"}),
    ("intersection", {"kind": "boundary-boundary"}),
    ("intersection", {"kind": "boundary-volume"}),
    ("intersection", {"kind": "volume-volume"}),
    ("contacts", {}),
    ("closest-point", {}),
    ("separation", {}),
    ("distance-field", {}),
]
CPU_KINDS = [
    ("intersection-test", {}),
    ("time-of-impact", {}),
    ("separation-vector", {}),
    ("containment", {}),
]
# Kinds without a tolerance.
EXACT_KINDS = ("intersection-test", "containment")
STATISTICS = {"timings_ms", "localization", "steps", "work", "device"}


def star(rng, size):
    """A ring around the origin: round, spiky or thin."""
    count = rng.choice((3, 4, 7, 12, 40))
    thin = rng.choice((1.0, 1.0, 0.3, 1e-3))
    depth = rng.random()
    ring = []
    for i in range(count):
        angle, radius = 2 * math.pi * i / count, size * (1 - depth * rng.random())
        ring.append([radius * math.cos(angle), thin * radius * math.sin(angle)])
    return ring


def lattice(rng, size):
    """A ring on a coarse lattice: shared edges, coinciding corners, right angles."""
    x, y = rng.randint(1, 4), rng.randint(1, 4)
    ring = [[0, 0], [x, 0], [x, y], [0, y]]
    if rng.random() < 0.5:
        ring[2:3] = [[x, y / 2], [x / 2, y / 2], [x / 2, y]]
    return [[size / 4 * a, size / 4 * b] for a, b in ring]


def outline(rng, size):
    """Rings of a random or degenerate shape: holes, islands, repeated vertices."""
    rings = [rng.choice((star, star, lattice))(rng, size)]
    if rng.random() < 0.3:
        shrink = rng.choice((0.3, 0.5, 1e-4))
        rings.append([[shrink * x, shrink * y] for x, y in star(rng, size)])
    if rng.random() < 0.1:
        rings[0].insert(1, list(rings[0][1]))
    return rings


def random_scene(rng, pairs, kinds):
    """A scene of so many pairs of shapes, one of the kinds of queries for each."""
    scene = {"shapes": {}, "instances": {}, "queries": []}
    for pair in range(pairs):
        size = 10.0 ** rng.uniform(-1, 3)
        offset = rng.choice((0.0, 0.0, 1e6 if size > 10 else 1e3))
        for side in "ab":
            name = f"{side}{pair}"
            scene["shapes"][name] = {"rings": outline(rng, size)}
            step = rng.choice((0.0, 0.25, 0.5, 1.0))
            near = [offset + size * step * rng.choice((-1, 1, rng.uniform(-2, 2))) for _ in "xy"]
            turn = rng.choice((0, 90, rng.uniform(0, 360)))
            scene["instances"][name] = {"shape": name, "pose": near + [turn]}
            if side == "a":
                scene["instances"][name]["end_pose"] = [offset, offset, turn + 60]
        kind, options = kinds[pair % len(kinds)]
        tolerance = size * rng.choice((0.02, 0.05, 0.1))
        query = {"query": kind, "a": f"a{pair}", "b": f"b{pair}", "tolerance": tolerance, **options}
        if kind == "contacts":
            query["contact_distance"] = tolerance * rng.choice((0.5, 2))
        if kind in ("penetration", "contacts", "intersection") and pair % 3 == 0:
            query["records"] = False
        if kind == "distance-field":
            x, y = scene["instances"][f"b{pair}"]["pose"][:2]
            query["rect"] = [x - size, y - size, x + size, y + size]
        scene["queries"].append(query)
    return scene


def without_statistics(value):
    """An answer without what may differ between two builds."""
    if isinstance(value, dict):
        return {k: without_statistics(v) for k, v in value.items() if k not in STATISTICS}
    return [without_statistics(v) for v in value] if isinstance(value, list) else value


def answer(program, arguments, field):
    """Exit status, what was written to standard error where it failed, JSON, and the field's bytes."""
    field.unlink(missing_ok=True)
    done = subprocess.run([program, *arguments, "--json", "-"], capture_output=True, text=True)
    if done.returncode != 0:
        return done.returncode, re.sub(r".* ms\n", "", done.stderr)
    parsed, _ = json.JSONDecoder().raw_decode(done.stdout)
    return 0, without_statistics(parsed), field.read_bytes() if field.exists() else b""


def jobs(options, folder, field):
    """The arguments of every question that both builds are asked."""
    rng = random.Random(options.seed)
    files = sorted(DATA.glob("*.geojson"))
    for technique in options.techniques.split(","):
        kinds = KINDS + (CPU_KINDS if technique == "cpu" else [])
        for a, b in itertools.permutations(files, 2):
            for kind, extra in kinds:
                command = ["query", kind, str(a), str(b), "--technique", technique]
                command += [] if kind in EXACT_KINDS else ["-d", "5"]
                for name, value in extra.items():
                    command += [f"--{name}", value]
                if kind == "distance-field":
                    command += ["--field", str(field)]
                if kind == "time-of-impact":
                    command += ["--pose-a", "-900,0,0", "--end-pose-a", "400,0,90"]
                yield command, 1
        for scene in sorted((DATA / "scenes").glob("*.json")):
            yield ["scene", str(scene), "--technique", technique], 1
        for first in range(0, options.pairs, 100):
            path = folder / f"{technique}_{first}.json"
            pairs = min(100, options.pairs - first)
            path.write_text(json.dumps(random_scene(rng, pairs, kinds)))
            yield ["scene", str(path), "--technique", technique], pairs


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--pairs", type=int, default=10000)
    parser.add_argument("--techniques", default="cpu,compute,raster")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    asked = refused = differing = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        field = folder / "field.npy"
        for command, queries in jobs(options, folder, field):
            old, new = (answer(program, command, field) for program in (options.old, options.new))
            asked += queries
            refused += queries if old[0] != 0 else 0
            if old != new:
                differing += 1
                print(f"differs: {' '.join(command)}\n  old: {str(old)[:300]}\n  new: {str(new)[:300]}")
            if sys.stderr.isatty():
                print(f"\r{asked} queries", end="", file=sys.stderr)
    print(f"{asked} queries, {refused} refused by both or one, {differing} commands differ")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
