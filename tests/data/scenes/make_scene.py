#!/usr/bin/env python3
"""Writes a scene of many small shapes, each of them one object, to the standard output.

    make_scene.py gears    13 gears in mesh, 391 edges, 31 pairs of boxes that meet (gears.json)
    make_scene.py crowd    1,000 stars of 50 vertices side by side (0.9 MB)
    make_scene.py heap     the same thrown anywhere: most pairs lie deep in each other (0.9 MB)

All ask for the penetrating vertices of every ordered pair whose boxes meet, without records.
"""
import json
import math
import random
import sys


def gear(teeth):
    """Four vertices a tooth: up, across, down, along the root."""
    ring = []
    for tooth in range(teeth):
        for part, radius in ((0.0, 0.75), (0.2, 1.0), (0.45, 1.0), (0.65, 0.75)):
            angle = 2.0 * math.pi * (tooth + part) / teeth
            ring.append([round(radius * math.cos(angle), 4), round(radius * math.sin(angle), 4)])
    return ring


def gears():
    places = [(column, row) for row in range(3) for column in range(4)] + [(4, 0)]
    objects = []
    for index, (column, row) in enumerate(places):
        rings = [gear(8 if index % 2 == 1 else 7)]
        if index == 0:  # on a shaft with three sides
            rings.append([[0.2, 0.0], [-0.1, 0.15], [-0.1, -0.15]])
        objects.append((rings, [1.8 * column, 1.8 * row, 11.0 * index]))
    return objects, 0.01


def star(numbers, vertices):
    ring = []
    for i in range(vertices):
        angle = 2.0 * math.pi * i / vertices
        radius = numbers.uniform(0.6, 1.0)
        ring.append([round(radius * math.cos(angle), 4), round(radius * math.sin(angle), 4)])
    return ring


def stars(numbers, places):
    objects = []
    for x, y in places:
        pose = [round(number, 4) for number in (x, y, numbers.uniform(0, 360))]
        objects.append(([star(numbers, 50)], pose))
    return objects, 0.01


def crowd():
    numbers = random.Random(1)
    spacing, jitter = 1.716, 0.25
    places = [(spacing * (i % 40) + numbers.uniform(-jitter, jitter),
               spacing * (i // 40) + numbers.uniform(-jitter, jitter)) for i in range(1000)]
    return stars(numbers, places)


def heap():
    numbers = random.Random(1)
    side = 53.0
    places = [(numbers.uniform(0, side), numbers.uniform(0, side)) for _ in range(1000)]
    return stars(numbers, places)


def main():
    objects, tolerance = {"gears": gears, "crowd": crowd, "heap": heap}[sys.argv[1]]()
    scene = {
        "shapes": {f"s{i:04}": {"rings": rings} for i, (rings, _) in enumerate(objects)},
        "instances": {f"o{i:04}": {"shape": f"s{i:04}", "pose": pose}
                      for i, (_, pose) in enumerate(objects)},
        "queries": [{"query": "penetration", "pairs": "all", "points": "vertices",
                     "records": False, "tolerance": tolerance}],
    }
    json.dump(scene, sys.stdout, separators=(",", ":"))
    sys.stdout.write("\n")


main()
