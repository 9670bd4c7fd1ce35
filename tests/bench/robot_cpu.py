#!/usr/bin/env python3
"""robot_cpu.py BUILD [--hz N] [--seconds N] [--realtime N] [--processor N]: how much of a core the processes of one robot take.

Plays the simulator in real time at that cycle with the programs of BUILD, first without the recorder, then with it, and both with
the decision path in one process (run.one_process), and reads what each process has used from /proc: its threads, those of the DDS library among them. The simulator, which stands in for
the hardware, is shown apart. Beside the recorder also how long after the wheels' instant the driver had the orders. A robot has nobody beside it: how busy this machine was stands in the last line.
"""
import argparse
import os
import pathlib
import re
import sqlite3
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BESIDE = ["kicker_driver", "shot_observer"]
APART = ["odometry", "world_state", "kick_decision", *BESIDE]
TOGETHER = ["chain", *BESIDE]


def used_s(pid):
    """Processor time of all threads of a process, in seconds; 0 where it is gone. Not in ticks of 10 ms, as stat has it: most
    of a node's turns are shorter."""
    try:
        return sum(int((task / "schedstat").read_text().split()[0]) for task in pathlib.Path(f"/proc/{pid}/task").iterdir()) * 1e-9
    except FileNotFoundError:
        return 0.0


def machine():
    """Used and total time of all processors."""
    ticks = [int(word) for word in pathlib.Path("/proc/stat").read_text().split("\n")[0].split()[1:9]]
    return sum(ticks) - ticks[3] - ticks[4], sum(ticks)


def write_files(folder, hz, domain):
    cycle = f"cycle_s = {1.0 / hz!r}\n"
    scenario = (ROOT / "config/scenarios/default.toml").read_text()
    scenario, changed = re.subn(r"^cycle_s = [^\n]*\n", cycle, scenario, count=1, flags=re.M)
    if changed != 1:
        sys.exit("robot_cpu.py: config/scenarios/default.toml has no cycle_s")
    scenario = scenario.replace('"../', f'"{ROOT}/config/')
    (folder / "scenario.toml").write_text(scenario)
    (folder / "nodes.toml").write_text(f"""[run]
{cycle}lockstep = false
robot = "{ROOT}/config/robots/cambada_1.toml"
scenario = "{folder}/scenario.toml"
[domain]
domain_id = {domain}
tag = "robot-cpu-{os.getpid()}"
[simulator]
halves = 1
half_minutes = 60
[kick_decision]
policy_by_half = ["moving"]
[recorder]
log = "{folder}/match.db"
""")


def play(build, folder, nodes, seconds, flags):
    """What each process used, in % of a core, over the seconds after all of them were there."""
    processes = {}
    try:
        for node in [*nodes, "simulator"]:
            more = flags if node != "simulator" else []
            processes[node] = subprocess.Popen(
                [build / f"trivela-{node}", "--config", folder / "nodes.toml", *more], cwd=folder,
                stdout=subprocess.DEVNULL, stderr=(folder / f"{node}.log").open("w"))
        time.sleep(5)  # discovery and the first possession
        start, before = time.monotonic(), {node: used_s(process.pid) for node, process in processes.items()}
        time.sleep(seconds)
        took = time.monotonic() - start
        after = {node: used_s(process.pid) for node, process in processes.items()}
        for node, process in processes.items():
            if process.poll() is not None:
                sys.exit(f"robot_cpu.py: {node} ended: {(folder / f'{node}.log').read_text().strip()}")
        return {node: 100.0 * (after[node] - before[node]) / took for node in processes}
    finally:
        for process in processes.values():
            process.terminate()
        for process in processes.values():
            process.wait()


def ages_us(log):
    """From the instant of the wheels' sample until the driver took the order, each, in microseconds."""
    with sqlite3.connect(log) as rows:
        return [us for (us,) in rows.execute("SELECT (received_steady_ns - order_t_ns) * 1e-3 FROM kick_receipts WHERE received_steady_ns > 0")]


def row(name, percent, nodes):
    each = "  ".join(f"{node} {percent[node]:.2f}" for node in nodes)
    print(f"{name:<18} {sum(percent[node] for node in nodes):5.2f} % of a core  ({each}; beside it simulator {percent['simulator']:.2f})")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--hz", type=int, default=100, help="cycles a second (100)")
    parser.add_argument("--seconds", type=float, default=30.0, help="of each run (30)")
    parser.add_argument("--realtime", help="SCHED_FIFO priority of the robot's nodes")
    parser.add_argument("--processor", help="which the robot's nodes run on")
    args = parser.parse_args()
    if args.hz < 2 or args.hz > 1000 or not 0 < args.seconds < 3600:
        parser.error("--hz is 2..1000, --seconds above 0 and below 3600")
    flags = [word for name in ("realtime", "processor") if getattr(args, name) for word in (f"--{name}", getattr(args, name))]
    used, total = machine()
    for name, nodes in (("without recorder", APART), ("with recorder", ["recorder", *APART]),
                        ("one process", TOGETHER), ("  with recorder", ["recorder", *TOGETHER])):
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            write_files(folder, args.hz, os.getpid() % 100 + 1)
            row(name, play(args.build.resolve(), folder, nodes, args.seconds, flags), nodes)
            if "recorder" in nodes:
                ages = ages_us(folder / "match.db")
                print(f"{'':<18} wheels to driver: median {statistics.median(ages):.0f}, most {max(ages):.0f} us of {len(ages)} orders" if ages else f"{'':<18} no order")
    used_after, total_after = machine()
    print(f"{args.hz} Hz, {args.seconds:g} s each; all processors together were {100 * (used_after - used) / (total_after - total):.0f} % busy, all of this included")


if __name__ == "__main__":
    main()
