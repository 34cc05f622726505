"""Every option of `robotics1 ik` takes effect, or is refused with the question it is for."""

import json

import pytest
from command import run

ARM = ["ik", "planar_2r", "--task", "position:xy", "-p", "l1=1", "-p", "l2=1"]
REDUNDANT = ["ik", "prr", "--task", "position:xy"]
ITERATIONS = ("newton", "pseudoinverse", "gradient", "damped")
QUESTIONS = {
    "all": ["--target", "1,1"],
    "solve": ["--target", "1,1", "--method", "solve"],
    "targets": [],
    **{method: ["--target", "1,1", "--method", method] for method in ITERATIONS},
}
OPTIONS = {  # option → its value, and the questions it is for
    "--q0": ("0.5,1", {"solve", "targets", *ITERATIONS}),
    "--prefer": ("middle", {"solve", "targets"}),
    "--seed": ("3", {"all", "solve", "targets"}),
    "--time-limit": ("0.3", {"solve", "targets"}),
    "--tolerance": ("0.001", {"solve", "targets", *ITERATIONS}),
    "--max-iterations": ("40", set(ITERATIONS)),
}


@pytest.fixture
def targets(tmp_path):
    path = tmp_path / "targets.csv"
    path.write_text("1,1\n0.5,1\n")
    return ["--targets", str(path)]


def ask(*words):
    """What the command answers as JSON."""
    result = run(*words, "--json")
    assert result.code in (0, 1), result
    return json.loads(result.stdout)


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("option", OPTIONS)
def test_an_option_is_taken_where_it_has_a_meaning_and_refused_elsewhere(option, question, targets):
    value, meant = OPTIONS[option]
    words = [*ARM, *(QUESTIONS[question] or targets), option, value]
    result = run(*words)
    if question in meant:
        assert result.code in (0, 1), result
        return
    message = result.refusal
    assert message.startswith(f"{option} {value} is for ")
    assert ("all solutions" in message.partition(";")[0]) == ("all" in meant)
    assert ("--method solve" in message.partition(";")[0]) == ("solve" in meant)
    assert ("newton" in message.partition(";")[0]) == ("newton" in meant)


@pytest.mark.parametrize("option", ["--prefer", "--seed", "--time-limit", "--max-iterations"])
def test_the_value_that_is_the_default_is_refused_too(option):
    """`--prefer any` for Newton changes nothing either."""
    default = {"--prefer": "any", "--seed": "0", "--time-limit": "0.5", "--max-iterations": "50"}[option]
    question = "solve" if option == "--max-iterations" else "newton"
    assert run(*ARM, *QUESTIONS[question], option, default).refusal.startswith(f"{option} {default} is for ")


def test_near_needs_a_start_to_be_near_to():
    result = run(*REDUNDANT, "--target", "1,0.5", "--method", "solve", "--prefer", "near")
    assert "--prefer near needs --q0" in result.refusal


def test_each_option_changes_what_it_is_for():
    near = [*REDUNDANT, "--target", "1,0.5", "--method", "solve", "--prefer", "near"]
    assert ask(*near, "--q0", "0.5,0.5,0.5")["q"] != ask(*near, "--q0", "0.6,1,0.9")["q"]
    newton = [*ARM, *QUESTIONS["newton"]]
    assert len(ask(*newton, "--q0", "0.5,1", "--max-iterations", "2")["table"]) == 3
    assert (
        ask(*newton, "--q0", "0.5,1", "--tolerance", "1e-12")["iterations"]
        > ask(*newton, "--q0", "0.5,1")["iterations"]
    )
    family = [*REDUNDANT, "--target", "1,0.5"]
    assert ask(*family, "--seed", "1")["solutions"] != ask(*family, "--seed", "2")["solutions"]
    assert ask(*family, "--seed", "0")["solutions"] == ask(*family)["solutions"]


def test_degrees_are_read_and_printed_in_every_answer(targets):
    """The 2R of links 1 m reaches (1, 1) at (0, π/2) and (π/2, −π/2)."""
    for words in (["--q0", "5,70", "--method", "newton"], ["--q0", "5,70", "--method", "solve"], []):
        printed = run(*ARM, "--target", "1,1", *words, "--degrees").stdout
        assert "90" in printed
        assert "1.5708" not in printed
    printed = run(*ARM, *targets, "--degrees", "--q0", "5,70").stdout
    assert "90" in printed
    assert "1.57" not in printed


def test_degrees_of_an_iteration_are_of_the_angles_alone():
    words = ["ik", "prr", "--task", "planar-pose", "--target", "1,0.5,90", "--q0", "0.5,40,30", "--method", "newton"]
    printed = run(*words, "--degrees", "--max-iterations", "0").stdout
    assert "angles in degrees, |e| in radians" in printed
    row = next(line for line in printed.splitlines() if "(0.5000, 40, 30)" in line)
    assert ", 70)" in row
