#!/usr/bin/env python3
"""Train a policy: train_a_policy.py [CANDIDATES] [MATCHES] writes trained.db and training.png.

A search over the settings of a policy. Every candidate plays the same matches; the best one is judged on others.
"""
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np
import trivela

n_candidates, matches = (int(word) for word in [*sys.argv[1:], *["12", "60"][len(sys.argv) - 1 :]])


# %% The policy: as `moving`, but patient while the goal is far and no opponent near
def patient(cycle, memory):
    output = cycle.moving()
    opponent_m = cycle.opponent_distance_m
    alone = opponent_m is None or opponent_m > cycle.setting("opponent_m")
    if output.reason == "fire" and alone and output.distance_m > cycle.setting("near_m"):
        output.reason = "waiting"
    return output


trivela.register_policy("patient", patient, {"near_m": (4.5, 0.0, 20.0), "opponent_m": (1.2, 0.0, 10.0)})


def arm(name, values):
    return {"name": name, "policy": "patient", "set": {"policy": {"own": {"patient": values}}}}


# %% The search: the same matches for all, so that less of the difference is chance
random = np.random.default_rng(1)
candidates = [{"near_m": random.uniform(3.0, 7.0), "opponent_m": random.uniform(0.6, 2.5)} for _ in range(n_candidates)]
arms = [arm(f"candidate {i}", values) for i, values in enumerate(candidates)]
rows = trivela.simulate(arms, matches=matches, possessions=20, seed=1)
share = np.array([(rows.outcome[rows.arm == one["name"]] == "on_target").mean() for one in arms])
best = candidates[int(share.argmax())]
print(f"best of {n_candidates}: near_m {best['near_m']:.2f}, opponent_m {best['opponent_m']:.2f}, {share.max():.3f} on target an opportunity")

# %% The judgement, on matches that nothing was chosen by
pathlib.Path("trained.db").unlink(missing_ok=True)  # of a run before
trivela.simulate([{"name": "moving", "policy": "moving"}, arm("trained", best)], matches=matches, possessions=20, seed=2, out="trained.db")
for pair in trivela.compare("trained.db", baseline="moving")["comparisons"]:
    print(pair["verdict"])

# %%
plt.scatter([one["near_m"] for one in candidates], [one["opponent_m"] for one in candidates], c=share)
plt.colorbar(label="on target an opportunity, in the search")
plt.xlabel("near_m [m]")
plt.ylabel("opponent_m [m]")
plt.title("SIMULATED")
plt.savefig("training.png")
