"""What the commands have in common: help with examples, options of robots, targets, degrees, widths, exit codes."""

import io
import json
import os
import subprocess
import sys

import numpy as np
import pytest
from command import answer, run
from scipy.spatial.transform import Rotation

import robotics1 as r1
from robotics1.cli.options import TASKS
from robotics1.cli.output import PlainConsole
from robotics1.tasks.given import SHORT_FORMS

COMMANDS = ("fk", "jacobian", "manipulability", "singularities", "ik", "statics", "workspace", "scan", "view", "check")
HEAVY = ("numpy", "pinocchio", "scipy", "sympy", "numba", "matplotlib", "xacro")


def test_the_commands_import_nothing_heavy_before_they_are_run():
    code = "import sys, robotics1.cli.commands; print([name for name in sys.argv[1:] if name in sys.modules])"
    found = subprocess.run([sys.executable, "-c", code, *HEAVY], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "[]"


def test_forward_kinematics_needs_no_formulas_and_no_compiler():
    code = "import sys; sys.argv[1:] = ['fk', 'prr']; from robotics1.cli import main\n"
    code += "try: main()\nexcept SystemExit: pass\n"
    code += "print([name for name in ('sympy', 'numba', 'scipy', 'matplotlib') if name in sys.modules])"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip().endswith("[]")


def test_version_and_the_list_of_robots():
    assert run("--version").stdout == f"robotics1 {r1.__version__}\n"
    listed = answer("robots")
    named = {robot["name"]: robot for robot in listed["robots"]}
    assert named["prr"] == {"name": "prr", "from": "robotics1", "joints": "PRR", "tool": "tool"}
    assert {"viewer", "plots", "robots"} <= set(listed["extras"])


@pytest.mark.parametrize("command", [*COMMANDS, "exam", "robots"])
def test_help_has_examples_and_the_options_of_a_robot(command):
    text = run(command, "--help").stdout
    assert f"Examples:\n    robotics1 {command}" in text
    if command in COMMANDS:
        for option in ("--tool", "--packages", "--lock", "--set"):
            assert option in text


def test_the_tasks_of_the_help_are_the_short_forms():
    assert TASKS == SHORT_FORMS


def test_a_shell_can_complete_names_of_robots():
    from robotics1.cli.options import complete_robot

    assert complete_robot("planar") == ["planar_2r"]


def test_a_length_is_set_and_a_joint_is_held():
    found = answer("fk", "planar_2r", "--set", "l1=1", "--set", "l2=2", "--lock", "q1=pi/2", "--q", "0")
    assert found["position"] == pytest.approx([0, 3, 0])
    found = answer("fk", "planar_2r", "--set", "l1=1", "--lock", "q1=90", "--q", "-90", "--degrees")
    assert found["position"] == pytest.approx([0.8, 1, 0])
    assert run("fk", "planar_2r", "--lock", "q1").refusal == "'q1' is no locked joint; write it like q1=0.2"


@pytest.mark.parametrize(
    ("robot", "rows"),
    [("planar_2r", 2), ("prr", 3), ("cylindrical", 3), ("ur5", 6)],
    ids=["xy", "planar", "xyz", "pose"],
)
def test_the_default_task_is_the_one_that_the_robot_is_made_for(robot, rows):
    assert len(answer("jacobian", robot)["jacobian"]) == rows


def test_angles_with_pi_are_radians_and_refused_beside_degrees():
    assert "is an angle in radians" in run("fk", "prr", "--q", "0,pi/2,0", "--degrees").refusal
    assert "is an angle in radians" in run("scan", "planar_2r", "--box", "q1=-pi:90", "--degrees").refusal
    degrees, radians = (answer("fk", "planar_2r", *q) for q in (("--q", "90,-45", "--degrees"), ("--q", "pi/2,-pi/4")))
    assert degrees == radians
    assert degrees["units"] == {"q": ["rad", "rad"], "position": "m"}


def test_a_pose_is_typed_by_angles_by_a_quaternion_or_as_a_matrix():
    arm = r1.load_robot("ur5")
    T = r1.forward_kinematics(arm, [0.3, -1.2, 1.0, 0.4, 0.7, -0.2])
    turn = Rotation.from_matrix(T.rotation)
    forms = [
        [*T.translation, *turn.as_euler("xyz")],
        [*T.translation, *turn.as_quat()],
        T.homogeneous.ravel(),
    ]
    typed = [",".join(repr(float(x)) for x in form) for form in forms]
    found = [np.array(answer("ik", "ur5", f"--target={text}")["solutions"]) for text in typed]
    degrees = ",".join(map(repr, [*map(float, T.translation), *map(float, turn.as_euler("xyz", degrees=True))]))
    found.append(np.array(answer("ik", "ur5", f"--target={degrees}", "--degrees")["solutions"]))
    assert len(found[0]) == 8
    for other in found[1:]:
        assert np.sort(other, axis=0) == pytest.approx(np.sort(found[0], axis=0), abs=1e-6)


def test_a_rotation_is_typed_by_roll_pitch_and_yaw():
    result = run("ik", "ur5", "--task", "orientation", "--target", "0,0", "--method", "damped")
    assert "roll,pitch,yaw, or qx,qy,qz,qw, or 3 × 3 numbers" in result.refusal


@pytest.mark.parametrize("width", [80, 40])
@pytest.mark.parametrize(
    "words",
    [
        ("fk", "prr"),
        ("jacobian", "ur5", "--q", "0,-1,1,0.3,0.4,0"),
        ("ik", "ur5", "--target", "0.4,0.2,0.3,pi,0,0"),
        ("ik", "cylindrical", "--target", "1,-1,3", "--method", "newton", "--q0", "-2,0.7pi,1.4142"),
        ("check", "planar_2r"),
        ("workspace", "planar_2r"),
    ],
    ids=lambda words: f"{words[0]} {words[1]}",
)
def test_tables_fit_the_terminal_and_lose_nothing(monkeypatch, words, width):
    monkeypatch.setenv("COLUMNS", str(width))
    narrow = run(*words).stdout
    tables = [line for line in narrow.splitlines() if line[:1] in "┏┃┡│└ "]
    assert all(len(line) <= width for line in tables)
    assert "…" not in narrow
    monkeypatch.setenv("COLUMNS", "200")
    assert {word for word in run(*words).stdout.split() if word[:1].isdigit()} <= {
        *narrow.split(),
        *narrow.replace(",", " ").split(),
    }


def test_files_of_another_kind_are_named(tmp_path):
    for name, kind in (("arm.stl", "the mesh of a link"), ("arm.sdf", "a simulator"), ("arm.step", "a CAD program")):
        (tmp_path / name).write_text("solid")
        assert kind in run("fk", tmp_path / name).refusal


def test_an_odd_joint_is_a_warning_on_one_line(tmp_path):
    path = tmp_path / "odd.urdf"
    path.write_text(
        '<robot name="odd"><link name="a"/><link name="b"/><joint name="q" type="continuous"><parent link="a"/>'
        '<child link="b"/><axis xyz="0 0 2"/></joint></robot>'
    )
    ended = run("fk", path)
    assert ended.code == 0
    assert ended.stderr.startswith("warning: robot 'odd': ")
    assert ended.stderr.count("\n") == 1


def test_one_answer_is_found_without_the_compiler(tmp_path):
    """As the shell runs it: no machine code is written, and the answer is verified by forward kinematics."""
    script = tmp_path / "robotics1"
    script.write_text(
        "import sys\nfrom robotics1.cli import main\ntry:\n    main()\nfinally:\n    print(sys.modules.get('numba'))\n"
    )
    words = ["ik", "cylindrical", "--target", "1,-1,3", "--method", "solve", "--json"]
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "code")}
    ended = subprocess.run(
        [sys.executable, script, *words], capture_output=True, text=True, check=True, env=environment
    )
    text, _, compiler = ended.stdout.rstrip().rpartition("\n")
    assert compiler == "None"
    found = json.loads(text)
    assert found["status"] == "CONVERGED"
    p = r1.forward_kinematics("cylindrical", found["q"]).translation
    assert p == pytest.approx([1, -1, 3], abs=1e-6)
    assert not (tmp_path / "code").exists()


def test_the_compiler_stays_where_a_process_is_not_the_commands_own():
    from robotics1.cli.uncompiled import run_without_compiler

    run_without_compiler()
    assert sys.modules.get("numba", 0) is not None


def test_a_word_too_many_or_too_short_is_answered_with_what_is_meant():
    assert "write the values of the joints behind --q" in run("fk", "planar_2r", "0,0").stderr
    assert "Did you mean 'singularities'?" in run("sing", "planar_2r").stderr
    assert "Did you mean 'singularities'?" in run("singularity", "planar_2r").stderr
    assert "Did you mean 'fk'?" in run("FK", "planar_2r").stderr


@pytest.mark.parametrize("q", ["[0.5, 1, 2]", "(0.5 1 2)", "q3=2,q1=0.5,q2=1"])
def test_a_configuration_is_typed_with_brackets_or_by_names(q):
    assert answer("fk", "prr", "-q", q) == answer("fk", "prr", "--q", "0.5,1,2")


def test_a_named_angle_is_typed_in_degrees_and_a_named_length_in_metres():
    assert answer("fk", "prr", "-q", "q1=0.5,q2=90,q3=-90", "--degrees") == answer("fk", "prr", "-q", "0.5,pi/2,-pi/2")


def test_a_position_for_a_pose_that_nobody_typed_is_answered_with_the_task():
    assert "for a position add --task position:xy" in run("ik", "prr", "--target", "0.5,0.5").refusal
    assert "for a position add --task position" in run("ik", "ur5", "--target", "0.5,0.5,0.2").refusal


def test_every_command_that_reads_angles_reads_them_in_degrees():
    inside = answer("workspace", "planar_2r", "--box", "q1=-60:60", "--degrees")
    assert inside["area"] == pytest.approx(answer("workspace", "planar_2r", "--box", "q1=-pi/3:pi/3")["area"])
    held = ("planar_2r", "--task", "position:y", "--lock", "q1=90")
    assert answer("singularities", *held, "--degrees") == answer("singularities", *held[:-1], "q1=pi/2")
    assert answer("check", "prr", "--lock", "q2=90", "--degrees") == answer("check", "prr", "--lock", "q2=pi/2")


def test_a_warning_is_said_once():
    assert run("fk", "planar_2r", "--q", "0,90").stderr.count("add --degrees") == 1
    assert run("ik", "prr", "--target", "0.5,0.5,90").stderr.count("add --degrees") == 1


def test_sentences_are_broken_between_words_on_a_terminal_only():
    console = PlainConsole()
    console.file, console.width = io.StringIO(), 30
    console.say("   - a task velocity with a part along (1, 0) cannot be realised")
    assert console.file.getvalue().count("\n") == 1
    console.file, console._force_terminal = io.StringIO(), True
    console.say("   - a task velocity with a part along (1, 0) cannot be realised")
    lines = console.file.getvalue().splitlines()
    assert lines == ["   - a task velocity with a", "     part along (1, 0) cannot", "     be realised"]


def test_the_command_runs_as_a_module_too():
    ended = subprocess.run([sys.executable, "-m", "robotics1", "--version"], capture_output=True, text=True, check=True)
    assert ended.stdout == f"robotics1 {r1.__version__}\n"


UNITS = {
    "fk": (["fk", "prr"], {"q": ["m", "rad", "rad"], "position": "m"}),
    "jacobian": (["jacobian", "prr", "--rows", "y,phi"], {"q": ["m", "rad", "rad"], "rows": ["m/s", "rad/s"]}),
    "statics": (["statics", "prr", "--force", "1,0,0"], {"q": ["m", "rad", "rad"], "torque": ["N", "N m", "N m"]}),
    "singularities": (["singularities", "planar_2r"], {"q": ["rad", "rad"]}),
    "scan": (["scan", "planar_2r", "--samples", "100"], {"q": ["rad", "rad"]}),
    "workspace": (["workspace", "planar_2r"], {"area": "m^2", "volume": "m^3", "lengths": "m"}),
    "check": (["check", "prr"], {"q": ["m", "rad", "rad"], "parameters": "m"}),
}


@pytest.mark.parametrize("name", UNITS)
def test_json_says_its_units(name):
    words, units = UNITS[name]
    assert answer(*words)["units"] == units


# --- robots with joints of several coordinates


LIMIT = '<limit lower="-1" upper="1" velocity="1" effort="1"/>'


@pytest.fixture
def carried(tmp_path):
    """A link on a floating or planar joint, and an arm of one joint on it, whose tool is 0.5 m along x."""

    def written(kind):
        axis = '<axis xyz="0 0 1"/>'
        path = tmp_path / f"{kind}.urdf"
        path.write_text(
            f'<robot name="{kind}"><link name="base"/><link name="body"/><link name="arm"/><link name="tool"/>'
            f'<joint name="m" type="{kind}"><parent link="base"/><child link="body"/>{axis}</joint>'
            f'<joint name="c" type="revolute"><parent link="body"/><child link="arm"/>{axis}{LIMIT}</joint>'
            '<joint name="end" type="fixed"><parent link="arm"/><child link="tool"/><origin xyz="0.5 0 0"/></joint>'
            "</robot>"
        )
        return path

    return written


@pytest.mark.parametrize(
    ("kind", "q", "units"),
    [("floating", "0,0,0,0,0,0,1,30", ["m"] * 3 + ["1"] * 4), ("planar", "0,0,1,0,30", ["m", "m", "1", "1"])],
)
def test_the_joint_behind_one_of_several_coordinates_turns_by_degrees(carried, kind, q, units):
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    found = answer("fk", carried(kind), "--q", q, "--degrees")
    assert found["position"] == pytest.approx([0.5 * c, 0.5 * s, 0])
    assert found["units"]["q"] == [*units, "rad"]
    assert "30)" in run("fk", carried(kind), "--q", q, "--degrees").stdout


@pytest.mark.parametrize(("kind", "columns"), [("floating", np.eye(3, 6)), ("planar", np.eye(3, 2))])
def test_statics_and_jacobian_have_a_column_for_each_rate(carried, kind, columns):
    lever = [[0, 0, 0], [0, 0, 0.5], [0, -0.5, 0]] if kind == "floating" else [[0], [0.5], [0]]
    J = np.hstack([columns[:, :3], lever, [[0], [0.5], [0]]])
    found = answer("jacobian", carried(kind), "--task", "position")
    assert np.array(found["jacobian"]) == pytest.approx(J)
    found = answer("statics", carried(kind), "--task", "position", "--force", "1,2,3")
    assert found["torque"] == pytest.approx(-J.T @ [1, 2, 3])
    slides, turns = (3, 4) if kind == "floating" else (2, 2)
    assert found["units"]["torque"] == ["N"] * slides + ["N m"] * turns
    for command in (["jacobian"], ["statics", "--force", "1,2,3"], ["manipulability"]):
        assert run(command[0], carried(kind), "--task", "position", *command[1:]).code == 0


def test_a_robot_with_a_floating_joint_has_no_workspace(carried):
    assert "only arms of revolute and prismatic joints" in run("workspace", carried("floating")).refusal


@pytest.mark.parametrize("typed", ["30°", "30 deg", "q1=30deg,q2=0", "1.5º", "90degrees"])
def test_degrees_with_their_sign_are_answered_with_the_option(typed):
    assert "degrees are meant with --degrees" in run("fk", "planar_2r", "--q", typed).refusal


def test_numbers_with_blanks_behind_an_option_are_answered_with_a_comma():
    typed = run("ik", "planar_2r", "--target", "1", "1").stderr
    assert "numbers that belong together have a comma between them, as 1,2" in " ".join(typed.split())


@pytest.mark.parametrize("command", [("statics", "planar_2r", "--force", "1,2"), ("manipulability", "planar_2r")])
def test_a_configuration_that_is_not_typed_is_told(command):
    assert "at q = (0, 0), since --q is not given" in run(*command).stdout
    assert "since --q is not given" not in run(*command, "--q", "0.1,0.2").stdout


@pytest.mark.parametrize("words", [("-target", "1,1"), ("-target=1,1",)])
def test_an_option_with_one_dash_is_written_with_two(words):
    ended = run("ik", "planar_2r", *words)
    assert ended.code == 2
    assert f"write -{words[0]}" in ended.stderr
