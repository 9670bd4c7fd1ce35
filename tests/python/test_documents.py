"""The Python of docs/python.md and of examples/python/ runs, in a folder of its own, and writes the figures that it promises."""
import os
import re
import subprocess
import sys

import pytest

from conftest import BUILD, ROOT, program

PAGE = (ROOT / "docs/python.md").read_text()
SCRIPTS = sorted((ROOT / "examples/python").glob("*.py"))


def blocks():
    """{name: text} of the page's blocks of Python, each named by the comment before it: <!-- python: NAME -->."""
    return dict(re.findall(r"<!-- python: (\w+) -->\n```python\n(.*?)```", PAGE, re.S))


def run(script, folder, *words):
    done = subprocess.run([sys.executable, str(script), *map(str, words)], cwd=folder, capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": str(BUILD / "python"), "MPLBACKEND": "Agg"})
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def lines(text):
    return [line for line in text.splitlines() if line.strip()]


def is_figure(path):
    return path.read_bytes()[:4] == b"\x89PNG" and path.stat().st_size > 5000


@pytest.fixture
def folder(tmp_path, experiment):
    (tmp_path / "match.db").write_bytes(experiment.read_bytes())
    (tmp_path / "config").symlink_to(ROOT / "config")
    return tmp_path


def test_every_block_of_the_page_is_tested():
    assert PAGE.count("```python") == len(blocks()) == 3
    assert len(PAGE.split()) < 900


def test_from_a_log_to_a_figure_takes_ten_lines(folder):
    assert len(lines(blocks()["figure"])) <= 10
    (folder / "figure.py").write_text(blocks()["figure"])
    run("figure.py", folder)
    assert is_figure(folder / "crossings.png")


def test_from_an_idea_to_an_ab_takes_forty_lines(folder):
    assert len(lines(blocks()["ab"])) <= 40
    text = blocks()["ab"]
    few = text.replace("matches=200", "matches=6")
    assert few != text
    (folder / "ab.py").write_text(few)
    assert "patient 3.5: " in run("ab.py", folder)
    assert is_figure(folder / "ab.png")


def test_the_first_kick_prints_what_the_page_shows(folder):
    (folder / "first.py").write_text(blocks()["first"])
    shown = re.search(r"prints\n\n((?:    .*\n)+)", PAGE)[1]
    assert run("first.py", folder) == re.sub(r"^    ", "", shown, flags=re.M)


def test_the_scripts_are_these():
    assert {script.name for script in SCRIPTS} == {"first_report.py", "calibrate_from_scans.py", "compare_two_nights.py", "train_a_policy.py"}


def test_train_a_policy(folder):
    said = run(ROOT / "examples/python/train_a_policy.py", folder, 3, 4)
    assert "best of 3: near_m" in said and "trained" in said
    assert is_figure(folder / "training.png")


def test_first_report(folder):
    said = run(ROOT / "examples/python/first_report.py", folder, "match.db")
    assert "Wilson" in said and "moving" in said
    assert is_figure(folder / "first_report.png")


def test_calibrate_from_scans(folder, scans):
    said = run(ROOT / "examples/python/calibrate_from_scans.py", folder, scans)
    assert "exit angle" in said and "m/s" in said
    assert is_figure(folder / "calibration.png")


def test_compare_two_nights(folder):
    for night, seed in (("monday", 1), ("tuesday", 2)):
        program("simulate", "--arms", "moving", "--matches", 4, "--possessions", 5, "--seed", seed, "--out", folder / f"{night}.db")
    said = run(ROOT / "examples/python/compare_two_nights.py", folder, "monday.db", "tuesday.db")
    assert "monday.db" in said and "percentage points" in said
    assert is_figure(folder / "two_nights.png")
