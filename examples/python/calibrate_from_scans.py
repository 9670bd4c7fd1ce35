#!/usr/bin/env python3
"""Calibrate from scans: calibrate_from_scans.py SCANS.db... prints a robot's height table and writes calibration.png.

`trivela calibrate table` makes the robot's file of the same figures; here they are looked at.
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import trivela

# %% The lobs that the scanner saw, and why some are no trials.
lobs = pd.concat([trivela.lobs(scans) for scans in sys.argv[1:]], ignore_index=True)
for lob in lobs[~lobs.accepted].itertuples():
    print(f"refused ({lob.refusal}): {lob.why}")
trials = lobs[lobs.accepted & lobs.power.notna()]

# %% The table: effective exit speeds, which the policies' laws need.
table = trivela.fit_table(trials.power, trials.exit_speed_mps, trials.exit_angle_rad)
for warning in table.warnings:
    print("warning:", warning)
shown = table.set_points.assign(exit_angle_deg=np.degrees(table.set_points.exit_angle_rad))
print(shown[["power", "trials", "exit_speed_mps", "exit_speed_sd_mps", "exit_angle_deg"]].round(3).to_string(index=False))
print(f"exit angle {np.degrees(table.exit_angle_rad):.2f} +- {np.degrees(table.exit_angle_se_rad):.2f} degrees")
print(f"from kick to kick {table.exit_speed_sd_mps:.3f} m/s; the table {'rises' if table.rises else 'does not rise: kick more'}")

# %% How far a kick of each power passes below the bar.
distance_m = np.linspace(2.0, 8.0, 61)
kicks = trivela.solve(distance_m, 0.7 - 0.11, table.exit_angle_rad)
power = np.interp(kicks.v0_mps, table.set_points.exit_speed_mps, table.set_points.power, left=np.nan, right=np.nan)

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
left.plot(trials.power, trials.exit_speed_mps, ".", label="lobs")
left.plot(table.set_points.power, table.set_points.exit_speed_mps, "k-", label="table")
left.set(xlabel="power", ylabel="effective exit speed [m/s]")
left.legend()
right.plot(distance_m, power)
right.set(xlabel="distance [m]", ylabel="power for 0.7 m over the line, robot at rest")
figure.savefig("calibration.png", dpi=150)
