"""The one writer of files: whole or not at all, and only where it was asked for."""

import errno
import os
import stat
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from unittest import mock

import pytest

import robotics1 as r1
from robotics1.files import write_file
from robotics1.names import file_stem

ROWS = [("R", 1.0, 0.0, 0.0, 0.0)]
posix = pytest.mark.skipif(os.name == "nt", reason="modes and links are POSIX's")


@cache
def circle():
    return r1.curves.formula_path(["cos(s)", "sin(s)"], "s", 1.0)


WRITERS = {
    "write_file": lambda path: write_file(path, "new"),
    "dh_to_urdf": lambda path: r1.dh.dh_to_urdf(ROWS, path),
    "view": lambda path: r1.view(r1.load_robot("planar_2r"), [0, 0], path).file,
    "plot_path": lambda path: (r1.plot_path(circle(), file=path), path)[1],
}


@pytest.fixture(params=WRITERS)
def write(request):
    """Each public function that writes one file."""
    return WRITERS[request.param]


def left_over(folder):
    """The names of what is in a folder, without the old file."""
    return sorted(entry.name for entry in folder.iterdir() if entry.name != "old")


@posix
def test_an_existing_file_keeps_its_mode(write, tmp_path):
    path = tmp_path / "old"
    path.write_text("old")
    path.chmod(0o640)
    assert write(path) == path
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert path.read_text(encoding="utf-8") != "old"
    assert left_over(tmp_path) == []


@posix
@pytest.mark.parametrize(("mask", "mode"), [(0o022, 0o644), (0o077, 0o600), (0o002, 0o664)])
def test_a_new_file_has_the_mode_of_the_umask(mask, mode, tmp_path):
    before = os.umask(mask)
    try:
        write_file(tmp_path / "new", b"x")
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == mode


@posix
def test_a_symbolic_link_stays_and_its_target_is_replaced(write, tmp_path):
    (tmp_path / "elsewhere").mkdir()
    target, link = tmp_path / "elsewhere" / "target", tmp_path / "old"
    target.write_text("old")
    link.symlink_to(target)
    write(link)
    assert link.is_symlink()
    assert target.read_text(encoding="utf-8") != "old"
    assert left_over(tmp_path) == ["elsewhere"]
    assert [entry.name for entry in target.parent.iterdir()] == ["target"]


@posix
def test_a_link_to_a_file_that_is_not_there_yet_makes_that_file(tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "target")
    write_file(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "target").read_text() == "new"


@posix
def test_what_is_no_regular_file_is_refused_and_stays_what_it_is(write, tmp_path):
    pipe, loop = tmp_path / "pipe", tmp_path / "loop"
    os.mkfifo(pipe)
    loop.symlink_to(loop)
    (tmp_path / "to_pipe").symlink_to(pipe)
    (tmp_path / "folder").mkdir()
    for name in ("pipe", "to_pipe", "loop", "folder"):
        with pytest.raises(r1.InputError, match="cannot be written: "):
            write(tmp_path / name)
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert loop.is_symlink()
    assert left_over(tmp_path) == ["folder", "loop", "pipe", "to_pipe"]


@pytest.mark.parametrize(
    "name", ["nowhere/page", "page\0.html", "", ".", "x" * 300, None, 5, "old/page"], ids=lambda name: str(name)[:8]
)
def test_a_path_that_names_no_file_is_an_input_error(write, name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "old").write_text("old")
    if name is None and write in (WRITERS["plot_path"], WRITERS["view"]):
        return  # a plot or a page without a file
    with pytest.raises(r1.InputError):
        write(name)
    assert left_over(tmp_path) == []


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EROFS])
@pytest.mark.parametrize("place", ["open", "write", "replace"])
def test_a_full_disk_is_an_input_error_and_leaves_the_old_file_alone(code, place, write, tmp_path, monkeypatch):
    (tmp_path / "old").write_text("old")
    fail_at(place, OSError(code, os.strerror(code)), monkeypatch)
    with pytest.raises(r1.InputError, match=os.strerror(code)):
        write(tmp_path / "old")
    with pytest.raises(r1.InputError, match=os.strerror(code)):
        write(tmp_path / "new")
    monkeypatch.undo()
    assert left_over(tmp_path) == []
    assert (tmp_path / "old").read_text() == "old"


def fail_at(place, error, monkeypatch):
    """Let one step of the writer fail."""
    real = open

    def failing(*_, **__):
        raise error

    def half_written(path, mode):
        with real(path, mode) as file:
            file.write(b"half")
        file = mock.MagicMock()
        file.__enter__.return_value.write.side_effect = error
        file.__exit__.return_value = False
        return file

    if place == "replace":
        monkeypatch.setattr("pathlib.Path.replace", failing)
    else:
        monkeypatch.setattr("robotics1.files.open", failing if place == "open" else half_written, raising=False)


@posix
def test_a_limit_of_the_size_of_files_leaves_no_rest(tmp_path):
    """A real limit, in a child: the kernel refuses the bytes beyond 1000."""
    script = (
        "import resource, signal, sys\n"
        "from robotics1 import InputError\n"
        "from robotics1.files import write_file\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))\n"
        "try:\n    write_file(sys.argv[1], b'x' * 5000)\n"
        "except InputError as error:\n    print(error)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, str(tmp_path / "new")],
        check=False,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert "cannot be written: File too large" in done.stdout
    assert left_over(tmp_path) == []


@posix
@pytest.mark.skipif(hasattr(os, "geteuid") and os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_or_file_that_must_not_be_written_is_an_input_error(write, tmp_path):
    (tmp_path / "old").write_text("old")
    (tmp_path / "old").chmod(0o444)
    with pytest.raises(r1.InputError, match="its mode does not allow it"):
        write(tmp_path / "old")
    tmp_path.chmod(0o555)
    try:
        with pytest.raises(r1.InputError, match="Permission denied"):
            write(tmp_path / "new")
    finally:
        tmp_path.chmod(0o755)


def test_a_file_whose_mode_forbids_writing_is_an_input_error(write, tmp_path, monkeypatch):
    (tmp_path / "old").write_text("old")
    monkeypatch.setattr("os.access", lambda *_: False)
    with pytest.raises(r1.InputError, match="its mode does not allow it"):
        write(tmp_path / "old")
    assert (tmp_path / "old").read_text() == "old"


def test_the_unfinished_file_has_a_name_that_nobody_can_foresee(tmp_path, monkeypatch):
    seen = []
    real = open
    monkeypatch.setattr(
        "robotics1.files.open", lambda path, mode: seen.append((path.name, mode)) or real(path, mode), raising=False
    )
    write_file(tmp_path / "page.html", "1")
    write_file(tmp_path / "page.html", "2")
    (first, mode), (second, _) = seen
    assert mode == "xb"
    assert first != second
    assert len(first) >= 20


def test_writers_of_one_page_all_succeed_and_one_wins_whole(tmp_path):
    path = tmp_path / "page"
    pages = [bytes([65 + i]) * 200_000 for i in range(8)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda page: [write_file(path, page) for _ in range(20)], pages))
    assert path.read_bytes() in pages
    assert left_over(tmp_path) == ["page"]


def test_processes_that_write_one_page_all_succeed(tmp_path):
    script = "import sys; from robotics1.files import write_file\nfor _ in range(50): write_file(*sys.argv[1:])"
    words = [[sys.executable, "-c", script, str(tmp_path / "page"), letter * 1000] for letter in "abc"]
    running = [subprocess.Popen(word) for word in words]
    assert [process.wait(timeout=60) for process in running] == [0, 0, 0]
    assert (tmp_path / "page").read_text() in [letter * 1000 for letter in "abc"]
    assert left_over(tmp_path) == ["page"]


@pytest.mark.parametrize(
    ("name", "stem"),
    [
        ("ur5", "ur5"),
        ("../../../x", "x"),
        ("/etc/passwd", "etc_passwd"),
        (r"C:\users\arm", "C_users_arm"),
        ("a/b", "a_b"),
        (".hidden", "hidden"),
        ("..", "robot"),
        ("", "robot"),
        ("-rf", "rf"),
        ("x\0y\nz", "x_y_z"),
        ("Körper", "Korper"),
        ("机器人", "robot"),
        ("\u202egnp.exe", "gnp_exe"),
        ("a" * 500, "a" * 100),
    ],
)
def test_a_file_is_named_by_the_letters_and_digits_of_a_robots_name(name, stem):
    assert file_stem(name) == stem
