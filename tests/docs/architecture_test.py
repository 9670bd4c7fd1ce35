#!/usr/bin/env python3
"""docs/architecture.md says of modules, layers and libraries what tests/rules/rules_test.cpp keeps, and the functions of its
call chain stand in the files beside them."""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/architecture.md").read_text()
RULES = (ROOT / "tests/rules/rules_test.cpp").read_text()


def named(cell):
    return re.findall(r"`([^`]+)`", cell)


def rows(head):
    """Cells of the table whose head line begins so."""
    lines = PAGE[PAGE.index("\n" + head) :].split("\n")[3:]
    return [line.strip("|").split("|") for line in lines[: next(i for i, line in enumerate(lines) if not line.startswith("|"))]]


def map_of(text):
    """{"key", {"value/", ...}}, ... of C++ without the slashes."""
    entries = re.findall(r'\{"([^"]+)",\s*\{([^}]*)\}\}', text)
    return {key.rstrip("/"): {value.rstrip("/") for value in re.findall(r'"([^"]+)"', values)} for key, values in entries}


def part(begin, end):
    begin = RULES.index(begin)
    return RULES[begin : RULES.index(end, begin)]


class Architecture(unittest.TestCase):
    maxDiff = None

    def test_modules_include_what_the_rules_test_allows(self):
        shown = {named(cells[0])[0]: set(named(cells[2])) for cells in rows("| module |")}
        del shown["cli"]
        self.assertEqual(shown, map_of(part("kMayInclude{", "};")))

    def test_layers(self):
        shown = {named(cells[0])[0]: named(cells[1]) for cells in rows("| layers of |")}
        kept = re.findall(r'\{"(\w+)",\s*\{([^}]*)\}\}', part("kLayers{", "};"))
        self.assertEqual(shown, {module: re.findall(r'"(\w+)"', layers) for module, layers in kept})

    def test_outer_libraries(self):
        shown = {named(cells[0])[0].rstrip("/"): set(named(cells[1])) for cells in rows("| library |")}
        self.assertEqual(shown, map_of(part("users_of{", "};")))

    def test_functions_of_the_call_chain_are_in_their_files(self):
        steps, files = 0, []
        for step in re.findall(r"^\| \d+ \|(.*)\|$", PAGE, re.M):
            function, place, gives = step.split("|", 2)
            files = named(place) or files  # or: the same
            texts = " ".join((ROOT / file).read_text() for file in files)
            for name in named(function):
                for word in name.split("::"):
                    self.assertRegex(texts, rf"\b{word}\b", f"{name} is not in {files}")
            for name, file in re.findall(r"`(\w+)` \(`([\w/.]+\.\w+)`\)", gives):
                self.assertRegex((ROOT / file).read_text(), rf"\b{name}\b", f"{name} is not in {file}")
            steps += 1
        self.assertGreater(steps, 10)


if __name__ == "__main__":
    sys.exit(unittest.main())
