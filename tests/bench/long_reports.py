#!/usr/bin/env python3
"""How long `trivela report` takes over logs of 1 to 20 million rows, beside a GROUP BY of the sqlite3 shell.

    long_reports.py [--build DIR] [--folder DIR] [--millions 1,2,5,10,20] [--runs 3]

Records one match on the bus, makes of it logs of as many rows as asked for (tests/bench/long_log.cpp: each copy a
session of another seed), and runs both programs on each, in turn, the file read once before. Prints a table of
processor time (user and system), wall and peak memory, the least of the runs; the last column is what the report may
take: twice the GROUP BY and half a second.
"""
import argparse
import os
import pathlib
import sqlite3
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
GROUP_BY = "SELECT policy, count(*), sum(fire) FROM kick_decisions GROUP BY policy"


def run(command):
    """Processor seconds, wall seconds and peak kB of a command."""
    began = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{command[0]} failed: {process.returncode}")
    return used.ru_utime + used.ru_stime, time.monotonic() - began, used.ru_maxrss


def least(commands, runs):
    """Of each command the run of least processor time; the commands take turns."""
    took = [[run(command) for command in commands] for _ in range(runs)]
    return [min(of_one) for of_one in zip(*took)]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    arguments.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("out"))
    arguments.add_argument("--millions", default="1,2,5,10,20")
    arguments.add_argument("--runs", type=int, default=3)
    flags = arguments.parse_args()
    flags.folder.mkdir(parents=True, exist_ok=True)
    match = flags.folder / "match_of_long_logs.db"
    if not match.exists():
        subprocess.run([flags.build / "trivela", "match", "--half", "stopped", "--half", "moving", "--seed", "1", "--out", match],
                       check=True, stdout=subprocess.DEVNULL)
    rows = sqlite3.connect(match).execute("SELECT sum(row_count) FROM digests").fetchone()[0]
    print("million rows  sessions  MB    report: cpu s  wall s  MB  GROUP BY: cpu s  wall s  may be")
    for millions in flags.millions.split(","):
        copies = max(1, round(float(millions) * 1e6 / rows))
        log = flags.folder / f"long_{copies}.db"
        if not log.exists():
            subprocess.run([flags.build / "tests/long_log", match, log, "--copies", str(copies)], check=True,
                           stdout=subprocess.DEVNULL)
        with open(log, "rb") as file:
            while file.read(1 << 24):
                pass
        report, group_by = least([[flags.build / "trivela", "report", log], ["sqlite3", log, GROUP_BY]], flags.runs)
        print(f"{copies * rows / 1e6:12.1f}  {copies:8}  {log.stat().st_size / 1e6:4.0f}  {report[0]:13.2f}  {report[1]:6.2f}"
              f"  {report[2] / 1000:2.0f}  {group_by[0]:15.2f}  {group_by[1]:6.2f}  {2 * group_by[0] + 0.5:6.2f}", flush=True)


if __name__ == "__main__":
    main()
