import csv
import math

import pandas
import pytest
import trivela

from conftest import answer


def test_lobs_are_what_was_kicked(scans):
    truth = list(csv.DictReader(line for line in scans.with_suffix(".csv").open() if not line.startswith("#")))
    lobs = trivela.lobs(scans)
    assert len(lobs) == len(truth) == 24
    for lob, kicked in zip(lobs[lobs.accepted].itertuples(), truth):
        assert lob.power == float(kicked["power"])
        assert lob.true_exit_speed_mps == pytest.approx(float(kicked["exit_speed_mps"]), rel=0.05)
        assert 0.0 < lob.exit_speed_se_mps < 0.2 and lob.centres > 3


def test_the_table_of_lobs_is_the_programs(scans, tmp_path):
    lobs = trivela.lobs(scans)
    lobs = lobs[lobs.accepted & lobs.power.notna()]
    table = trivela.fit_table(lobs.power, lobs.exit_speed_mps, lobs.exit_angle_rad)
    theirs = answer("calibrate", "table", scans, "--robot", "me", "--out", tmp_path / "me.toml")
    for ours, row in zip(table.set_points.itertuples(), theirs["setpoints"], strict=True):
        assert (ours.power, ours.trials, ours.exit_speed_mps) == (row["power"], row["trials"], row["exit_speed_mps"])
        assert ours.exit_angle_rad * 180.0 / math.pi == row["exit_angle_deg"]
    assert table.exit_angle_rad * 180.0 / math.pi == theirs["exit_angle_deg"]
    assert table.rises and not table.isotonic
    robot = trivela.Robot(tmp_path / "me.toml")
    assert robot.powers.tolist() == table.set_points.power.tolist()


def test_what_is_no_trial_is_refused(tmp_path):
    with pytest.raises(ValueError):
        trivela.fit_table([20.0], [7.0], 0.6)
    with pytest.raises(ValueError):
        trivela.fit_table([20.0, 30.0], [7.0, -1.0], 0.6)
    with pytest.raises(FileNotFoundError):
        trivela.lobs(tmp_path / "no.db")
    table = trivela.fit_table([20.0, 30.0], [7.0, 6.9], 0.6)
    assert not table.rises and trivela.fit_table([20.0, 30.0], [7.0, 6.9], 0.6, isotonic=True).rises
    assert isinstance(table.set_points, pandas.DataFrame)
