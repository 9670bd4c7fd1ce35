"""What can be said of the documents' commands without running them."""
import re
import subprocess


def not_run(root):
    """The commands that no test runs, from not_run.txt: {regular expression: reason}."""
    found = {}
    for line in (root / "tests/docs/not_run.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            pattern, reason = line.split("\t")
            found[re.compile(pattern)] = reason
    return found


def _help(build, words, known):
    """The help of `trivela WORDS`, each asked once."""
    key = tuple(words)
    if key not in known:
        answer = subprocess.run([build / "trivela", *words, "--help"], capture_output=True, text=True)
        known[key] = answer.stdout if answer.returncode == 0 else ""
    return known[key]


def synopsis_problem(build, text, known):
    """Why `trivela VERB [VERB] --flag ...` cannot be meant for this program; empty if it can."""
    words = re.findall(r"[^\s\[\]|]+", text)[1:]
    verbs = []
    while words and re.fullmatch(r"[a-z][a-z-]*", words[0]) and re.search(
            rf"^  {words[0]}(?=\s|$)", _help(build, verbs, known), re.M):
        verbs.append(words.pop(0))
    if not verbs and words and re.fullmatch(r"[a-z][a-z-]*", words[0]):
        return f"trivela has no verb {words[0]}"
    for flag in re.findall(r"(?<![\w-])--[a-z][a-z-]*", " ".join(words)):
        if not re.search(rf"{flag}(?![\w-])", _help(build, verbs, known)):
            return f"trivela {' '.join(verbs)} has no {flag}"
    return ""


def unbuilt_programs(root, documents, build):
    """Programs that the documents' commands or `trivela` itself start and that ./quickstart does not build."""
    texts = " ".join(command.text for document in documents for block in document.blocks for command in block.commands)
    needed = set(re.findall(r"build/release/(trivela[\w-]*)", texts))
    needed |= {f"trivela-{path.parent.name}" for path in (root / "nodes").glob("*/*_node.cpp")}
    target = re.search(r"^build release (\S+)$", (root / "quickstart").read_text(), re.M).group(1)
    built = subprocess.run(["ninja", "-C", build, "-t", "query", target], capture_output=True, text=True, check=True)
    return sorted(needed - set(built.stdout.split()))


def unknown_programs(documents, build):
    """Programs of the build folder that a document names and that are no target of it: (document, name)."""
    known = subprocess.run(["ninja", "-C", build, "-t", "targets", "all"], capture_output=True, text=True, check=True)
    targets = {line.rsplit(":", 1)[0] for line in known.stdout.splitlines()}
    for document in documents:
        for name in sorted(set(re.findall(r"build/release/((?:tests/)?[a-z][a-z0-9_-]*)(?![\w-])", "\n".join(document.lines)))):
            if name not in targets and f"{name}/all" not in targets:  # a folder
                yield document.name, name


def listed_problems(root, documents, build):
    """Stale entries of not_run.txt, verbs and flags that the program does not have, figures that no command draws,
    programs that ./quickstart does not build."""
    problems, known = [], {}
    texts = [command.text for document in documents for block in document.blocks for command in block.commands]
    for pattern in not_run(root):
        if not any(pattern.fullmatch(text) for text in texts):
            problems.append(f"tests/docs/not_run.txt: {pattern.pattern}: no document shows such a command")
    for document in documents:
        for line, text in document.synopses:
            if problem := synopsis_problem(build, text, known):
                problems.append(f"{document.name}:{line}: {text}: {problem}")
    named = " ".join(texts) + " ".join(block.keys.get("figure", "") for d in documents for block in d.blocks)
    for figure in sorted((root / "docs/figures").iterdir()):
        if f"docs/figures/{figure.name}" not in named:
            problems.append(f"docs/figures/{figure.name}: no command of a document draws it")
    problems += [f"{document}: build/release/{name} is no target" for document, name in unknown_programs(documents, build)]
    problems += [f"quickstart: does not build {program}" for program in unbuilt_programs(root, documents, build)]
    return problems
