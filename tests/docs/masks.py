"""When two prints of one command are the same: but for what differs from run to run and from machine to machine.

Each mask is as narrow as the words around the number allow; whatever stands in none is compared as it is.
"""
import re
from decimal import Decimal

NUMBER = r"\d+(?:\.\d+)?"
MASKS = [
    ("a uuid", re.compile(r"\b[0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12}\b"), "UUID"),
    ("the configuration's digest, paths in it", re.compile(r"configuration [0-9a-f]{12}\b"), "configuration DIGEST"),
    ("the program's version", re.compile(r"(version |^trivela )\d+\.\d+\.\d+(-[0-9a-z]+)*\b"), r"\1VERSION"),
    ("a session's number, of its uuid", re.compile(r"^\d{17,19} (?=as recorded|CHANGED)"), "SESSION "),
    ("rows a second", re.compile(rf"rows, {NUMBER} a second, queue high-water \d+ of"),
     "rows, SPEED a second, queue high-water ROWS of"),
    ("a match's time and speed", re.compile(rf"in {NUMBER} s: {NUMBER} times real time"), "in TIME s: SPEED times real time"),
    ("an experiment's time and speed", re.compile(rf"in {NUMBER} s with (\d+ jobs?): \d+ a second"),
     r"in TIME s with \1: SPEED a second"),
    ("an arm's speed", re.compile(r"^(\S.* \d\.\d{4}) +\d+$"), r"\1 SPEED"),
    ("a drive's time", re.compile(rf"( s of play) in {NUMBER} s:"), r"\1 in TIME s:"),
    ("why a kernel has no such CAN bus", re.compile(r"\b(no bus can\d+:) .*"), r"\1 WHY"),
    ("a day", re.compile(r"\b20\d\d-[01]\d-[0-3]\d\b"), "DAY"),
    ("a clock's time", re.compile(r"\bT?\d\d:?\d\d:?\d\d(?:\.\d+)?Z\b"), "CLOCK"),
]


def masked(lines):
    """The lines without what may differ, and without blanks at their ends."""
    result = []
    for line in lines:
        line = line.rstrip()
        for _, pattern, instead in MASKS:
            line = pattern.sub(instead, line)
        result.append(line)
    return result


def shape(lines):
    """The lines with # for each number: what a reduced run has in common with the whole one."""
    result = []
    for line in masked(lines):
        line = re.sub(r"(?<![\w.])[-+]?\d[\d.,]*(?:e[-+]?\d+)?", "#", line)
        result.append(re.sub(r"[ ]+", " ", line).strip())
    return result


def numbers(text):
    """The numbers of a text as they are written, without sign and separators of thousands."""
    return re.findall(r"(?<![\w.])\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w])", re.sub(r"(?<=\d),(?=\d{3}\b)", "", text))


def stands_in(number, printed):
    """Whether one of the printed numbers is this one, or rounds to it."""
    half = Decimal(5).scaleb(Decimal(number).as_tuple().exponent - 1)
    return any(abs(Decimal(other) - Decimal(number)) <= half for other in printed)
