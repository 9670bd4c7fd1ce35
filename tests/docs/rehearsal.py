"""One document's commands, run in order in a folder of their own, and how what they print differs from what is shown."""
import difflib
import os
import re
import shutil
import signal
import subprocess
import threading
import xml.etree.ElementTree
from dataclasses import dataclass

from listed import not_run
from masks import masked, numbers, shape, stands_in

PATIENCE_S = {False: 300, True: 7200}  # reduced, whole
MOST_LINES = 60  # of one problem


@dataclass
class Printed:
    lines: list
    whole: bool  # no part of it rests on a reduced run


class Rehearsal:
    def __init__(self, root, build, folder, full, update):
        self.root, self.folder, self.full, self.update = root, folder, full, update
        self.reasons = not_run(root)
        self.printed, self.reduced_files, self.problems, self.edits = {}, set(), [], []
        (folder / "build").mkdir()
        (folder / "build/release").symlink_to(build)
        (folder / "tests").mkdir()
        for read in ("vectors", "data"):
            (folder / "tests" / read).symlink_to(root / "tests" / read)
        shutil.copytree(root / "config", folder / "config", ignore=shutil.ignore_patterns("*.cpp", "*.hpp"))
        # Two runs on one machine do not hear each other.
        settings = folder / "config/default.toml"
        lines = {"domain_id": str(1 + os.getpid() % 100), "tag": f'"docs-{os.getpid()}"'}
        settings.write_text(re.sub(r"^(domain_id|tag) = \S+", lambda m: f"{m[1]} = {lines[m[1]]}", settings.read_text(), flags=re.M))
        for made in ("out", "docs/figures"):
            (folder / made).mkdir(parents=True)

    def play(self, document):
        """Every block in order; what is wrong, each with document and line."""
        self.name = document.name
        for block in document.blocks:
            if block.about == "file":
                (self.folder / block.keys["name"]).write_text("\n".join(block.lines) + "\n")
            elif block.about == "output":
                self._compare_part(block)
            elif block.about == "numbers":
                self._find_numbers(block)
            elif block.commands:
                self._run_block(block)
        return self.problems

    def updated(self, document):
        """The document's lines with what was printed in place of what was shown."""
        lines = list(document.lines)
        for begin, end, indent, shown in sorted(self.edits, reverse=True):
            lines[begin:end] = [(" " * indent + line).rstrip() for line in shown]
        return lines

    # A block of commands.
    def _run_block(self, block):
        keys = block.keys
        for setup in filter(None, (part.strip() for part in keys.get("setup", "").split(";"))):
            code, lines = self._run(setup)
            if code != 0:
                self._wrong(block.line, f"setup: {setup}: exit code {code}", lines)
        if keys.get("together"):
            return self._run_together(block)
        for command in block.commands:
            if any(reason.fullmatch(command.text) for reason in self.reasons):
                continue
            text, is_reduced = self._reduced(command, keys, block)
            before = self._files()
            code, lines = self._run(text, keys.get("interrupt"))
            made = {path for path, state in self._files().items() if before.get(path) != state}
            rests_on_reduced = is_reduced or any(path in text for path in self.reduced_files)
            self.reduced_files |= made if rests_on_reduced else set()
            expected = keys.get("exit", "0")
            if str(code) not in (expected, keys.get("reduced_exit") if rests_on_reduced else expected):
                self._wrong(command.line, f"{text}: exit code {code}, {expected} is documented", lines)
            printed = Printed(lines, not rests_on_reduced)
            if "name" in keys:  # what the block prints, all of it
                earlier = self.printed.get(keys["name"], Printed([], True))
                self.printed[keys["name"]] = Printed(earlier.lines + lines, earlier.whole and printed.whole)
            if command.shown:
                self._compare(printed, keys, command.line, command.shown, (command.begin, command.end, block.indent), text)
            self._look_at_figures(command, keys, made, printed.whole)

    def _reduced(self, command, keys, block):
        text = command.text
        if self.full or "reduced" not in keys:
            return text, False
        for replacement in keys["reduced"].split(";"):
            old, new = (part.strip() for part in replacement.split("=>"))
            if not any(old in other.text for other in block.commands):
                self._wrong(block.line, f"reduced: no command of the block has {old}")
            text = text.replace(old, new)
        return text, text != command.text

    def _run(self, text, interrupt=None):
        """(exit code, lines of standard output and error)."""
        process = self._start(text)
        end = threading.Timer(PATIENCE_S[self.full], os.killpg, (process.pid, signal.SIGKILL))
        end.start()
        output = ""
        if interrupt:
            for line in process.stdout:
                output += line
                if interrupt in line:
                    os.killpg(process.pid, signal.SIGINT)
                    break
        output += process.communicate()[0]
        end.cancel()
        if process.returncode == -signal.SIGKILL:
            output += f"\nstopped after {PATIENCE_S[self.full]} s"
        return process.returncode, self._tidy(output)

    def _start(self, text):
        return subprocess.Popen(["bash", "-c", text], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, start_new_session=True,
                                env={**os.environ, "LC_ALL": "C.UTF-8",
                                     "PATH": f"{self.folder}/build/release:{os.environ['PATH']}"})

    def _run_together(self, block):
        """All at once; the last one's end ends the others, which must end with 0 as well."""
        texts = [self._reduced(command, block.keys, block)[0] for command in block.commands]
        others = [self._start("exec " + text) for text in texts[:-1]]
        code, lines = self._run(texts[-1])
        ends = [(code, texts[-1], lines)]
        for process, text in zip(others, texts):
            process.send_signal(signal.SIGTERM)
            try:
                output = process.communicate(timeout=20)[0]
            except subprocess.TimeoutExpired:
                process.kill()
                output = process.communicate()[0]
            ends.append((process.returncode, text, self._tidy(output)))
        for code, text, lines in ends:
            if code != 0:
                self._wrong(block.line, f"{text}: exit code {code}", lines)

    def _tidy(self, output):
        lines = output.replace(str(self.folder), "...").split("\n")
        while lines and not lines[-1].strip():
            lines.pop()
        return [line.rstrip() for line in lines]

    def _files(self):
        """Every file of the folder: its path from there and what changes when it is written."""
        found = {}
        for path in self.folder.rglob("*"):
            if path.is_file() and not path.is_relative_to(self.folder / "build"):
                stat = path.stat()
                found[str(path.relative_to(self.folder))] = (stat.st_mtime_ns, stat.st_size)
        return found

    # What is shown.
    def _compare_part(self, block):
        printed = self.printed.get(block.keys["of"])
        if printed is None:
            return self._wrong(block.line, f"no command named {block.keys['of']} stands above")
        place = (block.begin, block.end, block.indent)
        self._compare(printed, block.keys, block.line, block.lines, place, block.keys["of"], outdented=True)

    def _compare(self, printed, keys, line, shown, place, text, outdented=False):
        part = part_of(printed.lines, keys)
        if outdented and part:  # the block's own indent stands for that of the first line
            margin = len(part[0]) - len(part[0].lstrip())
            part = [text[margin:] if text[:margin].isspace() else text for text in part]
        if not part:
            return self._wrong(line, f"{text}: prints nothing from {keys.get('from')} on", printed.lines)
        same = masked if printed.whole else shape
        if same(part) == same(shown) or (not printed.whole and keys.get("shape") == "no"):
            return
        if self.update and printed.whole:
            self.edits.append((*place, part))
        else:
            self._wrong(line, f"{text}: prints something else" + ("" if printed.whole else " (a reduced run: # is a number)"),
                        difflib.unified_diff(same(shown), same(part), "document", "command", lineterm="", n=1))

    def _find_numbers(self, block):
        known, whole = set(), True
        for name in re.split(r",\s*", block.keys["of"]):
            if name not in self.printed:
                return self._wrong(block.line, f"no command named {name} stands above")
            whole = whole and self.printed[name].whole
            known |= set(numbers("\n".join(self.printed[name].lines)))
        missing = [number for number in numbers("\n".join(block.lines)) if not stands_in(number, known)]
        if whole and missing:
            self._wrong(block.line, f"{', '.join(missing)}: {block.keys['of']} prints no such number")

    def _look_at_figures(self, command, keys, made, whole):
        pairs = dict(tuple(part.strip() for part in pair.split("=>")) for pair in filter(None, keys.get("figure", "").split(";")))
        pairs = {source: to for source, to in pairs.items() if source in command.text}
        pairs.update({path: path for path in made if path.startswith("docs/figures/")})
        for source, committed in pairs.items():
            try:
                xml.etree.ElementTree.parse(self.folder / source)
            except (OSError, xml.etree.ElementTree.ParseError) as error:
                self._wrong(command.line, f"{source}: not a figure: {error}")
                continue
            if not whole or (self.folder / source).read_text() == (self.root / committed).read_text():
                continue
            if self.update:
                shutil.copyfile(self.folder / source, self.root / committed)
                print(f"{committed}: made again")
            else:
                self._wrong(command.line, f"{committed} is not what the command draws")

    def _wrong(self, line, sentence, more=()):
        more = list(more)
        more = more[:MOST_LINES] + [f"... {len(more) - MOST_LINES} lines more"] * (len(more) > MOST_LINES)
        self.problems.append("\n".join([f"{self.name}:{line}: {sentence}", *("    " + text for text in more)]))


def part_of(lines, keys):
    """From the first line that `from` finds to the first one after it that `until` finds; without until to the end."""
    begin, end = 0, len(lines)
    if "from" in keys:
        begin = next((i for i, line in enumerate(lines) if re.search(keys["from"], line)), len(lines))
    if "until" in keys:
        end = next((i + 1 for i in range(begin, len(lines)) if re.search(keys["until"], lines[i])), begin)
    part = lines[begin:end]
    while part and not part[-1].strip():
        part = part[:-1]
    return part
