"""What a document shows: its blocks of code with the commands in them, and the annotations that stand before them.

An annotation is an HTML comment, which a reader does not see, before the block (or the table) that it is about:

    <!-- run: KEY="VALUE" ... -->      a block of commands; none is needed where a command just runs
    <!-- output: of="NAME" ... -->     the block is a part of what the command of that name printed
    <!-- file: name="arms.toml" -->    the block is a file; it is written into the folder where the commands run
    <!-- numbers: of="NAME" -->        each number of the next paragraph or table stands in what that command printed

A command is a line of a block that begins with `$ ` or with a program of this repository. What follows it up to the next
command is what it prints; where nothing follows, it has only to end as documented.
"""
import re
from dataclasses import dataclass, field

KEYS = {
    "run": {
        "name",  # by which other blocks name what its commands printed
        "reduced",  # "OLD => NEW", several with ";": what stands in for a command that takes over 10 s
        "from", "until",  # regular expressions: first and last line that is shown
        "exit",  # exit code, 0 where nothing is said
        "reduced_exit",  # another one that a reduced run may have, such as 3 for too few kicks to learn from
        "setup",  # commands, with ";", that make what the reader has by then
        "together",  # "yes": all run at once, the last one's end ends the others
        "interrupt",  # Ctrl-C once this was printed
        "figure",  # "MADE => docs/figures/X.svg", several with ";"
        "shape",  # "no": a reduced run prints other lines
    },
    "output": {"of", "from", "until", "shape"},
    "file": {"name"},
    "numbers": {"of"},
}
ANNOTATION = re.compile(r"^\s*<!-- (run|output|file|numbers): ")
VALUE = re.compile(r'(\w+)="([^"]*)"')
COMMAND = re.compile(r"^(?:\$ |(?=build/\w+/|\./(?:quickstart|run_tests)|sqlite3 |python3 |ctest |cmake |apt))")
SYNOPSIS = re.compile(r"^trivela [a-z]")
INLINE = re.compile(r"`(?:build/release/)?(trivela(?: [^`]*)?)`", re.S)


class DocumentError(Exception):
    pass


@dataclass
class Command:
    text: str
    line: int  # where it stands, from 1
    begin: int  # lines of the document that show what it prints: [begin, end), from 0
    end: int
    shown: list  # those lines, without the block's indent


@dataclass
class Block:
    kind: str  # code, text
    line: int
    indent: int
    lines: list
    about: str = ""  # run, output, file, numbers
    keys: dict = field(default_factory=dict)
    commands: list = field(default_factory=list)
    begin: int = 0
    end: int = 0


@dataclass
class Document:
    name: str
    lines: list
    blocks: list
    synopses: list  # (line, text): `trivela VERB --flag` in running text and in blocks of usage


def _annotation(name, lines, i):
    """The annotation that begins in line i: (about, keys, next line)."""
    end = next((j for j in range(i, len(lines)) if "-->" in lines[j]), None)
    if end is None:
        raise DocumentError(f"{name}:{i + 1}: the annotation has no end")
    text = " ".join(lines[i : end + 1])
    about = ANNOTATION.match(text).group(1)
    rest = text.split(": ", 1)[1].rsplit("-->", 1)[0]
    keys = dict(VALUE.findall(rest))
    if VALUE.sub("", rest).strip():
        raise DocumentError(f"{name}:{i + 1}: not KEY=\"VALUE\": {VALUE.sub('', rest).strip()}")
    for key in keys:
        if key not in KEYS[about]:
            raise DocumentError(f"{name}:{i + 1}: {key}: unknown key of {about}")
    return about, keys, end + 1


def _commands(block, first):
    """The commands of a block whose first line is the document's line `first` (from 0)."""
    i, found = 0, []
    while i < len(block.lines):
        match = COMMAND.match(block.lines[i])
        if not match:
            i += 1
            continue
        begin, text = i, block.lines[i][match.end() :]
        while text.endswith("\\") and i + 1 < len(block.lines):
            i += 1
            text = text[:-1] + block.lines[i].strip()
        i += 1
        shown = i
        while i < len(block.lines) and not COMMAND.match(block.lines[i]):
            i += 1
        end = i
        while shown < end and not block.lines[shown].strip():
            shown += 1
        while end > shown and not block.lines[end - 1].strip():
            end -= 1
        found.append(Command(text, first + begin + 1, first + shown, first + end, block.lines[shown:end]))
    return found


def parse(name, text):
    """Reads a document. Raises DocumentError naming document and line."""
    lines, blocks, synopses = text.split("\n"), [], []
    i, pending, after_blank = 0, None, True

    def add(block):
        nonlocal pending
        if pending:
            about, block.keys, line = pending
            if (block.kind == "text") != (about == "numbers"):
                raise DocumentError(f"{name}:{line}: a block of {'text' if block.kind == 'text' else 'code'} follows")
            block.about, pending = about, None
        if block.kind == "code" and block.about != "file":
            block.commands = _commands(block, block.begin)
            if block.about == "run" and not block.commands:
                raise DocumentError(f"{name}:{block.line}: no command in the block")
        blocks.append(block)

    while i < len(lines):
        line = lines[i]
        indent = len(line) - len(line.lstrip())
        if not line.strip():
            i, after_blank = i + 1, True
        elif ANNOTATION.match(line):
            if pending:
                raise DocumentError(f"{name}:{pending[2]}: no block follows")
            about, keys, following = _annotation(name, lines, i)
            pending, i, after_blank = (about, keys, i + 1), following, True
        elif line.lstrip().startswith("```"):
            end = next(j for j in range(i + 1, len(lines)) if lines[j].lstrip().startswith("```"))
            add(Block("code", i + 1, indent, [text[indent:] for text in lines[i + 1 : end]], begin=i + 1, end=end))
            i = end + 1
        elif indent >= 4 and after_blank:
            end = i
            while end < len(lines) and (not lines[end].strip() or len(lines[end]) - len(lines[end].lstrip()) >= indent):
                end += 1
            while not lines[end - 1].strip():
                end -= 1
            add(Block("code", i + 1, indent, [text[indent:].rstrip() for text in lines[i:end]], begin=i, end=end))
            i = end
        else:
            end = i
            while end < len(lines) and lines[end].strip() and not ANNOTATION.match(lines[end]):
                end += 1
            add(Block("text", i + 1, indent, lines[i:end], begin=i, end=end))
            for found in INLINE.finditer("\n".join(lines[i:end])):
                before = "\n".join(lines[i:end])[: found.start()].count("\n")
                synopses.append((i + 1 + before, " ".join(found.group(1).split())))
            i, after_blank = end, False
    if pending:
        raise DocumentError(f"{name}:{pending[2]}: no block follows")
    for block in blocks:
        if block.kind == "code" and block.lines and SYNOPSIS.match(block.lines[0]):
            synopses.append((block.line, " ".join(" ".join(block.lines).split())))
    return Document(name, lines, blocks, synopses)
