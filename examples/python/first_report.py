#!/usr/bin/env python3
"""My first report in pandas: first_report.py MATCH.db... writes first_report.png.

Every number is the one of `trivela report`; what follows from there on is pandas.
"""
import sys

import matplotlib.pyplot as plt
import trivela

log = trivela.Log(*sys.argv[1:])
for warning in log.warnings:
    print("warning:", warning)

# %% Table 2: kicks inside and outside by policy, with Wilson's interval.
kicks = log.kicks()
known = kicks[kicks.outcome.notna() & (kicks.outcome != "unknown")]
table = known.assign(inside=known.outcome == "on_target").groupby("policy").inside.agg(inside="sum", kicks="count")
table["efficiency"] = table.inside / table.kicks
table[["Wilson low", "Wilson high"]] = trivela.stats.wilson(table.inside, table.kicks)
print(table.round(3).to_string(), "\n")

# %% Why kicks missed.
misses = known[known.outcome != "on_target"]
print(misses.groupby(["policy", "outcome"]).size().unstack(fill_value=0).to_string(), "\n")

# %% What the whole report says, as the program prints it.
print(log.report().text)

# %% How far from the goal they kicked, and where the ball crossed its line.
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
for policy, group in known.groupby("policy"):
    left.hist(group.distance_m, bins=12, alpha=0.6, label=policy)
    right.plot(group.x_cross_m, group.z_cross_m, "o", alpha=0.6, label=policy)
left.set(xlabel="distance to the target [m]", ylabel="kicks")
right.set(xlabel="x at the goal line [m]", ylabel="height of the ball's centre [m]")
goal = trivela.Goal()
right.plot([-goal.half_width_m, -goal.half_width_m, goal.half_width_m, goal.half_width_m], [0, goal.height_m, goal.height_m, 0], "k")
left.legend()
figure.savefig("first_report.png", dpi=150)
