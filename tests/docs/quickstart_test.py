#!/usr/bin/env python3
"""./quickstart with a compiler and a match that do nothing: which log it writes, and that it takes nobody's."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MATCH = '#!/bin/bash\nwhile [[ $# -gt 0 ]]; do [[ $1 != --out ]] || echo played >"$2"; shift; done\n'


class Quickstart(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="trivela-quickstart-"))
        self.addCleanup(shutil.rmtree, self.folder)
        for name in ("quickstart", "setup.sh"):
            shutil.copy(ROOT / name, self.folder)
        (self.folder / "packages.txt").write_text("# none\n")
        self.program("build/release/trivela", MATCH)
        for tool in ("apt-get", "cmake", "ninja", "g++", "idlc"):
            self.program(f"tools/{tool}", "#!/bin/bash\n")

    def program(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def run_it(self):
        path = f"{self.folder}/tools:{os.environ['PATH']}"
        done = subprocess.run(["./quickstart"], cwd=self.folder, env={**os.environ, "PATH": path}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_no_match_log_is_lost(self):
        kept = {"match.db": "a user's match", "match.db-wal": "not folded in yet"}
        (self.folder / "out").mkdir()
        for name, text in kept.items():
            (self.folder / "out" / name).write_text(text)
        self.assertIn("out/quickstart.db ", self.run_it())
        (self.folder / "out/quickstart.db").write_text("the first one")
        (self.folder / "out/quickstart-2.db-wal").write_text("cut short")
        self.assertIn("out/quickstart-3.db ", self.run_it())
        self.assertEqual((self.folder / "out/quickstart-3.db").read_text(), "played\n")
        kept.update({"quickstart.db": "the first one", "quickstart-2.db-wal": "cut short"})
        for name, text in kept.items():
            self.assertEqual((self.folder / "out" / name).read_text(), text, name)


if __name__ == "__main__":
    sys.exit(unittest.main())
