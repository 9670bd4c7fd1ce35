#!/usr/bin/env python3
"""How soon `trivela drift` finds that a simulated kicker gave way, and how often it says so of one that did not. Simulated.

    python3 tests/bench/drift_rates.py build/release/trivela [--series 200] [--seed 1000] [--policies predictive,moving,stopped]

Each series is one match: the speed falls after 60 kicks of the robot. Kicks to detection are counted from the first weaker
one to the one that made it certain, both included; a series with an alarm before that is judged by its first alarm after it."""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import tempfile

BEFORE = 60


def drifts(trivela, folder, policy, percent, series, seed):
    """For each series its kicks and the numbers of the kicks with which a change was certain."""
    log = pathlib.Path(folder) / f"{policy}_{percent}_{seed}.db"
    world = [f"kicker.drop_ratio={percent / 100}", f"kicker.drop_after_kicks={BEFORE}"] if percent else ["kicker.drop_ratio=0"]
    subprocess.run([trivela, "simulate", "--arms", policy, "--matches", str(series), "--possessions", "400", "--seed", str(seed),
                    "--out", log, *(word for key in world for word in ("--world", key))], check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    said = subprocess.run([trivela, "drift", log, "--json"], capture_output=True, text=True)
    assert said.returncode in (0, 3), said.stderr
    log.unlink()
    return [(robot["kicks"], [drift["found_with_kick"] for drift in robot["drifts"]]) for robot in json.loads(said.stdout)["robots"]]


def median_interval(values):
    """The order statistics that hold the median with 95 %."""
    ordered, n = sorted(values), len(values)
    k = max(0, math.floor(n / 2 - 1.96 * math.sqrt(n) / 2) - 1)
    return ordered[k], ordered[n - 1 - k]


def poisson_interval(n):
    """Of a count, by Byar's approximation: 95 %."""
    low = n * (1 - 1 / (9 * n) - 1.96 / (3 * math.sqrt(n))) ** 3 if n else 0.0
    m = n + 1
    return low, m * (1 - 1 / (9 * m) + 1.96 / (3 * math.sqrt(m))) ** 3


def shown(kicks):
    return "-" if kicks == math.inf else f"{kicks:g}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("trivela")
    parser.add_argument("--series", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1000)
    parser.add_argument("--policies", default="predictive,moving,stopped")
    flags = parser.parse_args()
    print(f"SIMULATED: {flags.series} series a line, seed {flags.seed}; the speed falls after {BEFORE} kicks")
    print("policy      drop  kicks to detection: median (95 %)  not found  false alarms in 500 kicks (95 %)")
    with tempfile.TemporaryDirectory() as folder:
        for policy in flags.policies.split(","):
            for percent in range(6):
                series = drifts(flags.trivela, folder, policy, percent, flags.series, flags.seed + percent)
                if percent == 0:
                    kicks, alarms = sum(n for n, _ in series), sum(len(found) for _, found in series)
                    low, high = (500 * bound / kicks for bound in poisson_interval(alarms))
                    print(f"{policy:<11} none  {'':33}  {'':9}  {500 * alarms / kicks:.2f} ({low:.2f} to {high:.2f}), {kicks} kicks")
                    continue
                late = [next((kick - BEFORE for kick in found if kick > BEFORE), math.inf) for n, found in series if n > BEFORE]
                low, high = median_interval(late)
                told = f"{shown(statistics.median(late))} ({shown(low)} to {shown(high)})"
                missed = sum(kicks == math.inf for kicks in late)
                print(f"{policy:<11} {percent} %   {told:<33}  {100 * missed / len(late):6.1f} %")


main()
