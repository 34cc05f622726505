"""The command `robotics1 view`: a file, a recorded motion, or an address of this computer."""

import http.client
import re
import signal
import subprocess
import sys

import pytest
from command import run

SERVE = """
import signal, sys
from robotics1.cli import main
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell lets its background processes ignore Ctrl-C
sys.argv = ["robotics1", "view", "planar_2r", "--serve"]
main()
"""


@pytest.mark.parametrize(
    "text",
    ["t,q2,q1\n0,1,0.5\n1,2,0.25\n", "0,0.5,1\n1,0.25,2\n", "\ufefftime, q1 ,other,q2\n0,0.5,x,1\n1,0.25,,2\n\n"],
    ids=["by name", "in order", "more columns"],
)
def test_a_recorded_motion_is_written_as_a_page(text, tmp_path):
    (tmp_path / "motion.csv").write_text(text, encoding="utf-8")
    result = run("view", "planar_2r", "--trajectory", tmp_path / "motion.csv", "--out", tmp_path / "page.html")
    assert result.code == 0, result.stderr
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert '"q":[0.5,1.0]' in page
    assert "motion.csv" in page


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "has no rows"),
        ("t,q1\n0,1\n1,2\n", "no column 'q2'"),
        ("q1,q2\n0,1\n", "no column t"),
        ("0,1\n1,2\n", "row 1 of the table must be 3 numbers"),
        ("t,q1,q2\n0,0,0\n1,x,0\n", "row 2 of the table must be 3 numbers"),
        ("0,0,0\n0,1,1\n", "instants that grow"),
        ("0,0,0\n1,nan,1\n", "finite"),
        ("0,0,0\n", "two or more instants"),
        ("\x00\xff", "no column t"),
    ],
)
def test_a_table_that_is_no_motion_is_refused_in_one_line(text, sentence, tmp_path):
    (tmp_path / "motion.csv").write_text(text, encoding="utf-8")
    result = run("view", "planar_2r", "--trajectory", tmp_path / "motion.csv", "--out", tmp_path / "page.html")
    assert sentence in result.refusal
    assert not (tmp_path / "page.html").exists()


def test_q_and_a_recorded_motion_exclude_each_other(tmp_path):
    (tmp_path / "motion.csv").write_text("0,0,0\n1,1,1\n")
    result = run("view", "planar_2r", "--q", "0,0", "--trajectory", tmp_path / "motion.csv")
    assert "not both" in result.refusal


def ask(line):
    """What the server that says this line answers: (path, host) → status, and whether it is the page."""
    port = int(re.fullmatch(r"http://127\.0\.0\.1:(\d+)/  \(Ctrl-C ends it\)\n", line)[1])
    asked = {}
    for path, host in (("/", f"127.0.0.1:{port}"), ("/", "evil.example"), ("/etc/passwd", f"localhost:{port}")):
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=20)
        connection.request("GET", path, headers={"Host": host})
        response = connection.getresponse()
        asked[path, host.partition(":")[0]] = (response.status, b"planar_2r" in response.read())
        connection.close()
    return asked


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM])
def test_a_served_page_is_for_this_computer_only_and_ends_on_a_signal(end, tmp_path):
    command = [sys.executable, "-c", SERVE]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=tmp_path) as served:
        try:
            asked = ask(served.stdout.readline())
            served.send_signal(end)
            rest, _ = served.communicate(timeout=60)
        finally:
            served.kill()
    assert asked == {
        ("/", "127.0.0.1"): (200, True),
        ("/", "evil.example"): (421, False),
        ("/etc/passwd", "localhost"): (404, False),
    }
    assert (served.returncode, rest) == (0, "")
    assert list(tmp_path.iterdir()) == []
