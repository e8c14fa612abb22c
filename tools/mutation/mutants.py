"""The list of mutants: one text file per module in the folder `mutants`.

    [name_of_the_mutant]
    file: engine/module/file.cpp
    kind: margin
    why: What the mistake breaks, in a sentence; further lines are indented.
    equivalent: Only for a mutant that changes no answer: the proof.

     a line that stays
    -a line that goes
    +a line that comes

The lines that stay and go, together, occur exactly once in the file, one after the other, whatever
their indentation; a change of the code elsewhere does not matter.
"""

import dataclasses
import hashlib
import pathlib
import re

FOLDER = pathlib.Path(__file__).resolve().parent / "mutants"
NAME = re.compile(r"\[([a-z0-9_]+)\]")
KEYS = ("file", "kind", "why", "equivalent")


@dataclasses.dataclass(frozen=True)
class Mutant:
    """A mistake that is put into one file."""

    module: str
    name: str
    file: str
    kind: str
    why: str
    equivalent: str  # the reason, or empty
    change: tuple  # lines, each with its sign

    @property
    def full_name(self):
        return f"{self.module}/{self.name}"

    @property
    def digest(self):
        """Identifies the change, whatever is said about it."""
        return hashlib.sha256("\n".join((self.file, *self.change)).encode()).hexdigest()[:16]

    def applied_to(self, text):
        """The text of the file with the mistake in it; ValueError if it does not apply."""
        lines = text.splitlines()
        wanted = [line[1:].strip() for line in self.change if line[0] != "+"]
        stripped = [line.strip() for line in lines]
        places = [
            start
            for start in range(len(lines) - len(wanted) + 1)
            if stripped[start : start + len(wanted)] == wanted
        ]
        if len(places) != 1:
            raise ValueError(f"its lines occur {len(places)} times in {self.file}, not once")
        start = places[0]
        replaced = [line[1:] for line in self.change if line[0] != "-"]
        return "\n".join(lines[:start] + replaced + lines[start + len(wanted) :]) + "\n"


def read_entry(module, name, head, change):
    """A mutant from its paragraphs; ValueError if one is not as described above."""
    values = dict.fromkeys(KEYS, "")
    key = None
    for line in head:
        found = re.match(r"([a-z]+): (.+)", line)
        if found and found[1] in KEYS:
            key = found[1]
            values[key] = found[2]
        elif key and line.startswith("  "):
            values[key] += " " + line.strip()
        else:
            raise ValueError(f"{module}/{name}: '{line}' is neither of {', '.join(KEYS)}")
    for key in ("file", "kind", "why"):
        if not values[key]:
            raise ValueError(f"{module}/{name}: no {key}")
    if not any(line[0] != " " for line in change) or not any(line[0] != "+" for line in change):
        raise ValueError(f"{module}/{name}: no change at a place")
    return Mutant(module, name, change=tuple(change), **values)


def read_file(path):
    """The mutants of one module."""
    mutants, paragraphs, name = [], [], None
    blocks = [block.split("\n") for block in re.split(r"\n\n+", path.read_text().strip("\n"))]
    for block in blocks:
        if found := NAME.fullmatch(block[0]):
            name, paragraphs = found[1], [block[1:]]
        elif name and len(paragraphs) == 1 and all(line[0] in " -+" for line in block):
            mutants.append(read_entry(path.stem, name, paragraphs[0], block))
            name = None
        else:
            raise ValueError(f"{path.name}: '{block[0]}' begins no mutant")
    if name:
        raise ValueError(f"{path.stem}/{name}: no change")
    return mutants


def read_all():
    """All mutants, by module; their names are unique."""
    mutants = [mutant for path in sorted(FOLDER.glob("*.txt")) for mutant in read_file(path)]
    names = set()
    for mutant in mutants:
        if mutant.full_name in names:
            raise ValueError(f"{mutant.full_name} is listed twice")
        names.add(mutant.full_name)
    return mutants


def faults(mutants, root):
    """A line for each mutant that does not apply to the sources in a folder."""
    found = []
    for mutant in mutants:
        path = root / mutant.file
        if not path.is_file():
            found.append(f"{mutant.full_name}: there is no {mutant.file}")
            continue
        text = path.read_text()
        try:
            if mutant.applied_to(text) == text:
                found.append(f"{mutant.full_name}: changes nothing")
        except ValueError as error:
            found.append(f"{mutant.full_name}: {error}")
    return found
