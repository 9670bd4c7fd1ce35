#!/usr/bin/env python3
"""How long reports, their pages, merging and exporting take over logs of 1 to 20 million rows.

    long_reports.py [--build DIR] [--folder DIR] [--millions 1,2,5,10,20] [--pages 1,36] [--rates 2] [--runs 3]

Records one match on the bus, and makes of it logs of as many rows as asked for (tests/bench/long_log.cpp: each copy a
session of another seed). The file is read once before; the programs take turns; of processor time (user and system),
wall and peak memory the least of the runs counts. Prints three tables, of which an empty list leaves one out:

  --millions  `trivela report` beside a GROUP BY of the sqlite3 shell; the last column is what the report may take,
              twice the GROUP BY and half a second
  --pages     `trivela report` without and with --html, over so many matches: what the page adds, and its size
  --rates     rows a second of `trivela merge` and `trivela export`, over so many million rows
"""
import argparse
import os
import pathlib
import shutil
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


class Logs:
    """Logs of copies of one match."""

    def __init__(self, build, folder):
        self.build, self.folder, self.match = build, folder, folder / "match_of_long_logs.db"
        if not self.match.exists():
            subprocess.run([build / "trivela", "match", "--half", "stopped", "--half", "moving", "--seed", "1", "--out", self.match],
                           check=True, stdout=subprocess.DEVNULL)
        self.rows = sqlite3.connect(self.match).execute("SELECT sum(row_count) FROM digests").fetchone()[0]

    def copies_of(self, millions):
        return max(1, round(float(millions) * 1e6 / self.rows))

    def of(self, copies):
        log = self.folder / f"long_{copies}.db"
        if not log.exists():
            subprocess.run([self.build / "tests/long_log", self.match, log, "--copies", str(copies)], check=True,
                           stdout=subprocess.DEVNULL)
        with open(log, "rb") as file:
            while file.read(1 << 24):
                pass
        return log


def print_reports(logs, millions, runs):
    print("million rows  sessions  MB    report: cpu s  wall s  MB  GROUP BY: cpu s  wall s  may be")
    for copies in map(logs.copies_of, millions):
        log = logs.of(copies)
        report, group_by = least([[logs.build / "trivela", "report", log], ["sqlite3", log, GROUP_BY]], runs)
        print(f"{copies * logs.rows / 1e6:12.1f}  {copies:8}  {log.stat().st_size / 1e6:4.0f}  {report[0]:13.2f}  {report[1]:6.2f}"
              f"  {report[2] / 1000:2.0f}  {group_by[0]:15.2f}  {group_by[1]:6.2f}  {2 * group_by[0] + 0.5:6.2f}", flush=True)


def print_pages(logs, matches, runs):
    print("matches  report: cpu s  wall s  with its page: cpu s  wall s  MB  the page: cpu s  wall s  bytes")
    for copies in matches:
        log, page = logs.of(int(copies)), logs.folder / "page.html"
        plain, whole = least([[logs.build / "trivela", "report", log], [logs.build / "trivela", "report", log, "--html", page]], runs)
        print(f"{copies:>7}  {plain[0]:13.2f}  {plain[1]:6.2f}  {whole[0]:20.2f}  {whole[1]:6.2f}  {whole[2] / 1000:2.0f}"
              f"  {whole[0] - plain[0]:15.2f}  {whole[1] - plain[1]:6.2f}  {page.stat().st_size:5}", flush=True)


def print_rates(logs, millions, runs):
    print("million rows  verb          cpu s  wall s  MB  rows/s of processor time  by the clock")
    for copies in map(logs.copies_of, millions):
        log, rows = logs.of(copies), copies * logs.rows
        made = {"merge": logs.folder / "merged.db", "export --csv": logs.folder / "csv", "export --mcap": logs.folder / "log.mcap"}
        for verb, place in made.items():
            name, *flag = verb.split()
            command = [logs.build / "trivela", name, *([log, *flag, place] if flag else [place, log])]
            took = []
            for _ in range(runs):
                shutil.rmtree(place, ignore_errors=True)
                place.unlink(missing_ok=True)
                took.append(run(command))
            cpu_s, wall_s, peak_kB = min(took)
            print(f"{rows / 1e6:12.1f}  {verb:12}  {cpu_s:5.1f}  {wall_s:6.1f}  {peak_kB / 1000:2.0f}  {rows / cpu_s:24.0f}  {rows / wall_s:12.0f}",
                  flush=True)
            shutil.rmtree(place, ignore_errors=True)
            place.unlink(missing_ok=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    arguments.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("out"))
    for flag, usual in (("--millions", "1,2,5,10,20"), ("--pages", "1,36"), ("--rates", "2")):
        arguments.add_argument(flag, type=lambda text: [part for part in text.split(",") if part], default=usual)
    arguments.add_argument("--runs", type=int, default=3)
    flags = arguments.parse_args()
    flags.folder.mkdir(parents=True, exist_ok=True)
    logs = Logs(flags.build, flags.folder)
    for asked, table in ((flags.millions, print_reports), (flags.pages, print_pages), (flags.rates, print_rates)):
        if asked:
            table(logs, asked, flags.runs)


if __name__ == "__main__":
    main()
