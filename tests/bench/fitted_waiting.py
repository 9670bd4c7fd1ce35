#!/usr/bin/env python3
r"""What fitted iteration could win: the value of firing and of waiting, learned from a log with exploration.

In each possession of the log either `predictive` was in charge or a `learned` that waits longer, by lot with a known
probability (arm.random, --shadows, --every-cycle). At the first cycle in which predictive fires, in charge or as a
shadow, the features are what the robot knows. Where predictive was in charge it fires there, elsewhere the robot
waits. Ridge regressions on random Fourier features say what each is worth. The rule takes the better one. Its value is
estimated on other matches, doubly robust (Dudik, Langford, Li 2011). Rewards are the observer's labels.

    [[arm]]                                      # explore.toml
    name = "explore"
    random = ["predictive", "learned"]
    random_probabilities = [0.5, 0.5]

    build/release/trivela simulate --arms explore.toml --every-cycle --shadows --matches 300 --possessions 40 --seed 9001 \
        --calibrations 10 --set 'kick_decision.learned_model="patient.toml"' --world opponent.distance_median_m=1.7 \
        --world kicker.delay_s=0.055 --world possession.aim_error_sd_deg=80 --out explore.db
    python3 tests/bench/fitted_waiting.py explore.db

patient.toml is a learned file with decision.fire_weights = [-0.02, 0, 0, 0, 0, 0] and opponent_places = true.
"""
import sqlite3
import sys

import numpy as np

FIRST = """
WITH chosen AS (
  SELECT d.*, max(d.policy = 'predictive' AND d.fire, coalesce(s.fire, 0)) AS fires,
         coalesce(s.p_on_target, d.p_on_target) AS p, min(d.t_ns) OVER (PARTITION BY d.session_id, d.possession_id) AS began
  FROM kick_decisions d LEFT JOIN shadow_decisions s
    ON s.session_id = d.session_id AND s.robot_id = d.robot_id AND s.seq = d.seq AND s.policy = 'predictive'),
first AS (SELECT *, row_number() OVER (PARTITION BY session_id, possession_id ORDER BY t_ns) AS place FROM chosen
          WHERE fires = 1),
won AS (SELECT d.session_id, d.possession_id, max(o.on_target) AS on_target
        FROM kick_decisions d JOIN kick_outcomes o USING (session_id, robot_id, kick_id) WHERE d.fire = 1 GROUP BY 1, 2)
SELECT f.session_id, f.policy = 'predictive', f.assignment_probability, f.p, f.distance_m, abs(f.omega_radps),
       abs(f.vx_mps), f.vy_mps, coalesce(f.opponent_distance_m, 6), abs(f.offset_right_m), (f.t_ns - f.began) * 1e-9,
       coalesce(w.on_target, 0)
FROM first f LEFT JOIN won w USING (session_id, possession_id) WHERE f.place = 1"""


def value_of(features, reward, weight, ridge):
    gram = features.T * weight @ features + ridge * np.eye(features.shape[1])
    return np.linalg.solve(gram, features.T * weight @ reward)


def fourier(x, count, random):
    angles = x @ random.normal(size=(x.shape[1], count)) * 0.5 + random.uniform(0, 2 * np.pi, count)
    return np.hstack([np.ones((len(x), 1)), x, np.cos(angles)])


def main():
    read = sqlite3.connect(sys.argv[1]).execute(FIRST).fetchall()
    sessions = sorted({row[0] for row in read})
    rows = np.array([(sessions.index(row[0]), *row[1:]) for row in read], dtype=float)
    rows = rows[np.isfinite(rows).all(axis=1)]
    match, fired, probability, reward = rows[:, 0].astype(int), rows[:, 1] == 1, rows[:, 2], rows[:, -1]
    x = (rows[:, 3:-1] - rows[:, 3:-1].mean(0)) / rows[:, 3:-1].std(0)
    features = fourier(x, 60, np.random.default_rng(1))
    print(f"SIMULATED: {len(rows)} first shots of {len(set(match))} matches; on target of 100: "
          f"fired {100 * reward[fired].mean():.2f}, waited {100 * reward[~fired].mean():.2f}")
    for ridge in (3.0, 30.0, 300.0):
        gains, waits = np.zeros(len(rows)), np.zeros(len(rows))
        for fold in range(5):
            held = match % 5 == fold
            q = {}
            for action in (True, False):
                of = ~held & (fired == action)
                q[action] = features @ value_of(features[of], reward[of], np.ones(of.sum()), ridge)
            wait = q[False] > q[True]
            robust = {a: q[a] + (fired == a) / probability * (reward - q[a]) for a in (True, False)}
            gains[held] = (wait * (robust[False] - robust[True]))[held]
            waits[held] = wait[held]
        by_match = np.array([gains[match == m].sum() for m in sorted(set(match))])
        reach = 1.96 * by_match.std(ddof=1) * np.sqrt(len(by_match)) / len(rows)
        print(f"ridge {ridge:5.0f}: waits at {100 * waits.mean():.1f} % of them; "
              f"worth {100 * gains.mean():+.2f} +- {100 * reach:.2f} of 100 first shots")


if __name__ == "__main__":
    main()
