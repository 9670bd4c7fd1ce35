"""The types that the module promises are those that it has."""
import importlib.util
import os
import subprocess
import sys

import pytest

from conftest import BUILD, ROOT

if importlib.util.find_spec("mypy") is None:
    pytest.skip("it needs mypy of packages.txt", allow_module_level=True)


def checked(*words, folder=ROOT):
    return subprocess.run([sys.executable, "-m", *words], capture_output=True, text=True, cwd=folder,
                          env={**os.environ, "MYPYPATH": str(BUILD / "python")})


def test_the_stub_is_that_of_the_module(tmp_path):
    (tmp_path / "mypy.ini").write_text("[mypy]\nignore_missing_imports = True\n")
    (tmp_path / "metaclasses").write_text(r"trivela\._trivela\.(Asked|ComparisonQuestion|Cycle|Flight|Goal|Output|Robot|Cycle\.__init__)" + "\n")  # pybind11's own
    done = checked("mypy.stubtest", "trivela._trivela", "--allowlist", str(tmp_path / "metaclasses"), "--mypy-config-file", str(tmp_path / "mypy.ini"), folder=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_sources_keep_their_own_types(tmp_path):
    done = checked("mypy", "--strict", "--ignore-missing-imports", "--cache-dir", str(tmp_path), str(BUILD / "python/trivela"))
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_wrong_type_of_a_user_is_found(tmp_path):
    (tmp_path / "mine.py").write_text('import trivela\nrows = trivela.simulate("moving", matches="many")\nrows.arm\ntrivela.Log("a.db").kicks().head()\n')
    done = checked("mypy", "--ignore-missing-imports", "--cache-dir", str(tmp_path), str(tmp_path / "mine.py"))
    assert "mine.py:2: error" in done.stdout and done.stdout.count("error:") == 1, done.stdout


def test_everything_public_is_explained():
    import trivela

    for name in trivela.__all__:
        if name not in ("OUTCOMES", "__version__"):
            assert len(getattr(trivela, name).__doc__.split()) > 5, name
    for name in trivela.stats.__all__:
        assert len(getattr(trivela.stats, name).__doc__.split()) > 5, name
