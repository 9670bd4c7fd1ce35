#!/usr/bin/env python3
"""beside.py BEFORE AFTER [--runs N]: the benchmarks of two builds in turns, N times each (5).

BEFORE and AFTER are build folders. Measured are:
- of decision_bench, lob_bench and simulate_bench the processor time of each benchmark, of `trivela simulate` with its log that of the whole;
- of a lockstep match and of the report of its log the time that passes;
- of chain_bench the median of each chain.
The table has the medians of the runs, their ratio, and the spread of BEFORE's runs (largest less smallest, of its median). A mark shows
where AFTER is slower by more than that and by more than 3 %.
"""
import argparse
import json
import pathlib
import re
import resource
import statistics
import subprocess
import tempfile
import time

MARGIN = 0.03
SIMULATE = ["simulate", "--arms", "stopped,moving", "--matches", "200", "--possessions", "60", "--seed", "3", "--jobs", "1"]


def benchmarks(build, name):
    done = subprocess.run([build / "tests" / name, "--benchmark_format=json", "--benchmark_min_time=0.3"], capture_output=True, check=True)
    return {f"{name} {row['name']} [{row['time_unit']}]": row["cpu_time"] for row in json.loads(done.stdout)["benchmarks"]}


def simulate(build):
    with tempfile.TemporaryDirectory() as folder:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([build / "trivela", *SIMULATE, "--out", pathlib.Path(folder) / "s.db"], capture_output=True, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return {"trivela simulate, its log written [s]": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime}


def match(build):
    with tempfile.TemporaryDirectory() as folder:
        log, times = pathlib.Path(folder) / "m.db", [time.monotonic()]
        halves = ["--half", "stopped", "--half", "moving"]
        for verb in ["match", *halves, "--minutes", "2", "--seed", "1", "--out", log], ["report", log]:
            subprocess.run([build / "trivela", *verb], capture_output=True, check=True)
            times.append(time.monotonic())
    return {"trivela match, 4 minutes in lockstep [s]": times[1] - times[0], "trivela report of its log [s]": times[2] - times[1]}


def chain(build):
    done = subprocess.run([build / "tests" / "chain_bench", "--samples", "100", "--rates", "100", "1000"], capture_output=True, check=True, text=True)
    row = re.compile(r"^ *(\d+) idle +SCHED_OTHER +(?:\d+ % )?(.+?) {2,}\d+ +\d+ +([\d.]+) ", re.M)
    return {f"chain_bench {rate} Hz, {name} [us]": float(p50) for rate, name, p50 in row.findall(done.stdout)}


def run(build):
    return benchmarks(build, "decision_bench") | benchmarks(build, "lob_bench") | benchmarks(build, "simulate_bench") | simulate(build) | match(build) | chain(build)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("before", type=pathlib.Path)
    parser.add_argument("after", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=5)
    args = parser.parse_args()
    runs = [(run(args.before.resolve()), run(args.after.resolve())) for _ in range(args.runs)]
    print("| benchmark | before | after | ratio | spread before |\n|---|---|---|---|---|")
    for name in runs[0][0]:
        if name not in runs[0][1]:
            print(f"| {name} | not in AFTER | | | |")
            continue
        before, after = ([pair[side][name] for pair in runs] for side in (0, 1))
        median = statistics.median(before)
        ratio, spread = statistics.median(after) / median, (max(before) - min(before)) / median
        mark = " **slower**" if ratio > 1 + max(MARGIN, spread) else ""
        print(f"| {name} | {median:.4g} | {statistics.median(after):.4g} | {ratio:.2f}{mark} | {100 * spread:.0f} % |")


if __name__ == "__main__":
    main()
