import math
import pickle
import threading

import numpy
import pytest
import trivela

from conftest import ROOT, answer, refusal, vectors


def rad(degrees):
    return numpy.asarray([value * math.pi / 180.0 for value in degrees])  # as kicking::radians()


def column(rows, name):
    return [float(row[name]) for row in rows]


def same(column, rows, name):
    """Bit for bit; a number that the program does not give is NaN."""
    for ours, row in zip(column.tolist(), rows, strict=True):
        if row[name] is None:
            assert not isinstance(ours, float) or math.isnan(ours)
        else:
            assert ours == row[name], name


def test_solve_gives_the_programs_numbers_bit_for_bit():
    given = vectors("moving_kick.csv")
    rows = answer("solve", "--csv", ROOT / "tests/vectors/moving_kick.csv", "--robot", ROOT / "config/robots/cambada_1.toml")
    kicks = trivela.solve(column(given, "d_m"), column(given, "h_rel_m"), rad(column(given, "theta_deg")), column(given, "v_front_mps"),
                          column(given, "k_transfer"), robot=trivela.Robot(ROOT / "config/robots/cambada_1.toml"))
    assert len(rows) == len(kicks) > 10
    for name in ("v0_mps", "vk_exact_mps", "vk_paper_mps", "feasible", "power", "power_range"):
        same(kicks[name], rows, name)
    for kick, row in zip(kicks, given):
        assert kick.vk_exact_mps == pytest.approx(float(row["vk_exact"]), abs=1e-6)


def test_solve_with_drag_gives_the_programs_numbers():
    given = vectors("drag_v0_for_crossing.csv")
    rows = answer("solve", "--csv", ROOT / "tests/vectors/drag_v0_for_crossing.csv")
    kicks = trivela.solve(column(given, "d_m"), column(given, "h_rel_m"), rad(column(given, "theta_deg")), drag_coefficient=column(given, "Cd"))
    same(kicks.v0_drag_mps, rows, "v0_drag_mps")
    for kick, row in zip(kicks, given):
        assert kick.v0_drag_mps == pytest.approx(float(row["v0_drag"]), abs=1e-5)


def test_align_gives_the_programs_numbers():
    given = vectors("alignment.csv")
    rows = answer("align", "--csv", ROOT / "tests/vectors/alignment.csv")
    for rule in ("max", "add"):
        chosen = [i for i, row in enumerate(given) if row["rule"] == rule]
        mine = [given[i] for i in chosen]
        found = trivela.align(column(mine, "px"), column(mine, "py"), rad(column(mine, "orientation_deg")), rad(column(mine, "alpha_deg")),
                              column(mine, "tx"), column(mine, "ty"), rad(column(mine, "beta_deg")), column(mine, "omega_rad_s"), rule=rule)
        for name in ("distance_m", "offset_right_m", "left_m", "right_m", "aligned"):
            same(found[name], [rows[i] for i in chosen], name)
        assert [bool(row["aligned"] in ("1", "True")) for row in mine] == found.aligned.tolist()


def test_predict_gives_the_programs_numbers():
    given = vectors("release_prediction.csv")
    rows = answer("predict", "--csv", ROOT / "tests/vectors/release_prediction.csv")
    found = trivela.predict(*(column(given, name) for name in ("px", "py", "orientation_rad", "vx", "vy", "omega", "vk")),
                            rad(column(given, "theta_deg")), transfer=column(given, "k"), delay_s=column(given, "tau_s"),
                            ball_offset_m=column(given, "r_m"), goal_y_m=column(given, "goal_y"))
    for name in ("x_cross_m", "z_cross_m", "t_flight_s"):
        same(found[name], rows, name)


def test_arguments_are_broadcast():
    kicks = trivela.solve(numpy.linspace(2.0, 6.0, 5)[:, None], 0.4, rad([30.0, 36.78, 42.0]))
    assert kicks.shape == (5, 3)
    assert kicks[3, 1].v0_mps == trivela.solve(5.0, 0.4, rad([36.78])[0]).v0_mps
    assert trivela.solve(5.0, 0.4, 0.6).shape == ()
    assert numpy.isnan(trivela.solve(1.0, 3.0, 0.6).v0_mps)


def test_outcomes_are_those_of_the_goals_geometry():
    assert trivela.judge([0.0, -2.0, 2.0, 0.0, 0.95, 0.0, numpy.nan], [0.5, 0.5, 0.5, 2.0, 0.5, 1.05, 0.5]).tolist() == [
        "on_target", "wide_left", "wide_right", "over", "post", "bar", "unknown"]
    wide = trivela.Goal(half_width_m=1.2)
    assert trivela.judge(1.05, 0.5, goal=wide) == "on_target"
    p = trivela.judge_probabilities([[0.0], [0.9]], 0.1, [0.4, 0.9], 0.1)
    assert p.shape == (2, 2)
    numpy.testing.assert_allclose(sum(p[name] for name in p.dtype.names), 1.0, atol=1e-12)
    assert p[0, 0].on_target > 0.99 > p[1, 0].on_target


@pytest.mark.parametrize("made, name, values", [
    (trivela.Flight, "gravity_mps2", (0.0, -9.81)),
    (trivela.Flight, "ball_radius_m", (0.01, 0.3)),
    (trivela.Flight, "ball_mass_kg", (0.0,)),
    (trivela.Flight, "air_density_kgpm3", (-0.1,)),
    (trivela.Goal, "y_m", ()),
    (trivela.Goal, "half_width_m", (0.0, -1.0)),
    (trivela.Goal, "height_m", (0.0, -1.0)),
    (trivela.Goal, "post_width_m", (-0.1,)),
    (lambda **radius: trivela.judge(0.0, 0.5, **radius), "ball_radius_m", (-0.11, 0.0, 0.3)),
    (lambda **radius: trivela.judge_probabilities(0.0, 0.1, 0.5, 0.1, **radius), "ball_radius_m", (0.0, 0.3)),
])
def test_numbers_are_held_to_the_configurations_ranges(made, name, values):
    for value in (numpy.nan, numpy.inf, -numpy.inf, *values):
        with pytest.raises(ValueError, match=f"^{name}: '{value:g}' is not from "):
            made(**{name: value})
    with pytest.raises(ValueError, match="^ball_radius_m: '0.3' is not from 0.02 to 0.25$"):
        trivela.judge(0.0, 0.5, ball_radius_m=0.3)


def test_a_ball_of_another_size_and_a_goal_without_frame_are_possible():
    assert trivela.judge(0.95, 0.5, goal=trivela.Goal(post_width_m=0.0), ball_radius_m=0.02) == "on_target"
    assert trivela.solve(3.0, 0.4, 0.6, flight=trivela.Flight(gravity_mps2=1.62)).v0_mps < trivela.solve(3.0, 0.4, 0.6).v0_mps


def test_robots_goals_and_flights_go_to_other_processes(tmp_path, monkeypatch):
    goal = pickle.loads(pickle.dumps(trivela.Goal(y_m=11.0, half_width_m=1.2, height_m=1.1, post_width_m=0.1)))
    assert (goal.y_m, goal.half_width_m, goal.height_m, goal.post_width_m) == (11.0, 1.2, 1.1, 0.1)
    monkeypatch.chdir(ROOT)
    robot = trivela.Robot("config/robots/cambada_1.toml")
    flight = trivela.Flight(gravity_mps2=9.8, ball_radius_m=0.1, ball_mass_kg=0.4, air_density_kgpm3=1.1)
    here = trivela.solve(5.0, 0.4, 0.6, 0.5, 1.0, 0.25, robot=robot, flight=flight)
    monkeypatch.chdir(tmp_path)
    robot, flight = pickle.loads(pickle.dumps((robot, flight)))
    assert trivela.solve(5.0, 0.4, 0.6, 0.5, 1.0, 0.25, robot=robot, flight=flight) == here


def test_what_a_mask_hides_is_refused():
    with pytest.raises(ValueError, match="mask"):
        trivela.solve(numpy.ma.masked_less([3.0, -1.0], 0.0), 0.4, 0.6)
    assert trivela.solve(numpy.ma.masked_less([3.0, 4.0], 0.0), 0.4, 0.6).shape == (2,)


def test_bad_numbers_are_refused_in_the_programs_words():
    with pytest.raises(ValueError, match=r"^distance_m\[1\]: '-1' is not above 0$"):
        trivela.solve([3.0, -1.0], 0.4, 0.6)
    assert "'-1' is not above 0" in refusal("solve", "--theta-deg", 36, "--d-m", "-1", "--h-rel-m", 0.4)
    with pytest.raises(ValueError, match=r"exit_angle_rad\[0\]: '2' is not between 0 and pi / 2"):
        trivela.solve(3.0, 0.4, 2.0)
    with pytest.raises(ValueError, match="is not finite"):
        trivela.predict(0, numpy.nan, 0, 0, 0, 0, 8, 0.6)
    with pytest.raises(ValueError, match="rule: 'least' is neither max nor add"):
        trivela.align(0, 0, 0, 0, 0, 9, 0, 0, rule="least")
    with pytest.raises(FileNotFoundError, match="no.toml: cannot read the configuration"):
        trivela.Robot("no.toml")


def test_other_threads_run_while_many_kicks_are_solved():
    steps, done = [], threading.Event()

    def count():
        while not done.is_set():
            steps.append(None)

    thread = threading.Thread(target=count)
    thread.start()
    before = len(steps)
    trivela.solve(numpy.full(20_000, 4.0), 0.4, 0.6, drag_coefficient=0.25)
    after = len(steps)
    done.set()
    thread.join()
    assert after - before > 100
