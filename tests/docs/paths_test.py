#!/usr/bin/env python3
"""Every path of the repository that a document names in backticks or in a link is there. The history is left out: the
changelog and the decisions say what was where when they were written."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAMED = re.compile(r"`([^`\s]+)`|\]\(([^)#\s]+)")
FENCED = re.compile(r"^```.*?^```", re.M | re.S)
PATH = re.compile(r"[\w.*-]+(/[\w.*-]+)*/?")
ELSEWHERE = {
    "config/kicker.map",  # of CAMBADA's release
}


def documents(root):
    made = {"build", "out", "node_modules", "decisions", ".git"}
    names = [path.relative_to(root) for path in sorted(root.rglob("*.md"))]
    return [str(name) for name in names if not made & set(name.parts) and name.name != "CHANGELOG.md"]


def topics(root):
    """Names of topics, which look like paths."""
    return set(re.findall(r'@topic_name\("([^"]+)"\)', " ".join(path.read_text() for path in (root / "idl").glob("*.idl"))))


def is_there(root, path):
    """A word in capitals, such as NAME, and * stand for anything."""
    pattern = path.rstrip("/") if (root / path).exists() else re.sub(r"(?<![A-Za-z])[A-Z]+(?![A-Za-z])", "*", path.rstrip("/"))
    return any(True for _ in root.glob(pattern))


def dead_paths(root, document, text, folders, other):
    """(line, path) of each path that is not there."""
    text = FENCED.sub(lambda block: "\n" * block[0].count("\n"), text)
    for found in NAMED.finditer(text):
        inline, link = found.groups()
        line = text.count("\n", 0, found.start()) + 1
        if link and "://" not in link and not (root / document).parent.joinpath(link).exists():
            yield line, link
        if inline and inline not in other and PATH.fullmatch(inline) and "/" in inline and inline.split("/")[0] in folders:
            if not is_there(root, inline):
                yield line, inline


def main():
    folders = {path.name for path in ROOT.iterdir() if path.is_dir()} - {"build", "out"}
    other = topics(ROOT) | ELSEWHERE
    problems = [f"{name}:{line}: {path} is not there" for name in documents(ROOT)
                for line, path in dead_paths(ROOT, name, (ROOT / name).read_text(), folders, other)]
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
