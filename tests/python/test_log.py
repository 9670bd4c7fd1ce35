import pathlib
import signal
import sqlite3
import subprocess
import sys
import time

import numpy
import pandas
import pytest
import trivela

from conftest import answer, program, refusal


def same(table, rows):
    """Each cell is the program's, bit for bit."""
    assert len(table) == len(rows) > 0
    for name in rows[0]:
        for ours, row in zip(table[name].tolist(), rows):
            theirs = row[name]
            assert pandas.isna(ours) if theirs is None else ours == theirs, name


def test_kicks_outcomes_and_decisions_are_the_programs_rows(experiment):
    log = trivela.Log(experiment)
    assert log.warnings == []
    same(log.kicks(), answer("query", experiment, "--metric", "listed_kicks"))
    outcomes = log.outcomes()
    assert len(outcomes) == len(log.kicks()) and outcomes.truth_margin_m.notna().any()
    same(log.decisions(), answer("query", experiment, "SELECT * FROM kick_decisions ORDER BY session_id, robot_id, seq"))


def test_columns_have_their_types(experiment):
    kicks = trivela.Log(experiment).kicks()
    assert kicks.distance_m.dtype == kicks.truth_x_cross_m.dtype == kicks.power.dtype == "float64"
    assert kicks.kick_id.dtype == kicks.half.dtype == "int64" and kicks.aligned.dtype == "boolean"
    assert set(kicks.policy) == {"stopped", "moving"} and kicks.outcome.map(type).isin([str, type(None)]).all()
    assert kicks.release_t_ns.max() > 0
    decisions = trivela.Log(experiment).decisions()
    assert decisions.fire.dtype == "boolean" and decisions.fire.sum() >= len(kicks)
    assert "ball centre to target" in trivela.Log(experiment).meaning("distance_m")


def test_opportunities_are_those_that_compare_counts(experiment):
    log = trivela.Log(experiment)
    for outcome in ("observed", "truth"):
        groups = {group["name"]: group for group in answer("compare", experiment, "--outcome", outcome)["groups"]}
        counted = log.opportunities(outcome).groupby("arm").ending.value_counts()
        for name, group in groups.items():
            assert counted[name].sum() == group["opportunities"] == 24
            assert counted[name].get("inside", 0) == group["inside"]
            assert counted[name].get("outside", 0) == group["outside"]


def test_report_and_comparison_are_the_programs(experiment):
    report = trivela.Log(experiment).report()
    assert report == answer("report", experiment)
    assert report.text == program("report", experiment)
    comparison = trivela.compare(experiment, outcome="truth", baseline="moving", smallest_effect=0.1)
    assert comparison == answer("compare", experiment, "--outcome", "truth", "--baseline", "moving", "--smallest-effect", 10)
    assert trivela.report(experiment, blocked="apart") == answer("report", experiment, "--blocked", "apart")


def test_two_recordings_of_a_play_count_once(tmp_path):
    for name, seed in (("one", 3), ("two", 3), ("other", 4)):
        program("simulate", "--arms", "moving", "--matches", 2, "--possessions", 5, "--seed", seed, "--out", tmp_path / f"{name}.db")
    one = trivela.Log(tmp_path / "one.db")
    both = trivela.Log(tmp_path / "one.db", tmp_path / "two.db")
    assert len(both.kicks()) == len(one.kicks()) == trivela.report(tmp_path / "one.db", tmp_path / "two.db")["policies"][0]["inside"] + trivela.report(tmp_path / "one.db", tmp_path / "two.db")["policies"][0]["outside"]
    assert len(both.decisions()) == len(one.decisions())
    assert len(both.opportunities()) == len(one.opportunities()) == 10
    assert both.opportunities().attrs["remarks"]
    nights = trivela.Log(tmp_path / "one.db", tmp_path / "other.db")
    assert set(nights.kicks().log) == {str(tmp_path / "one.db"), str(tmp_path / "other.db")}
    compared = trivela.compare(tmp_path / "one.db", tmp_path / "other.db", by="log")
    assert compared == answer("compare", tmp_path / "one.db", tmp_path / "other.db", "--by", "log")


def test_a_label_by_hand_comes_before_what_the_robot_saw(experiment, tmp_path):
    log = tmp_path / "labelled.db"
    log.write_bytes(experiment.read_bytes())
    before = trivela.Log(log).outcomes()
    kick = before[before.outcome == "on_target"].iloc[0]
    labelled = program("label", "--help")
    assert "--" in labelled
    with sqlite3.connect(log) as rows:
        rows.execute("INSERT INTO labels (session_id, robot_id, kick_id, utc_ns, who, t_ns, outcome, note) VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                     (int(kick.session_id), int(kick.robot_id), int(kick.kick_id), 1, "Ana", int(kick.t_ns), "over", ""))
    after = trivela.Log(log).outcomes()
    changed = after[(after.session_id == kick.session_id) & (after.kick_id == kick.kick_id)].iloc[0]
    assert (changed.outcome, changed.observed_outcome, changed.hand_outcome) == ("over", "on_target", "over")
    same(trivela.Log(log).kicks(), answer("query", log, "--metric", "listed_kicks"))


def test_questions_of_ones_own(experiment):
    log = trivela.Log(experiment)
    table = log.query("SELECT policy, count(*) AS n, NULL AS nobody, 0.25 AS quarter FROM counted_kicks GROUP BY policy")
    assert table.n.dtype == "int64" and table.quarter.tolist() == [0.25] * len(table) and table.nobody.isna().all()
    assert len(log.query("SELECT * FROM kick_decisions WHERE 0")) == 0
    assert list(log.query("SELECT seq, fire FROM kick_decisions WHERE 0").columns) == ["seq", "fire"]
    with pytest.raises(ValueError, match="a log is only read"):
        log.query("DROP TABLE referee")
    with pytest.raises(ValueError, match="there is no metric 'goals'"):
        log.metric("goals")


def test_two_columns_of_one_name_are_refused(experiment, tmp_path):
    log = trivela.Log(experiment)
    with pytest.raises(ValueError, match="^two columns are called 'a': name them with AS$"):
        log.query("SELECT 1 a, 2 a")
    assert "two columns are called 'a'" in refusal("query", experiment, "--json", "SELECT 1 a, 2 a")
    assert list(log.query("SELECT 1 a, 2 b, 3 log").columns) == ["a", "b", "log"]
    other = tmp_path / "other.db"
    other.write_bytes(pathlib.Path(experiment).read_bytes())
    with pytest.raises(ValueError, match="two columns are called 'log'"):
        trivela.Log(experiment, other).query("SELECT 1 log")


ENDLESS = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT {} FROM n"


@pytest.mark.parametrize("wanted", ["max(i)", "i"])
def test_ctrl_c_ends_a_question(experiment, wanted):
    script = f"""import sys, trivela
log = trivela.Log(sys.argv[1])
print("asks", flush=True)
try:
    log.query("{ENDLESS.format(wanted)}")
except KeyboardInterrupt:
    print("interrupted", len(log.query("SELECT 1 a")))
"""
    asks = subprocess.Popen([sys.executable, "-c", script, experiment], stdout=subprocess.PIPE, text=True)
    try:
        assert asks.stdout.readline() == "asks\n"
        time.sleep(0.3)
        asks.send_signal(signal.SIGINT)
        assert asks.communicate(timeout=20)[0] == "interrupted 1\n"  # 0.1 s on an idle machine
    finally:
        asks.kill()


def test_what_a_signal_handler_raises_ends_a_question(experiment):
    class Enough(Exception):
        pass

    def enough(*_):
        raise Enough

    before = signal.signal(signal.SIGALRM, enough)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(Enough):
            trivela.Log(experiment).query(ENDLESS.format("max(i)"))
    finally:
        signal.signal(signal.SIGALRM, before)


def test_a_file_that_is_no_log_is_refused_in_the_programs_words(tmp_path):
    with pytest.raises(FileNotFoundError) as missing:
        trivela.Log(tmp_path / "no.db")
    assert str(missing.value) == refusal("query", tmp_path / "no.db", "SELECT 1")
    (tmp_path / "text.db").write_text("no log\n" * 100)
    with pytest.raises(ValueError) as wrong:
        trivela.Log(tmp_path / "text.db")
    assert str(wrong.value) == refusal("query", tmp_path / "text.db", "SELECT 1")


def test_arguments_that_make_no_sense_are_refused(experiment):
    with pytest.raises(ValueError, match="outcome: 'said' is neither observed nor truth"):
        trivela.compare(experiment, outcome="said")
    for word, words in ((dict(baseline="nobody"), ("--baseline", "nobody")), (dict(by="colour"), ("--by", "colour"))):
        with pytest.raises(ValueError) as wrong:
            trivela.compare(experiment, **word)
        assert "--" + str(wrong.value) == refusal("compare", experiment, *words)
    with pytest.raises(ValueError, match="design x: expected one of"):
        trivela.compare(experiment, design="x")
    with pytest.raises(ValueError, match="compare needs match logs"):
        trivela.compare()


def test_numbers_of_a_frame_are_numbers(experiment):
    kicks = trivela.Log(experiment).kicks()
    assert numpy.isfinite(kicks[["distance_m", "power"]].to_numpy()).all()
