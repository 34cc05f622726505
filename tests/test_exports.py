"""What leaves the package: motions as arrays, CSV, pandas and ROS's message; formulas in C, MATLAB and LaTeX."""

import csv
import ctypes
import io
import json
import re
import shutil
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from arms import arm
from command import run
from pages import data_behind

import robotics1 as r1

CUBIC = r1.cubic([0, 1], [1, 3], 0.25)
COMPILER = shutil.which("cc")


# --- samples


def test_samples_are_the_motion_at_equal_steps_and_at_its_end():
    found = CUBIC.sample(10)
    assert found.t == pytest.approx([0, 0.1, 0.2, 0.25])
    tau = found.t / 0.25
    s, ds, dds = 3 * tau**2 - 2 * tau**3, (6 * tau - 6 * tau**2) / 0.25, (6 - 12 * tau) / 0.25**2
    assert found.q == pytest.approx(np.column_stack([s, 1 + 2 * s]))
    assert found.velocity == pytest.approx(np.column_stack([ds, 2 * ds]))
    assert found.acceleration == pytest.approx(np.column_stack([dds, 2 * dds]))
    assert len(found) == 4


@pytest.mark.parametrize(("rate", "count"), [(4, 2), (8, 3), (40, 11), (3, 2), (1, 2), (1000, 251)])
def test_the_end_is_there_once(rate, count):
    t = CUBIC.sample(rate).t
    assert len(t) == count
    assert t[-1] == 0.25
    assert (np.diff(t) > 1e-9).all()


def test_csv_has_every_digit_and_the_joints_names(tmp_path):
    samples = CUBIC.sample(100, names=("shoulder", "elbow"))
    text = samples.csv(tmp_path / "motion.csv")
    assert (tmp_path / "motion.csv").read_text() == text
    heading, *rows = csv.reader(io.StringIO(text))
    assert heading == ["t", "shoulder", "elbow", "shoulder_dot", "elbow_dot", "shoulder_ddot", "elbow_ddot"]
    numbers = np.array(rows, dtype=float)
    assert np.array_equal(numbers[:, 1:3], samples.q)
    assert np.array_equal(numbers[:, 5:], samples.acceleration)


def test_csv_of_a_motion_can_be_played_again(tmp_path):
    robot = arm("planar_2r")
    samples = CUBIC.sample(50, names=robot.joint_names)
    rows = np.column_stack([samples.t, samples.q])
    file = tmp_path / "motion.csv"
    file.write_text("t,q1,q2\n" + "\n".join(",".join(map(repr, map(float, row))) for row in rows))
    assert run("view", "planar_2r", "--trajectory", file, "--out", tmp_path / "page.html").code == 0
    shown = data_behind((tmp_path / "page.html").read_text(encoding="utf-8"))
    assert shown["actors"] == data_behind(r1.animate(robot, times=samples.t, q=samples.q).html)["actors"]


def test_the_message_of_ros_has_joints_points_and_times():
    message = CUBIC.sample(8, names=["a", "b"]).joint_trajectory("base")
    assert json.loads(json.dumps(message)) == message
    assert message["joint_names"] == ["a", "b"]
    assert message["header"]["frame_id"] == "base"
    assert [point["time_from_start"] for point in message["points"]] == [
        {"sec": 0, "nanosec": 0},
        {"sec": 0, "nanosec": 125_000_000},
        {"sec": 0, "nanosec": 250_000_000},
    ]
    assert message["points"][1]["positions"] == pytest.approx([0.5, 2])
    assert message["points"][1]["velocities"] == pytest.approx([6, 12])


def test_times_of_the_message_are_whole_nanoseconds():
    last = r1.cubic([0], [1], 61.9999999996).sample(1).joint_trajectory()["points"][-1]
    assert last["time_from_start"] == {"sec": 62, "nanosec": 0}


def test_pandas_gets_the_columns_and_is_asked_for_where_it_is_missing(monkeypatch):
    made = {}

    class DataFrame:
        def __init__(self, columns):
            made.update(columns)

        def set_index(self, name):
            return name, self

    monkeypatch.setitem(sys.modules, "pandas", SimpleNamespace(DataFrame=DataFrame))
    assert CUBIC.sample(10).to_pandas()[0] == "t"
    assert list(made) == ["t", "q1", "q2", "q1_dot", "q2_dot", "q1_ddot", "q2_ddot"]
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(r1.MissingExtraError, match=r"robotics1\[pandas\]"):
        CUBIC.sample(10).to_pandas()


@pytest.mark.parametrize(
    ("call", "reason"),
    [
        (lambda: CUBIC.sample(0), "rate must be a positive number"),
        (lambda: CUBIC.sample("fast"), "rate must be a positive number"),
        (lambda: CUBIC.sample(1e12), "at most 1e"),
        (lambda: CUBIC.sample(10, names=["a"]), "one name for each of 2 coordinates"),
        (lambda: CUBIC.sample(10, names="ab"), "one name for each of 2 coordinates"),
        (lambda: r1.curves.slerp_path(np.eye(3), np.diag([-1, -1, 1])).sample(10), "orientations or poses"),
    ],
)
def test_samples_that_cannot_be_are_refused(call, reason):
    with pytest.raises(r1.InputError, match=reason):
        call()


# --- formulas

FORMULAS = [
    ("prr", "planar", "jacobian"),
    ("spatial", "position", "jacobian"),
    ("planar_2r", "position:xy", "determinant"),
]
FORMULAS += [("prr", "planar", "velocity_product"), ("cylindrical", "position", "value")]


def wanted(robot, task, name, q, qdot):
    """The formula's number by SymPy."""
    f = r1.formulas(robot, task)
    values = dict(zip(f.q, q, strict=True)) | dict(zip(f.qdot, qdot, strict=True))
    values |= {
        symbol: robot.parameters[symbol.name] for symbol in getattr(f, name).free_symbols if symbol not in values
    }
    return np.array(getattr(f, name).subs(values), dtype=float).ravel()


@pytest.fixture(scope="module")
def compiled(tmp_path_factory):
    """Compile a function of C, and return it."""
    folder = tmp_path_factory.mktemp("c")

    def load(source, name):
        path = folder / f"{abs(hash(source))}.c"
        path.write_text(source, encoding="ascii")
        library = path.with_suffix(".so")
        flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-shared", "-fPIC"]
        subprocess.run([COMPILER, *flags, "-o", library, path, "-lm"], check=True)
        return getattr(ctypes.CDLL(str(library)), name)

    return load


@pytest.mark.skipif(COMPILER is None, reason="there is no C compiler")
@pytest.mark.parametrize(("name", "task", "formula"), FORMULAS)
def test_c_compiles_without_a_warning_and_gives_the_numbers(compiled, name, task, formula):
    robot = arm(name)
    q, qdot = np.linspace(0.3, 1.1, robot.nq), np.linspace(-0.4, 0.9, robot.nq)
    numbers = wanted(robot, task, formula, q, qdot)
    f = r1.formulas(robot, task)
    function = compiled(f.c(formula), formula)
    vectors = [q, qdot] if formula == "velocity_product" else [q]
    out = np.full(len(numbers), np.nan)
    pointers = [(ctypes.c_double * len(v))(*v) for v in vectors]
    room = (ctypes.c_double * len(out))()
    function(*pointers, *map(ctypes.c_double, robot.parameters.values()), room)
    assert list(room) == pytest.approx(numbers.tolist(), abs=1e-14)


@pytest.mark.parametrize(("name", "task", "formula"), FORMULAS)
def test_matlab_gives_the_numbers(name, task, formula):
    robot = arm(name)
    q, qdot = np.linspace(0.3, 1.1, robot.nq), np.linspace(-0.4, 0.9, robot.nq)
    source = r1.formulas(robot, task).matlab(formula)
    assert matlab(source, q, qdot) == pytest.approx(wanted(robot, task, formula, q, qdot), abs=1e-14)


def matlab(source, q, qdot):
    """What a function of MATLAB returns, as far as it is made of assignments."""
    scope = {"q": q, "qdot": qdot, "sin": np.sin, "cos": np.cos, "sqrt": np.sqrt, "pi": np.pi}
    head, _, *lines, end = source.rstrip().splitlines()
    assert head.startswith("function out = ")
    assert end == "end"
    text = "\n".join(lines).replace("...\n", "")
    text = re.sub(r"if nargin < \d+, (.*?); end", r"\1;", text)
    text = text.replace(".*", "*").replace("./", "/").replace(".^", "**")
    text = re.sub(r"\b(q|qdot)\((\d+)\)", lambda found: f"{found[1]}[{int(found[2]) - 1}]", text)
    for statement in filter(None, (part.strip() for part in re.split(r";\s*\n|;\s*$", text))):
        exec(statement.replace(";", ","), scope)
    return np.ravel(scope["out"])


def test_latex_is_the_formula():
    assert r1.formulas("prr", "planar").latex("determinant") == r"l_{2} \cos{\left(q_{2} \right)}"


def test_names_become_identifiers_and_end_no_comment(compiled):
    rows = [("R", "int", 0, 0, 0), ("R", "λ", 0, 0, 0), ("R", "u3bb", 0, 0, 0)]
    robot = r1.robot_from_dh(rows, parameters={"int": 1.0, "λ": 2.0, "u3bb": 3.0})
    f = r1.formulas(robot, "position:xy")
    assert "double int_, double u3bb, double u3bb_" in f.c("value")
    assert "(q, int, u3bb, u3bb_)" in f.matlab("value")
    if COMPILER is not None:
        room = (ctypes.c_double * 2)()
        lengths = map(ctypes.c_double, (1.0, 2.0, 3.0))
        compiled(f.c("value"), "value")((ctypes.c_double * 3)(0, 0, 0), *lengths, room)
        assert list(room) == pytest.approx([6, 0])


def test_an_unknown_formula_is_refused():
    f = r1.formulas("prr", "planar")
    for write in (f.python, f.c, f.matlab, f.latex):
        with pytest.raises(r1.InputError, match="name must be one of 'value', 'jacobian'"):
            write("inverse")
