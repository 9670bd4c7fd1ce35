#!/usr/bin/env python3
"""manual_test.py BUILD: manual pages and completions have every verb and flag that the help has."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

TRIVELA = pathlib.Path(sys.argv.pop()).resolve() / "trivela"


def said(*words):
    return subprocess.run([TRIVELA, *words], capture_output=True, text=True, check=True).stdout


def verbs_of(path):
    """The verbs below `path`, by its help: indented by two, under headings that are no options."""
    part = re.split(r"^(?:Options|Positionals|\[Option Group.*\]):?.*\n(?:^  .*\n|^ .*\n)*", said(*path, "--help"), flags=re.M)
    return re.findall(r"^  ([a-z][a-z-]*)(?=\s|$)", "\n".join(part[1:]), re.M)


def all_verbs(path=()):
    found = [path]
    for verb in verbs_of(path):
        found += all_verbs((*path, verb))
    return found


def flags_of(path):
    return set(re.findall(r"^  (?:-\w,)?(--[a-z][a-z0-9-]*)", said(*path, "--help"), re.M))


def completed(script, *words):
    """What bash offers for the last word."""
    line = f'source {script}; COMP_WORDS=({" ".join(words)}); COMP_CWORD={len(words) - 1}; _trivela; printf "%s\\n" "${{COMPREPLY[@]}}"'
    return set(subprocess.run(["bash", "-c", line], capture_output=True, text=True, check=True).stdout.split())


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="trivela-manual-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.scripts = {}
        for shell in ("bash", "zsh", "fish"):
            cls.scripts[shell] = cls.folder / shell
            cls.scripts[shell].write_text(said("--completion", shell))
        cls.verbs = all_verbs()
        assert len(cls.verbs) > 30, cls.verbs

    def test_bash_completes_every_verb_and_flag(self):
        subprocess.run(["bash", "-n", self.scripts["bash"]], check=True)
        for path in self.verbs[:12]:
            below = completed(self.scripts["bash"], "trivela", *path, "''")
            self.assertLessEqual(flags_of(path) | set(verbs_of(path)), below, path)
        text = self.scripts["bash"].read_text()
        for path in self.verbs:
            words = re.search(rf"^    \['{' '.join(('trivela', *path))}'\]='(.*)'$", text, re.M)[1].split()
            self.assertLessEqual(flags_of(path) | set(verbs_of(path)), set(words), path)

    def test_bash_completes_the_beginnings_of_words_and_the_values_of_flags(self):
        script = self.scripts["bash"]
        self.assertEqual(completed(script, "trivela", "mat"), {"match"})
        self.assertEqual(completed(script, "trivela", "match", "--hal"), {"--half"})
        self.assertIn("predictive", completed(script, "trivela", "match", "--half", "pre"))
        self.assertEqual(completed(script, "trivela", "match", "--out", "''"), set(), "a file")
        self.assertEqual(completed(script, "trivela", "--completion", "f"), {"fish"})

    def test_the_other_shells_have_every_verb(self):
        for path in self.verbs[1:]:
            self.assertIn(f"['{' '.join(('trivela', *path))}']=", self.scripts["zsh"].read_text())
            self.assertRegex(self.scripts["fish"].read_text(), rf"(?m)^complete -c trivela.* -a {path[-1]} -d ")
        for shell in ("zsh", "fish"):
            if shutil.which(shell):
                subprocess.run([shell, "-n", self.scripts[shell]], check=True)

    def test_the_pages_have_every_verb_and_node(self):
        page = said("--man", "verbs")
        for path in self.verbs[1:]:
            self.assertIn("\n.SS " + " ".join(("trivela", *path)).replace("-", "\\-") + "\n", page)
            for flag in flags_of(path):
                self.assertIn("\\fB" + flag.replace("-", "\\-") + "\\fR", page)
        nodes = said("--man", "nodes")
        for program in set(TRIVELA.parent.glob("trivela-*")) - {TRIVELA.parent / "trivela-emulate"}:
            self.assertIn(program.name.replace("-", "\\-"), nodes)
        for flag in ("--config", "--set", "--realtime"):
            self.assertIn(flag.replace("-", "\\-"), nodes)

    def test_man_finds_nothing_to_warn_of(self):
        if not shutil.which("groff"):
            return
        for which in ("verbs", "nodes"):
            shown = subprocess.run(["groff", "-man", "-ww", "-Tutf8"], input=said("--man", which), capture_output=True, text=True, check=True)
            self.assertEqual([line for line in shown.stderr.splitlines() if "adjust" not in line and "break" not in line], [])

    def test_another_shell_is_bad_usage(self):
        self.assertEqual(subprocess.run([TRIVELA, "--completion", "tcsh"], capture_output=True).returncode, 2)


if __name__ == "__main__":
    sys.exit(unittest.main())
