"""The commands print names from a file as text, on every terminal, and end with the right exit code."""

import json
import os
import signal
import subprocess
import sys

import pytest
from command import run
from hostile_names import NAMES, arm_file

EVERYTHING = "".join(name for name in NAMES.values() if len(name) < 200)
QUICK = {
    "check": ["check"],
    "fk": ["fk", "--q", "1,2"],
    "jacobian": ["jacobian", "--task", "position:xy"],
    "jacobian beyond the limits": ["jacobian", "--task", "position:xy", "--q", "4,4"],
    "manipulability": ["manipulability", "--along", "1,2"],
    "statics": ["statics", "--force", "1,2", "--task", "position:xy"],
}
SLOW = {
    "symbolic": ["jacobian", "--task", "position:xy", "--symbolic"],
    "symbolic minors": ["jacobian", "--task", "position:x", "--symbolic"],
    "latex": ["jacobian", "--task", "position:xy", "--latex"],
    "python": ["jacobian", "--task", "position:xy", "--python"],
    "singularities": ["singularities", "--task", "position:xy"],
    "singularities python": ["singularities", "--task", "position:xy", "--python"],
    "all solutions": ["ik", "--task", "position:xy", "--target", "0.5,0.5"],
    "solve": ["ik", "--task", "position:xy", "--target", "0.5,0.5", "--method", "solve"],
    "newton": ["ik", "--task", "position:xy", "--target", "0.5,0.5", "--method", "newton", "--q0", "6.5,1.2"],
    "scan": ["scan", "--task", "position:xy", "--samples", "1000", "--refine", "1"],
    "view": ["view"],
}


def is_harmless(text):
    """No character moves a cursor, changes a colour, or turns the direction of the text."""
    return text.replace("\n", "").isprintable()


def spelled(text):
    """Control and format characters as escapes, without blanks."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text if c != " ")


@pytest.mark.parametrize("name", NAMES.values(), ids=NAMES)
def test_names_of_a_file_are_printed_as_text(name, tmp_path):
    path = arm_file(tmp_path, name)
    for command, *words in QUICK.values():
        code, out, err = run(command, path, *words)
        assert (code, err) == (0, ""), (command, err)
        assert is_harmless(out)
        assert "\nerror: all is well" not in out
    assert spelled("q1 " + name)[:20] in "".join(out.split())


@pytest.mark.parametrize("words", SLOW.values(), ids=SLOW)
def test_names_with_everything_in_them_are_printed_as_text(words, tmp_path, monkeypatch):
    folder = tmp_path / "here"
    folder.mkdir()
    monkeypatch.chdir(folder)
    command, *options = words
    code, out, err = run(command, arm_file(tmp_path, EVERYTHING), *options)
    assert code == 0, err
    assert is_harmless(out)
    assert is_harmless(err)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["arm.urdf", "here"]
    assert len(list(folder.iterdir())) == (command == "view")


@pytest.mark.parametrize("words", [*QUICK.values(), SLOW["symbolic minors"]], ids=lambda words: words[0])
def test_json_holds_the_names_as_they_are(words, tmp_path):
    command, *options = words
    code, out, _ = run(command, arm_file(tmp_path, EVERYTHING), *options, "--json")
    assert code == 0
    assert is_harmless(out)
    answer = json.loads(out)
    if command == "check":
        assert (answer["name"], answer["tool"]) == (EVERYTHING, "tool" + EVERYTHING)
        assert answer["joints"] == ["q1 " + EVERYTHING, "q2 " + EVERYTHING]


@pytest.mark.parametrize("name", ["[/x]", "a\x9b31m", "\u202egnp", "x\nerror: y"])
def test_an_error_is_one_line_whatever_it_names(name, tmp_path):
    for words in (
        ["fk", "prr", "--frame", name],
        ["fk", name],
        ["fk", tmp_path / name],
        ["fk", "prr", "-p", f"{name}=1"],
        ["check", arm_file(tmp_path, name), "--tool", name],
        ["view", "prr", "--out", tmp_path / name / "page.html"],
    ):
        code, out, err = run(*words)
        assert (code, out) == (2, ""), words
        assert err.startswith("error: ")
        assert err.count("\n") == 1
        assert is_harmless(err)


def test_findings_of_a_check_are_lines_of_text(tmp_path):
    path = tmp_path / "bad.urdf"
    path.write_text(
        '<robot name="r"><link name="a[/x]&#10;error: y"/><link name="b&#x202e;"/>'
        '<joint name="j&#x9b;31m[bold]" type="revolute"><parent link="a[/x]&#10;error: y"/></joint></robot>'
    )
    code, out, err = run("check", path)
    assert (code, err) == (1, "")
    assert is_harmless(out)
    assert r"j\x9b31m[bold]" in out
    assert "\nerror: y" not in out


def test_a_view_without_out_is_written_in_the_working_directory(tmp_path, monkeypatch):
    folder = tmp_path / "a" / "b"
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    for name, page in (("../../../x", "x"), ("/etc/x", "etc_x"), ("..", "robot"), ("ur5", "ur5")):
        code, out, _ = run("view", arm_file(tmp_path, name))
        assert (code, out) == (0, f"wrote {page}.html\n")
        assert (folder / f"{page}.html").is_file()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "arm.urdf"]
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["b"]


@pytest.mark.parametrize("words", [["view", "prr", "--out"], ["exam", "--out"]], ids=lambda words: words[0])
def test_what_cannot_be_written_is_one_line_and_exit_code_2(words, tmp_path, monkeypatch):
    (tmp_path / "file").write_text("a file")
    place = tmp_path
    if words[0] == "exam":  # its exercises take seconds, and are not what is tried here
        monkeypatch.setattr("exams.from_file.worked.answered", lambda _: pytest.fail("solved in vain"))
    code, out, err = run(*words, place)
    assert (code, out) == (2, "")
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@pytest.mark.parametrize(
    "error", [RuntimeError("a\nb [/x]"), OSError(28, "No space left on device"), MemoryError(), RecursionError("deep")]
)
def test_what_goes_wrong_inside_is_one_line_and_exit_code_2(error, monkeypatch):
    def fails(*_, **__):
        raise error

    monkeypatch.setattr("robotics1.kinematics.forward_kinematics", fails)
    code, out, err = run("fk", "prr")
    assert (code, out) == (2, "")
    assert err.startswith("error")
    assert err.count("\n") == 1
    assert "Traceback" not in err


def test_an_interrupt_is_one_line_and_exit_code_130(monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("robotics1.kinematics.forward_kinematics", interrupted)
    assert run("fk", "prr") == (130, "", "interrupted\n")


def command(*words, encoding=None, **options):
    """A process of the command."""
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path), "COLUMNS": "200"}
    if encoding:
        environment |= {"PYTHONIOENCODING": encoding}
    line = [sys.executable, "-c", "from robotics1.cli import main; main()", *map(str, words)]
    return subprocess.Popen(line, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)


@pytest.mark.parametrize("encoding", ["ascii", "latin-1", "cp1252", "utf-8"])
def test_characters_that_a_terminal_does_not_know_are_spelled_out(encoding, tmp_path):
    """The same sentences in each encoding; the exit code is that of the verdict."""
    words = ["statics", arm_file(tmp_path, "机"), "--force", "0,0", "--task", "position:xy", "--q", "0,0"]
    out, err = command(*words, encoding=encoding).communicate(timeout=120)
    text = out.decode(encoding)
    assert err == b""
    known = {"ascii": "tau = -J^T f", "latin-1": "tau = -J^T f", "cp1252": "tau = -J^T f", "utf-8": "τ = −Jᵀ f"}
    assert text.startswith(known[encoding])
    assert ("机" if encoding == "utf-8" else r"\u673a") in text


def test_a_formula_on_an_ascii_terminal_has_brackets_and_numbers():
    words = ["jacobian", "prr", "--task", "position:xy", "--symbolic"]
    process = command(*words, encoding="ascii")
    out, err = process.communicate(timeout=120)
    assert (process.returncode, err) == (0, b"")
    assert b"l_2*sin(q_2)" in out
    assert b"\\u" not in out


def test_json_is_json_in_every_encoding(tmp_path):
    process = command("check", arm_file(tmp_path, "机π"), "--json", encoding="ascii")
    out, _ = process.communicate(timeout=120)
    assert process.returncode == 0
    assert json.loads(out)["name"] == "机π"


@pytest.mark.skipif(os.name == "nt", reason="pipes of POSIX")
def test_a_reader_that_goes_away_ends_the_command_quietly():
    """As for `robotics1 jacobian ... | head -1`: the signal SIGPIPE, which a shell shows as 141."""
    for words in (["jacobian", "prr"], ["jacobian", "prr", "--json"]):
        read, write = os.pipe()
        os.close(read)
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
        line = [sys.executable, "-c", "from robotics1.cli import main; main()", *words]
        done = subprocess.run(line, check=False, env=environment, stdout=write, stderr=subprocess.PIPE, timeout=120)
        os.close(write)
        assert (done.returncode, done.stderr) == (-signal.SIGPIPE, b"")


@pytest.mark.skipif(os.name == "nt", reason="limits of POSIX")
def test_a_full_disk_below_stdout_is_one_line_and_exit_code_2(tmp_path):
    script = (
        "import resource, signal; signal.signal(signal.SIGXFSZ, signal.SIG_IGN); "
        "from robotics1.cli import main; resource.setrlimit(resource.RLIMIT_FSIZE, (10, 10)); main()"
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    with open(tmp_path / "out", "wb") as out:
        line = [sys.executable, "-c", script, "jacobian", "prr"]
        done = subprocess.run(line, check=False, env=environment, stdout=out, stderr=subprocess.PIPE, timeout=120)
    assert done.returncode == 2
    assert done.stderr.startswith(b"error: ")
    assert done.stderr.count(b"\n") == 1


def test_the_signal_for_closed_pipes_is_as_before_after_a_command():
    before = signal.getsignal(signal.SIGPIPE)
    run("fk", "prr")
    assert signal.getsignal(signal.SIGPIPE) is before


def test_a_junk_mesh_is_named_on_stderr_and_the_rest_is_drawn(tmp_path):
    (tmp_path / "junk[1].stl").write_bytes(b"\x00" * 40)
    (tmp_path / "arm.urdf").write_text(
        '<robot name="r"><link name="base"><visual><geometry><mesh filename="junk[1].stl"/></geometry></visual></link>'
        '<link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>'
        '<joint name="q1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>'
        '<limit lower="-3" upper="3" velocity="1" effort="1"/>'
        "</joint></robot>"
    )
    code, out, err = run("view", tmp_path / "arm.urdf", "--out", tmp_path / "page.html")
    assert code == 0
    assert out == f"wrote {tmp_path / 'page.html'}\n"
    assert err.startswith("warning: ")
    assert "so it is not drawn" in err
    assert err.count("\n") == 1
