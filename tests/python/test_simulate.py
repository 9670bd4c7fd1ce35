import os
import signal
import threading

import numpy
import pytest
import trivela

from conftest import ROOT, answer, program, refusal

SMALL = dict(matches=3, possessions=5)


def test_the_rows_are_those_of_the_programs_log(tmp_path):
    ours = trivela.simulate("stopped,moving", **SMALL, seed=7, out=tmp_path / "ours.db")
    program("simulate", "--arms", "stopped,moving", "--matches", 3, "--possessions", 5, "--seed", 7, "--out", tmp_path / "theirs.db")
    for table in ("sessions", "kick_decisions", "kick_orders", "kick_receipts", "kick_outcomes", "kick_truths", "possession_truths", "digests"):
        rows = f"SELECT * FROM {table}"
        assert answer("query", tmp_path / "ours.db", rows) == answer("query", tmp_path / "theirs.db", rows), table
    kicks = answer("query", tmp_path / "theirs.db", "SELECT s.arm, s.match_id, k.distance_m, k.power, k.v_kick_mps, k.outcome, k.truth_outcome, k.policy "
                   "FROM kicks AS k JOIN sessions AS s USING (session_id) WHERE accepted = 1 ORDER BY k.session_id, k.seq")
    mine = ours[ours.kicked]
    assert len(mine) == len(kicks) > 10
    for name in kicks[0]:
        assert mine[name].tolist() == [row[name] for row in kicks], name
    truths = answer("query", tmp_path / "theirs.db", "SELECT ending FROM possession_truths ORDER BY session_id, seq")
    assert ours.ending.tolist() == [row["ending"] for row in truths]


def test_the_rows_depend_neither_on_threads_nor_on_a_log(tmp_path):
    one = trivela.simulate("stopped,moving", **SMALL)
    assert one.tobytes() == trivela.simulate("stopped,moving", **SMALL, jobs=3).tobytes()
    assert one.tobytes() == trivela.simulate("stopped,moving", **SMALL, jobs=2, out=tmp_path / "ab.db").tobytes()
    assert len(one) == 2 * 3 * 5 and set(one.arm) == {"stopped", "moving"} and set(one.calibration_id) == {-1}
    assert numpy.isnan(one.distance_m[~one.kicked]).all() and (one.kick_kind[~one.kicked] == -1).all()
    assert one.tobytes() != trivela.simulate("stopped,moving", **SMALL, seed=2).tobytes()


def test_arms_are_a_file_a_text_or_dicts(tmp_path):
    text = '[[arm]]\nname = "bold"\npolicy = "predictive"\nset = ["policy.predictive.threshold = 0.4"]\n[[arm]]\nname = "drawn"\nrandom = ["stopped", "moving"]\n'
    (tmp_path / "arms.toml").write_text(text)
    by_text = trivela.simulate(text, **SMALL)
    by_file = trivela.simulate(tmp_path / "arms.toml", **SMALL)
    by_dict = trivela.simulate([{"name": "bold", "policy": "predictive", "set": {"policy": {"predictive": {"threshold": 0.4}}}},
                                {"name": "drawn", "random": ["stopped", "moving"]}], **SMALL)
    assert by_text.tobytes() == by_file.tobytes() == by_dict.tobytes()
    assert set(by_text.policy[by_text.arm == "drawn"]) == {"stopped", "moving"}
    assert (by_text.assignment_probability[by_text.arm == "drawn"] == 0.5).all()
    program("simulate", "--arms", tmp_path / "arms.toml", "--matches", 3, "--possessions", 5, "--out", tmp_path / "theirs.db")
    trivela.simulate(tmp_path / "arms.toml", **SMALL, out=tmp_path / "ours.db")
    rows = "SELECT * FROM kick_decisions"
    assert answer("query", tmp_path / "ours.db", rows) == answer("query", tmp_path / "theirs.db", rows)


def test_worlds_settings_robots_and_scenarios_are_the_programs(tmp_path):
    robot, scenario = ROOT / "config/robots/cambada_1.toml", ROOT / "config/scenarios/keeper.toml"
    trivela.simulate("moving", **SMALL, scenario=scenario, world={"keeper": {"reaction_s": 0.15}}, settings=["policy.settle_s = 0.5"],
                     robots=[robot], out=tmp_path / "ours.db")
    program("simulate", "--arms", "moving", "--matches", 3, "--possessions", 5, "--scenario", scenario, "--world", "keeper.reaction_s = 0.15",
            "--set", "policy.settle_s = 0.5", "--robot", robot, "--out", tmp_path / "theirs.db")
    for rows in ("SELECT * FROM sessions", "SELECT * FROM kick_truths"):
        assert answer("query", tmp_path / "ours.db", rows) == answer("query", tmp_path / "theirs.db", rows)


def test_calibrations_are_played_before_the_matches():
    calls = []
    rows = trivela.simulate("moving", matches=2, possessions=2, calibrations=1, progress=lambda *call: calls.append(call))
    assert set(rows.calibration_id) == {0}
    assert calls[0] == (1, 1, "calibrations") and [call[:2] for call in calls[1:]] == [(1, 2), (2, 2)]


def test_other_threads_of_python_run_meanwhile():
    steps, done = [], threading.Event()

    def count():
        while not done.is_set():
            steps.append(None)

    thread = threading.Thread(target=count)
    thread.start()
    before = len(steps)
    trivela.simulate("predictive", matches=6, possessions=10, jobs=2)
    after = len(steps)
    done.set()
    thread.join()
    assert after - before > 1000


def test_what_progress_raises_ends_the_play_and_the_log_goes_on(tmp_path):
    def stop(done, all_matches, words):
        if done == 2:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        trivela.simulate("moving", matches=6, possessions=4, progress=stop, out=tmp_path / "ab.db")
    again = trivela.simulate("moving", matches=6, possessions=4, out=tmp_path / "ab.db")
    whole = trivela.simulate("moving", matches=6, possessions=4, out=tmp_path / "whole.db")
    rows = "SELECT * FROM kick_decisions"
    assert answer("query", tmp_path / "ab.db", rows) == answer("query", tmp_path / "whole.db", rows)
    assert whole.tobytes() == again.tobytes()
    assert whole.tobytes() == trivela.simulate("moving", matches=6, possessions=4, out=tmp_path / "ab.db").tobytes()


def test_ctrl_c_ends_the_play():
    def interrupt(done, all_matches, words):
        if done == 1:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        trivela.simulate("moving", matches=200, possessions=4, progress=interrupt)


def test_what_makes_no_sense_is_refused_in_the_programs_words(tmp_path):
    def said(*words):
        return refusal("simulate", *words, "--out", tmp_path / "no.db")

    for arms, words in (("bravest", ("--arms", "bravest")), ("moving,moving", ("--arms", "moving,moving"))):
        with pytest.raises(ValueError) as wrong:
            trivela.simulate(arms, **SMALL)
        assert "--" + str(wrong.value) == said(*words)
    with pytest.raises(ValueError) as wrong:
        trivela.simulate("moving", matches=2, calibrations=3)
    assert str(wrong.value) == said("--arms", "moving", "--matches", 2, "--calibrations", 3).replace("--", "")
    with pytest.raises(ValueError, match=r"world:1: keeper.reaction: unknown key; did you mean reaction_s"):
        trivela.simulate("moving", world=["keeper.reaction = 0.15"])
    with pytest.raises(ValueError, match="arms:2: arm.policy"):
        trivela.simulate([{"policy": "bravest", "name": "x"}])
    with pytest.raises(ValueError, match="matches 0 is not within 1 to 1048576"):
        trivela.simulate("moving", matches=0)
    with pytest.raises(ValueError, match="a list of lines or a dict"):
        trivela.simulate("moving", world="keeper.reaction_s = 0.15")
    with pytest.raises(FileNotFoundError, match="no.toml"):
        trivela.simulate("no.toml")
    assert not (tmp_path / "no.db").exists()
