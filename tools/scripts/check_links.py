#!/usr/bin/env python3
"""Checks that every relative link in Markdown files leads somewhere.

    check_links.py           the files of the repository; links may only name files of it
    check_links.py FOLDER    all files below a folder, as installed

A link names a file or folder, from where the Markdown file lies, and may end in the anchor of a
heading, as GitHub makes it of the heading's text. Links to other sites are not followed.
"""

import pathlib
import re
import sys
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The target stands in the second pair of brackets; the text before may break over a line.
LINK = re.compile(r"\]\(\s*<?([^()\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
FENCE = re.compile(r"^ *(```|~~~).*?^ *\1", re.MULTILINE | re.DOTALL)
# Within a paragraph.
CODE = re.compile(r"(`+)(?!`)(?:(?!\n\n).)+?(?<!`)\1(?!`)", re.DOTALL)
HEADING = re.compile(r"^#{1,6} +(.*?) *#*$", re.MULTILINE)
OTHER_SITE = re.compile(r"[a-z][a-z0-9+.-]*:", re.IGNORECASE)


def blanked(match):
    """As many lines as what was matched, without its text."""
    return "\n" * match[0].count("\n")


def anchors(path, known):
    """The anchors of a Markdown file's headings."""
    if path not in known:
        seen = known[path] = {}
        for heading in HEADING.findall(FENCE.sub(blanked, path.read_text())):
            text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
            slug = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
            count = sum(name == slug for name in seen.values())
            seen[f"{slug}-{count}" if count else slug] = slug
    return known[path]


def faults_of(path, exists, known):
    """A line for each link of one file that leads nowhere."""
    text = CODE.sub(lambda match: "x" + blanked(match), FENCE.sub(blanked, path.read_text()))
    for link in LINK.finditer(text):
        if OTHER_SITE.match(link[1]):
            continue
        name, _, anchor = urllib.parse.unquote(link[1]).partition("#")
        target = (path.parent / name).resolve() if name else path.resolve()
        line = text.count("\n", 0, link.start()) + 1
        if not exists(target):
            yield line, f"{link[1]}: no such file"
        elif anchor and target.suffix == ".md" and anchor not in anchors(target, known):
            yield line, f"{link[1]}: no such heading"


def is_made(path):
    """Whether it lies in a folder that the repository leaves out."""
    first = path.relative_to(ROOT).parts[0]
    return first.startswith("build") or first in (".git", ".cache", "out")


def main():
    arguments = sys.argv[1:]
    if len(arguments) > 1 or arguments[:1] == ["--help"]:
        print(__doc__, file=sys.stderr)
        return 2
    folder = pathlib.Path(arguments[0]).resolve() if arguments else ROOT
    every = {path for path in folder.rglob("*") if arguments or not is_made(path)}

    def exists(target):
        return target == folder or target in every

    paths = sorted(path for path in every if path.suffix == ".md")
    known, faults = {}, 0
    for path in paths:
        for line, fault in faults_of(path, exists, known):
            print(f"{path.relative_to(folder)}:{line}: {fault}")
            faults += 1
    if not paths:
        print(f"{folder}: no Markdown file", file=sys.stderr)
    elif not faults:
        print(f"{len(paths)} files, all links lead somewhere")
    return 1 if faults or not paths else 0


if __name__ == "__main__":
    sys.exit(main())
