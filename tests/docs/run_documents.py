#!/usr/bin/env python3
"""Runs the commands that documents show and compares what they print with what the documents show.

    run_documents.py [--build DIR] [--full] [--update] [DOCUMENT...]     default: every document

Without --full what takes long runs reduced: then the lines are compared, their numbers are not. --update writes what the
commands print into the documents, in place, wherever it differs; a block is written only where its command ran whole.
"""
import argparse
import pathlib
import sys
import tempfile

from document import DocumentError, parse
from listed import listed_problems
from rehearsal import Rehearsal

ROOT = pathlib.Path(__file__).resolve().parents[2]


def documents(root):
    """Every document whose commands are promises: all but the history."""
    named = [root / name for name in ("README.md", "CONTRIBUTING.md", "idl/README.md", "log/schema/README.md")]
    return [*named, *sorted((root / "docs").glob("**/*.md")), *sorted((root / "tests/experiment").glob("*.md"))]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    arguments.add_argument("--full", action="store_true")
    arguments.add_argument("--update", action="store_true")
    arguments.add_argument("--listed", action="store_true", help="what needs no run: the lists, verbs, flags, figures")
    arguments.add_argument("document", nargs="*", type=pathlib.Path)
    flags = arguments.parse_args()
    everything = documents(ROOT)
    chosen = [path.resolve() for path in flags.document] or everything
    try:
        if flags.listed:
            problems = listed_problems(ROOT, [parse(str(p.relative_to(ROOT)), p.read_text()) for p in everything], flags.build)
        else:
            problems = []
            for path in chosen:
                with tempfile.TemporaryDirectory(prefix="trivela-docs-") as folder:
                    document = parse(str(path.relative_to(ROOT)), path.read_text())
                    rehearsal = Rehearsal(ROOT, flags.build.resolve(), pathlib.Path(folder).resolve(), flags.full, flags.update)
                    problems += rehearsal.play(document)
                    if flags.update and rehearsal.edits:
                        path.write_text("\n".join(rehearsal.updated(document)))
                        print(f"{document.name}: {len(rehearsal.edits)} blocks written again")
    except DocumentError as error:
        problems = [str(error)]
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"{len(problems)} problems" if problems else "the documents show what the commands print")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
