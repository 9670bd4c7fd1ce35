#!/usr/bin/env python3
"""trivela-launch with nodes that are scripts: what is started, started again and stopped, and in which order."""
import os
import pathlib
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

LAUNCH = pathlib.Path(__file__).resolve().parents[2] / "packaging/trivela-launch"
# Says its life into a pipe; "die" ends once and lives then, "bad" is called wrongly.
NODE = """#!/bin/sh
name=$(basename "$0"); name=${name#trivela-}
say() { echo "$name $*" >"$SAID"; }
trap 'say stopped; exit 0' TERM
say started "$@"
case $name in
  bad) exit 2 ;;
  die) [ -e died ] || { touch died; exit 1; } ;;
esac
while :; do sleep 60 & wait $!; done
"""


class Launch(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="trivela-launch-"))
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copy(LAUNCH, self.folder)
        for name in ("recorder", "odometry", "die", "bad"):
            node = self.folder / f"trivela-{name}"
            node.write_text(NODE)
            node.chmod(0o755)
        os.mkfifo(self.folder / "said")
        self.said = os.open(self.folder / "said", os.O_RDWR)
        self.addCleanup(os.close, self.said)
        self.text = b""

    def next(self):
        """The next line that a node says."""
        while b"\n" not in self.text:
            self.assertTrue(select.select([self.said], [], [], 30)[0], "nobody says anything")
            self.text += os.read(self.said, 4096)
        line, self.text = self.text.split(b"\n", 1)
        return line.decode()

    def start(self, nodes, more=""):
        (self.folder / "robot.env").write_text(
            f'TRIVELA_NODES="{nodes}"\nTRIVELA_SETTINGS=/settings.toml\nTRIVELA_FOLDER={self.folder}\nSAID={self.folder}/said\n{more}')
        process = subprocess.Popen([self.folder / "trivela-launch", self.folder / "robot.env"], stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.addCleanup(lambda: (os.killpg(process.pid, signal.SIGKILL) if process.poll() is None else None, process.stderr.close()))
        return process

    def test_starts_each_with_its_flags_and_stops_the_recorder_last(self):
        process = self.start("recorder odometry", 'TRIVELA_FLAGS_odometry="--realtime 50"\n')
        self.assertEqual({self.next(), self.next()},
                         {"recorder started --config /settings.toml", "odometry started --config /settings.toml --realtime 50"})
        process.send_signal(signal.SIGTERM)
        self.assertEqual([self.next(), self.next()], ["odometry stopped", "recorder stopped"])
        self.assertEqual(process.wait(30), 0)
        self.assertTrue((self.folder / "odometry.log").exists())

    def test_one_that_dies_is_started_again(self):
        process = self.start("die")
        self.assertEqual([self.next(), self.next()], ["die started --config /settings.toml"] * 2)
        process.send_signal(signal.SIGINT)
        self.assertEqual(self.next(), "die stopped")
        self.assertEqual(process.wait(30), 0)
        self.assertIn("die ended with 1", (self.folder / "die.log").read_text())

    def test_bad_usage_is_not_tried_again(self):
        process = self.start("bad")
        self.assertEqual(process.wait(30), 2)
        self.assertIn("no node runs", process.stderr.read())
        self.assertEqual(self.next(), "bad started --config /settings.toml")
        self.assertEqual(self.text, b"")

    def test_what_is_missing_is_named(self):
        process = self.start("nobody")
        self.assertEqual(process.wait(30), 2)
        self.assertIn("TRIVELA_NODES names nobody", process.stderr.read())


if __name__ == "__main__":
    sys.exit(unittest.main())
