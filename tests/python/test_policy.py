import threading

import numpy
import pytest
import trivela

SMALL = dict(matches=3, possessions=5)
NUMBERS = ("kicked", "distance_m", "power", "outcome", "truth_outcome", "ending", "played_s")


def same(one, other):
    return all(numpy.array_equal(one[name], other[name], equal_nan=one[name].dtype.kind == "f") for name in NUMBERS)


@pytest.mark.parametrize("rule", ["stopped", "moving", "predictive"])
def test_one_that_asks_a_built_in_rule_plays_as_that_rule(rule):
    name = f"asks_{rule}"
    trivela.register_policy(name, lambda cycle, memory: getattr(cycle, rule)())
    rows = trivela.simulate(f"{name},{rule}", matches=10, possessions=10)
    assert set(rows.policy) == {name, rule}
    assert rows.kicked.sum() > 10
    assert same(rows[rows.arm == name], rows[rows.arm == rule])


def near(cycle, memory):
    output = cycle.moving()
    memory["cycles"] = memory.get("cycles", 0) + 1
    if output.reason == "fire" and output.distance_m > cycle.setting("near_m"):
        output.reason = "waiting"
    return output


def test_a_setting_is_the_arms_and_acts():
    trivela.register_policy("near", near, {"near_m": (20.0, 0.0, 20.0)})
    arms = [{"name": f"within {near_m}", "policy": "near", "set": {"policy": {"own": {"near": {"near_m": near_m}}}}} for near_m in (20.0, 4.0)]
    rows = trivela.simulate(arms + [{"name": "moving", "policy": "moving"}], matches=20, possessions=10)
    assert same(rows[rows.arm == "within 20.0"], rows[rows.arm == "moving"])
    close = rows[(rows.arm == "within 4.0") & rows.kicked]
    assert 5 < len(close) and close.distance_m.max() <= 4.0
    with pytest.raises(ValueError, match="policy.own.near.near_m = 21: must lie in \\[0, 20\\]"):
        trivela.simulate("near", **SMALL, settings=["policy.own.near.near_m = 21"])


def test_the_rows_do_not_depend_on_threads():
    trivela.register_policy("threaded", lambda cycle, memory: cycle.predictive())
    assert trivela.simulate("threaded", **SMALL).tobytes() == trivela.simulate("threaded", **SMALL, jobs=3).tobytes()


def test_the_memory_is_empty_when_a_possession_begins_and_kept_within_it():
    seen = []

    def remembers(cycle, memory):
        seen.append((memory.setdefault("began_s", cycle.t_s), cycle.t_s, memory.setdefault("n", 0)))
        memory["n"] += 1
        return cycle.moving()

    trivela.register_policy("remembers", remembers)
    trivela.simulate("remembers", **SMALL)
    assert sum(n == 0 for _, _, n in seen) == 15
    assert max(n for _, _, n in seen) > 20 and all(now >= began for began, now, _ in seen)


def test_a_cycle_knows_where_the_robot_is_and_what_a_kick_gives():
    knew = []

    def looks(cycle, memory):
        shot = cycle.shot(0.3)
        knew.append((cycle.goal_y_m - cycle.y_m, shot.distance_m, shot.target_x_m, cycle.opponent_distance_m, cycle.keeper_x_m, len(cycle.opponents_m)))
        assert cycle.turn_rate_radps(0.2) == -cycle.turn_rate_radps(-0.2) > 0
        return cycle.moving()

    trivela.register_policy("looks", looks)
    trivela.simulate("looks", matches=1, possessions=3)
    ahead, distance, target, opponent, keeper, _ = (numpy.array(column, dtype=object) for column in zip(*knew))
    assert numpy.all(numpy.abs(ahead - distance) < 4.0) and set(target) == {0.3} and set(keeper) == {None}
    assert any(number is not None and number > 0 for number in opponent)


def test_what_it_raises_ends_the_play_and_is_raised(tmp_path):
    def fails(cycle, memory):
        raise KeyError("an idea that was none")

    trivela.register_policy("fails", fails)
    with pytest.raises(KeyError, match="an idea that was none"):
        trivela.simulate("fails", **SMALL, jobs=2, out=tmp_path / "part.db")
    trivela.register_policy("fails", lambda cycle, memory: cycle.moving())
    assert len(trivela.simulate("fails", **SMALL)) == 15, "the same name again replaces the function"


def test_a_log_goes_on_with_the_same_function_alone(tmp_path):
    rule = lambda cycle, memory: cycle.moving()
    trivela.register_policy("steady", rule)
    rows = trivela.simulate("steady,moving", **SMALL, out=tmp_path / "ab.db")
    trivela.register_policy("steady", rule)
    assert trivela.simulate("steady,moving", **SMALL, out=tmp_path / "ab.db").tobytes() == rows.tobytes()
    trivela.register_policy("steady", lambda cycle, memory: cycle.stopped())
    with pytest.raises(RuntimeError, match="was begun with other arguments: \"code of steady"):
        trivela.simulate("steady,moving", **SMALL, out=tmp_path / "ab.db")


def test_one_thread_plays_it_whatever_jobs_is():
    threads = set()

    def notes(cycle, memory):
        threads.add(threading.get_ident())
        return cycle.moving()

    trivela.register_policy("notes", notes)
    trivela.simulate("moving,notes", matches=8, possessions=3, jobs=4)
    assert threads == {threading.get_ident()}


def test_a_setting_of_a_policy_that_is_not_there_is_refused_and_its_name_stays_free():
    with pytest.raises(ValueError, match="this program has no policy later of its own"):
        trivela.simulate("moving", **SMALL, settings=["policy.own.later.near_m = 4.0"])
    trivela.register_policy("later", lambda cycle, memory: cycle.moving(), {"near_m": (4.5, 0.0, 20.0)})
    assert len(trivela.simulate("later", **SMALL, settings=["policy.own.later.near_m = 4.0"])) == 15


def test_outputs_that_cannot_be_are_refused_in_a_sentence():
    def fires_without_power(cycle, memory):
        output = trivela.Output()
        output.reason = "fire"
        return output

    kept = []
    trivela.register_policy("powerless", fires_without_power)
    trivela.register_policy("nothing", lambda cycle, memory: None)
    trivela.register_policy("keeps", lambda cycle, memory: kept.append(cycle) or cycle.moving())
    with pytest.raises(ValueError, match="policy powerless: reason is fire, but power is None"):
        trivela.simulate("powerless", **SMALL)
    with pytest.raises(TypeError, match="policy nothing: evaluate\\(\\) must return an Output"):
        trivela.simulate("nothing", **SMALL)
    with pytest.raises(ValueError, match="'fly' is no reason; there are fire, not_playing, "):
        trivela.Output().reason = "fly"
    trivela.simulate("keeps", matches=1, possessions=1)
    with pytest.raises(ValueError, match="a cycle is known while evaluate\\(\\) is asked"):
        kept[0].moving()
    with pytest.raises(ValueError, match="a cycle is known while evaluate\\(\\) is asked"):
        kept[0].x_m


def test_names_and_settings_that_cannot_be_are_refused():
    rule = lambda cycle, memory: cycle.moving()
    for name, why in (("moving", "the name is taken"), ("Mine", "1 to 31 of a-z"), ("", "1 to 31 of a-z")):
        with pytest.raises(ValueError, match=why):
            trivela.register_policy(name, rule)
    with pytest.raises(ValueError, match="its usual value is not in its range"):
        trivela.register_policy("beyond", rule, {"x": (2.0, 0.0, 1.0)})
    for values in ((1.0, 0.0), 1.0, ("a", 0.0, 1.0)):
        with pytest.raises(ValueError, match="policy formless: setting x: .* is not \\(usual value, least, most\\)"):
            trivela.register_policy("formless", rule, {"x": values})
    with pytest.raises(ValueError, match="policy formless: evaluate is no function"):
        trivela.register_policy("formless", None)
    trivela.register_policy("fixed", rule, {"x": (0.5, 0.0, 1.0)})
    with pytest.raises(ValueError, match="its settings cannot change"):
        trivela.register_policy("fixed", rule, {"y": (0.5, 0.0, 1.0)})
    with pytest.raises(ValueError, match="\"unheard\" is no policy"):
        trivela.simulate("unheard", **SMALL)
