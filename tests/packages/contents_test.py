#!/usr/bin/env python3
"""contents_test.py BUILD: the packages that cpack makes of a build, by what stands in them."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop()).resolve()


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


class Contents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="trivela-packages-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        # Quick to compress; what is in them is the same.
        made = subprocess.run(["cpack", "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=none"],
                              capture_output=True, text=True, cwd=BUILD)
        assert made.returncode == 0, made.stdout + made.stderr
        cls.debs = {re.match(r"trivela-([a-z]+)_|(?P<python>python3)-trivela_", deb.name): deb for deb in cls.folder.glob("*.deb")}
        cls.debs = {match["python"] or match[1]: deb for match, deb in cls.debs.items()}
        cls.has_python = (BUILD / "python/trivela").exists()  # where pybind11 is
        cls.files = {name: cls.list(deb) for name, deb in cls.debs.items()}

    @staticmethod
    def list(deb):
        lines = [line.split(maxsplit=5) for line in output("dpkg-deb", "-c", deb).splitlines()]
        return {line[5][1:].split(" -> ")[0]: line[0] for line in lines if not line[0].startswith("d")}

    def field(self, name, field):
        return output("dpkg-deb", "-f", self.debs[name], field).strip()

    def test_each_has_what_it_is_for_and_nothing_stands_twice(self):
        self.assertEqual(set(self.debs), {"robot", "base", "dev"} | ({"python3"} if self.has_python else set()))
        nodes = {f"/usr/bin/trivela-{path.parent.name}" for path in (ROOT / "nodes").glob("*/*_node.cpp")}
        nodes.add("/usr/bin/trivela-kick_decision_second")  # the same node in another role
        shipped = {f"/etc/trivela/{path.relative_to(ROOT / 'config')}" for ending in ("toml", "xml", "csv", "nft")
                   for path in (ROOT / "config").rglob(f"*.{ending}")}
        units = {"/usr/lib/systemd/system/trivela@.service", "/usr/lib/systemd/system/trivela.target",
                 "/usr/lib/systemd/system/trivela.target.d/team.conf", "/usr/lib/udev/rules.d/60-trivela.rules"}
        self.assertEqual(set(self.files["robot"]), nodes | shipped | units | {
            "/usr/bin/trivela-launch", "/etc/trivela/robot.env", "/usr/share/man/man8/trivela-nodes.8.gz"})
        self.assertEqual(set(self.files["base"]), {
            "/usr/bin/trivela", "/usr/bin/trivela-emulate", "/usr/share/man/man1/trivela.1.gz", "/usr/share/bash-completion/completions/trivela",
            "/usr/lib/systemd/system/trivela-monitor.service",
            "/usr/share/zsh/vendor-completions/_trivela", "/usr/share/fish/vendor_completions.d/trivela.fish"})
        dev = self.files["dev"]
        for file in ("lib/libtrivela_kicking.a", "lib/cmake/trivela/trivelaConfig.cmake", "include/trivela/kicking.hpp",
                     "include/trivela/idl/kick.idl", "include/trivela/idl/kick.h"):
            self.assertIn(f"/usr/{file}", dev)
        self.assertFalse([file for file in dev if not file.startswith(("/usr/include/trivela/", "/usr/lib/"))])
        if self.has_python:
            folder, module = "/usr/lib/python3/dist-packages/trivela", r"_trivela\.cpython-\d+-[\w-]+\.so"
            sources = {f"{folder}/{path.name}" for path in (ROOT / "python/trivela").iterdir() if path.suffix in (".py", ".pyi", ".typed")}
            modules = {file for file in self.files["python3"] if re.fullmatch(f"{folder}/{module}", file)}
            self.assertEqual(len(modules), 1)
            self.assertEqual(set(self.files["python3"]), sources | modules)
        everything = [file for files in self.files.values() for file in files]
        self.assertEqual(len(everything), len(set(everything)))

    def test_edits_of_the_configuration_survive(self):
        kept = output("dpkg-deb", "-I", self.debs["robot"], "conffiles").split()
        self.assertEqual(set(kept), {file for file in self.files["robot"] if file.startswith("/etc/")})

    def test_rights_and_owners_are_debians(self):
        for files in self.files.values():
            for file, rights in files.items():
                meant = "lrwxrwxrwx" if file.endswith("/team.conf") else "-rwxr-xr-x" if file.startswith("/usr/bin/") else "-rw-r--r--"
                self.assertEqual(rights, meant, file)
        self.assertNotIn("Permission", output("dpkg-deb", "-I", self.debs["robot"]))

    def test_versions_and_dependencies(self):
        version = re.search(r"project\(trivela VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
        for name in self.debs:
            self.assertEqual(self.field(name, "Version"), version)
        for library in ("libddsc", "libc6", "libspdlog", "libsqlitecpp|libsqlite3"):
            self.assertRegex(self.field("robot", "Depends"), library)
        self.assertIn(f"trivela-robot (= {version})", self.field("base", "Depends"))
        self.assertRegex(self.field("base", "Depends"), "libcpp-httplib")
        self.assertIn("libeigen3-dev", self.field("dev", "Depends"))
        if self.has_python:
            for needed in (f"trivela-base (= {version})", "python3-numpy", "python3-pandas", "libsqlitecpp|libsqlite3"):
                self.assertRegex(self.field("python3", "Depends"), needed.replace("(", r"\(").replace(")", r"\)"))

    def test_the_installed_module_finds_the_installed_configuration(self):
        if not self.has_python:
            self.skipTest("the build has no Python module")
        root = self.folder / "python"
        for name in ("robot", "python3"):
            subprocess.run(["dpkg-deb", "-x", self.debs[name], root], check=True)
        modules = root / "usr/lib/python3/dist-packages"
        said = subprocess.run(["/usr/bin/python3", "-B", "-c", "import trivela; print(trivela.__file__, trivela.solve(4, 0.5, 0.6).v0_mps)"],
                              capture_output=True, text=True, env={"PYTHONPATH": str(modules)})
        self.assertIn(f"{modules}/trivela/__init__.py 7.", said.stdout + said.stderr)

    def test_units_say_what_the_documents_promise(self):
        unit = (ROOT / "packaging/trivela@.service").read_text()
        for line in ("Type=notify", "WatchdogSec=2", "Restart=always", "LimitRTPRIO=99", "NoNewPrivileges=yes", "ProtectSystem=strict"):
            self.assertIn(f"\n{line}\n", unit)
        if not shutil.which("systemd-analyze"):
            return
        said = self.verified(self.unpacked("root"), "trivela@odometry.service")
        self.assertFalse([line for line in said.splitlines() if "trivela@" in line and re.search("Unknown|Failed to parse|ignoring", line)], said)

    def unpacked(self, name):
        """A root with the robot's package and an instance of each node's unit."""
        root = self.folder / name
        subprocess.run(["dpkg-deb", "-x", self.debs["robot"], root], check=True)
        for program in root.glob("usr/bin/trivela-*"):
            (root / f"usr/lib/systemd/system/trivela@{program.name.removeprefix('trivela-')}.service").symlink_to("trivela@.service")
        return root

    @staticmethod
    def verified(root, unit):
        return subprocess.run(["systemd-analyze", "verify", f"--root={root}", "--man=no", unit], capture_output=True, text=True).stderr

    def test_the_target_starts_what_team_configure_wrote(self):
        root = self.unpacked("configured")
        link = root / "usr/lib/systemd/system/trivela.target.d/team.conf"
        self.assertFalse(link.exists(), "before the team was described it leads nowhere")
        before = self.verified(root, "trivela.target") if shutil.which("systemd-analyze") else ""
        self.assertNotIn("team.conf", before)
        for which in (["--robot", "1"], ["--base"]):
            out = root / "etc/trivela/team"
            subprocess.run([BUILD / "trivela", "team", "configure", root / "etc/trivela/teams/example.toml", *which, "--out", out, "--force"],
                           check=True, capture_output=True)
            nodes = re.search(r'^TRIVELA_NODES="(.*)"$', (out / "robot.env").read_text(), re.M)[1].split()
            wanted = re.findall(r"^Wants=(.*)$", link.read_text(), re.M)
            self.assertEqual(wanted, [f"trivela@{node}.service" for node in nodes])
            for unit in wanted:
                self.assertTrue((root / "usr/lib/systemd/system" / unit).exists(), unit)
        if not shutil.which("systemd-analyze"):
            return
        self.assertNotIn("team.conf", self.verified(root, "trivela.target"))
        # That systemd reads it through the link: what it does not know in it, it says.
        (out / "trivela.target.conf").write_text("[Unit]\nNoSuchKey=1\n")
        self.assertIn("team.conf:2", self.verified(root, "trivela.target"))


if __name__ == "__main__":
    sys.exit(unittest.main())
