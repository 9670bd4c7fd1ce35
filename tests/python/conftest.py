"""The programs of the build beside the module, and logs that they made."""
import csv
import json
import os
import pathlib
import subprocess

import pytest
import trivela

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["TRIVELA_BUILD"])


def program(*words, exit_code=0):
    """What `trivela WORDS` writes to standard output."""
    done = subprocess.run([BUILD / "trivela", *map(str, words)], capture_output=True, text=True)
    assert done.returncode == exit_code, done.stderr
    return done.stdout


def refusal(*words):
    """What `trivela WORDS` says is wrong, without the program's name."""
    done = subprocess.run([BUILD / "trivela", *map(str, words)], capture_output=True, text=True)
    assert done.returncode in (1, 2)
    return done.stderr.removeprefix("trivela: ").strip()


def answer(*words, exit_code=0):
    """The same of --json."""
    return json.loads(program(*words, "--json", exit_code=exit_code))


def vectors(name):
    """The rows of tests/vectors/NAME, as texts."""
    lines = [line for line in (ROOT / "tests/vectors" / name).read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


@pytest.fixture(scope="session", autouse=True)
def one_build():
    """A log says which version wrote it: module and program must be of one build."""
    assert f"trivela {trivela.__version__}\n" in program("--version"), "build the module and the program anew"


@pytest.fixture(scope="session")
def experiment(tmp_path_factory):
    """A log of two arms, four matches each, every decision recorded."""
    log = tmp_path_factory.mktemp("logs") / "ab.db"
    program("simulate", "--arms", "stopped,moving", "--matches", 4, "--possessions", 6, "--every-cycle", "--out", log)
    return log


@pytest.fixture(scope="session")
def scans(tmp_path_factory):
    """A scan record of the table of a robot, with what was really kicked in scans.csv."""
    record = tmp_path_factory.mktemp("scans") / "scans.db"
    program("scan", "--synthesize", record, "--set-points", ROOT / "config/robots/cambada_1.toml", "--lobs", 3, "--speed-sd-mps", 0.05,
            "--truth", record.with_suffix(".csv"))
    return record
