#!/usr/bin/env python3
"""Compare two nights: compare_two_nights.py MONDAY.db TUESDAY.db writes two_nights.png.

Two nights were played one after the other: a difference may have other reasons than what the team changed. What the
comparison may say of it stands in its text.
"""
import sys

import matplotlib.pyplot as plt
import trivela

monday, tuesday = sys.argv[1:]

# %% The verdict with its reservations, and what else differs between the logs.
comparison = trivela.compare(monday, tuesday, by="log")
print(comparison.text)

# %% Efficiency of both with its interval, which allows for kicks of one match being alike.
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
for i, group in enumerate(comparison["groups"]):
    low, high = group["efficiency_ci95"]
    left.errorbar(i, group["efficiency"], [[group["efficiency"] - low], [high - group["efficiency"]]], fmt="o", capsize=6)
left.set_xticks(range(len(comparison["groups"])), [group["name"] for group in comparison["groups"]])
left.set(ylabel="efficiency", ylim=(0, 1))

# %% Were the situations alike? The kicks of both nights by their distance.
kicks = trivela.Log(monday, tuesday).kicks()
right.hist([group.distance_m for _, group in kicks.groupby("log")], bins=10, label=[name for name, _ in kicks.groupby("log")])
right.set(xlabel="distance to the target [m]", ylabel="kicks")
right.legend()
figure.savefig("two_nights.png", dpi=150)
print(kicks.groupby(["log", "policy"]).distance_m.describe().round(2).to_string())
