#!/usr/bin/env python3
"""Follows docs/how_to_add.md: its blocks are the edits, its commands the proof.

    how_to_add.py --check                      the edits of every recipe apply to the tree as it is
    how_to_add.py [--folder DIR] [RECIPE...]   by hand: makes them in a copy of the tree (a folder of its own, or DIR, which is
                                               kept), builds the programs there and runs the recipes' commands; default: all
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/how_to_add.md"
HUNK = "@@"


@dataclass
class Edit:
    line: int  # of the page, from 1
    path: str
    hunks: list  # of lines, each with its mark " ", "-" or "+"


@dataclass
class Recipe:
    title: str
    edits: list = field(default_factory=list)
    commands: list = field(default_factory=list)


def edit_of(line, lines):
    """The edit that a block says. Raises ValueError where it says none."""
    if not lines or not lines[0].startswith("+++ "):
        raise ValueError(f"line {line}: a block of edits begins with +++ FILE")
    hunks = [[]]
    for text in lines[1:]:
        if text == HUNK:
            hunks.append([])
        elif text and text[0] not in " -+":
            raise ValueError(f"line {line}: neither ' ', '-' nor '+': {text}")
        else:
            hunks[-1].append(text or " ")
    return Edit(line, lines[0][4:], hunks)


def recipes_of(text):
    """The page's recipes: its headings of second order with their edits and commands."""
    recipes, block, begin = [], None, 0
    for number, line in enumerate(text.split("\n"), 1):
        if block is not None and line == "```":
            recipes[-1].edits.append(edit_of(begin, block))
            block = None
        elif block is not None:
            block.append(line)
        elif line == "```diff":
            block, begin = [], number
        elif line.startswith("## "):
            recipes.append(Recipe(line[3:]))
        elif match := re.match(r"    \$ (.*)", line):
            recipes[-1].commands.append(match[1])
    return recipes


def problem_of(edit, files, read):
    """Makes the edit in `files`, {path: text}, which `read` fills; why it cannot be made, or ""."""
    if edit.path not in files:
        files[edit.path] = read(edit.path)
    for hunk in edit.hunks:
        before = "".join(line[1:] + "\n" for line in hunk if line[0] != "+")
        after = "".join(line[1:] + "\n" for line in hunk if line[0] != "-")
        if not before:  # a new file
            if files[edit.path] is not None:
                return f"line {edit.line}: {edit.path} exists; which of its lines does this stand beside?"
            files[edit.path] = after
            continue
        if files[edit.path] is None:
            return f"line {edit.line}: there is no {edit.path}"
        text = "\n" + files[edit.path]
        found = text.count("\n" + before)
        if found != 1:
            return f"line {edit.line}: {edit.path} has these lines {found} times, not once:\n{before}"
        files[edit.path] = text.replace("\n" + before, "\n" + after)[1:]
    return ""


def apply(recipes, root):
    """The edits of the recipes, one after another: ({path: text}, problems)."""

    def read(path):
        return (root / path).read_text() if (root / path).exists() else None

    files = {}
    problems = [problem_of(edit, files, read) for recipe in recipes for edit in recipe.edits]
    return files, [problem for problem in problems if problem]


def play(recipes, folder):
    """Copies the tree with the edits made, builds it and runs the commands. Raises CalledProcessError where one fails."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True, check=True)
    edited = apply(recipes, ROOT)[0]
    names = {*filter(None, listed.stdout.split("\n")), *edited}
    for stale in [path for path in folder.rglob("*") if path.is_file() and path.relative_to(folder).parts[0] not in ("build", "out")]:
        if str(stale.relative_to(folder)) not in names:
            stale.unlink()
    for name in sorted(names):
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        content = edited[name].encode() if name in edited else (ROOT / name).read_bytes()
        if not target.exists() or target.read_bytes() != content:  # what is as it was is not built again
            target.write_bytes(content)
            target.chmod((ROOT / name).stat().st_mode if (ROOT / name).exists() else 0o644)
    shutil.rmtree(folder / "out", ignore_errors=True)
    (folder / "out").mkdir()
    builds = ["cmake --preset release", "cmake --build --preset release --target programs"]
    for command in builds + [command for recipe in recipes for command in recipe.commands]:
        print(f"\n$ {command}", flush=True)
        subprocess.run(command, shell=True, cwd=folder, check=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--check", action="store_true")
    arguments.add_argument("--folder", type=pathlib.Path)
    arguments.add_argument("recipe", nargs="*", help='such as "A policy"')
    flags = arguments.parse_args()
    recipes = recipes_of(PAGE.read_text())
    unknown = set(flags.recipe) - {recipe.title for recipe in recipes}
    if unknown:
        arguments.error(f"{PAGE.name} has no {', '.join(sorted(unknown))}")
    chosen = [recipe for recipe in recipes if recipe.edits and (not flags.recipe or recipe.title in flags.recipe)]
    problems = apply(chosen, ROOT)[1]
    for problem in problems:
        print(f"docs/how_to_add.md: {problem}", file=sys.stderr)
    if problems:
        return 1
    print(f"{sum(len(recipe.edits) for recipe in chosen)} edits of {len(chosen)} recipes apply")
    if flags.check:
        return 0
    if flags.folder:
        play(chosen, flags.folder.resolve())
    else:
        with tempfile.TemporaryDirectory(prefix="trivela-how-to-add-") as folder:
            play(chosen, pathlib.Path(folder))
    return 0


if __name__ == "__main__":
    sys.exit(main())
