"""The machine code of a kernel on disk may be damaged, or have no room: the kernel is compiled anew, and right."""

import json
import os
import subprocess
import sys
import textwrap
from importlib.util import find_spec

import pytest

pytestmark = pytest.mark.skipif(find_spec("numba") is None, reason="Numba is not installed")

KERNEL = """
from robotics1.kernels.compilation import compiled

def twice(x):
    return 2.0 * x
"""

# One process damages its own files, each time as another process would find them: a new dispatcher has only the files.
CHILD = """
import json, os, pickle, shutil, sys
from pathlib import Path
import numpy as np
from small_kernel import compiled, twice

folder = Path(os.environ["NUMBA_CACHE_DIR"])

def call():
    kernel = compiled()(twice)
    value = kernel(21.0)
    return value, sum(kernel.stats.cache_hits.values())

call()
index, data = next(folder.rglob("*.nbi")), next(folder.rglob("*.nbc"))
good = {index: index.read_bytes(), data: data.read_bytes()}

def flipped(old):
    new = bytearray(old)
    for i in range(len(new) // 3, len(new), 97):
        new[i] ^= 0x55
    return bytes(new)

damages = {
    "empty": lambda old: b"",
    "truncated": lambda old: old[: len(old) // 2],
    "one byte short": lambda old: old[:-1],
    "longer": lambda old: old + b"x",
    "zeros": lambda old: bytes(len(old)),
    "random": lambda old: np.random.default_rng(0).bytes(len(old)),
    "flipped bits": flipped,
    "another pickle": lambda old: pickle.dumps({"a": 1}),
    "a pickle of None": lambda old: pickle.dumps(None),
    "a pickle of a missing class": lambda old: b"cno_such_module\\nThing\\n.",
    "text": lambda old: b"<html>quota exceeded</html>",
}
answers = {"sound": call()}
for name, damage in damages.items():
    for file in good:
        for other, content in good.items():
            other.write_bytes(content)
        file.write_bytes(damage(good[file]))
        answers[f"{name} {file.suffix}"] = [*call(), *call()]
for file in good:
    for other, content in good.items():
        other.write_bytes(content)
    file.unlink()
    file.mkdir()
    answers[f"folder {file.suffix}"] = call()
    file.rmdir()
print(json.dumps(answers))
"""


@pytest.fixture
def run(tmp_path):
    """Run a script beside the kernel, with an empty cache folder in tmp_path, and return what it prints as JSON."""
    (tmp_path / "small_kernel.py").write_text(KERNEL)

    def run(script, cache=None):
        paths = os.pathsep.join([str(tmp_path), *sys.path])
        environment = os.environ | {"NUMBA_CACHE_DIR": str(cache or tmp_path / "cache"), "PYTHONPATH": paths}
        done = subprocess.run(
            [sys.executable, "-c", textwrap.dedent(script)],
            check=False,
            env=environment,
            capture_output=True,
            text=True,
            timeout=300,
        )
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return run


def test_a_damaged_cache_compiles_anew_and_is_replaced(run):
    answers = run(CHILD)
    assert answers.pop("sound") == [42.0, 1]
    folders = {name: answers.pop(name) for name in list(answers) if name.startswith("folder")}
    assert {name: value for name, (value, _) in folders.items()} == {"folder .nbi": 42.0, "folder .nbc": 42.0}
    assert len(answers) == 22
    for name, (value, found, again, found_again) in answers.items():
        assert value == 42.0, name
        assert found == 0 or name == "longer .nbi", name  # a pickle ends where it ends
        assert (again, found_again) == (42.0, 1), name


def test_a_full_disk_compiles_and_keeps_what_fits(run, tmp_path):
    script = """
        import json, os, resource, signal
        from pathlib import Path
        from small_kernel import compiled, twice
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        answers = []
        for most in (10, 5000, 10**9):  # the index has some 2000 bytes, machine code 8000
            resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))
            value = compiled()(twice)(21.0)
            files = [file.suffix for file in Path(os.environ["NUMBA_CACHE_DIR"]).rglob("*") if file.is_file()]
            answers.append([value, sorted(files)])
        print(json.dumps(answers))
    """
    assert run(script) == [[42.0, []], [42.0, [".nbi"]], [42.0, [".nbc", ".nbi"]]]  # the index is written first


def test_a_file_in_the_place_of_the_cache_folder_is_no_hindrance(run, tmp_path):
    (tmp_path / "file").write_text("not a folder")
    script = "import json; from small_kernel import compiled, twice; print(json.dumps(compiled()(twice)(21.0)))"
    assert run(script, cache=tmp_path / "file" / "cache") == 42.0


def test_machine_code_of_other_sources_is_not_run(run):
    """After a full disk the index may be of the new sources and the data file of the old ones."""
    script = """
        import json
        from robotics1.kernels import machine_code
        from small_kernel import compiled, twice
        compiled()(twice)(21.0)
        machine_code._sources = lambda: (("another.py", 1.0, 1),)
        kernel = compiled()(twice)
        data = next(__import__("pathlib").Path(kernel._cache.cache_path).glob("*.nbc"))
        old = data.read_bytes()
        kernel(21.0)
        data.write_bytes(old)
        kernel = compiled()(twice)
        print(json.dumps([kernel(21.0), sum(kernel.stats.cache_hits.values())]))
    """
    assert run(script) == [42.0, 0]
