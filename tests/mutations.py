"""Robot files changed at random: each must load as a robot with finite kinematics, or be refused with a Robotics1Error.

    python tests/mutations.py --count 100000 --seed 1

The mutants are tried in a child process, in batches, so that a crash of the interpreter is seen. The exit code is 1
when one crashes, hangs, raises anything else, or has a pose that is no pose; its text is then printed. Mutant i of a
seed is always the same: `--first i --count 1` tries it alone.
"""

import argparse
import re
import subprocess
import sys
import tempfile
import warnings
from collections import Counter
from functools import cache
from pathlib import Path
from random import Random

from expression_mutations import EXPRESSION_CHANGES, RICH
from joint_kinds import KINDS
from malformed import BASE

TESTS = Path(__file__).parent
BATCH = 2500
LARGE = 20_000  # characters, beyond which a text is changed no more
RICHES = 8  # times more often than another, the file that is rich in expressions is changed
PATIENCE = 900  # seconds for a batch
NUMBER = re.compile(r"(?<![\w.#])-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
ATTRIBUTE = re.compile(r'([\w:]+)="([^"<]*)"')
ELEMENT = re.compile(r"<((?!robot)[\w:]+)[^<>]*/>|<((?!robot)[\w:]+)[^<>]*>(?:(?!<\2\b).)*?</\2>", re.DOTALL)
TAG = re.compile(r"(?<=<)/?[\w:]+")
EXTREMES = (
    *("1e308", "-1e308", "1e309", "-0", "0", "nan", "inf", "-inf", "1e-320", "1e150", "4294967296", "-1", "1e9"),
    *(
        "1_0",
        "0x1p3",
        "",
        " ",
        "1 2 3 4",
        "٣",
        "1,5",
        "1e16",
        "3.141592653589793",
        "-1e-9",
        "true",
        "${1/0}",
        "$(arg l2)",
    ),
)
MILD = ("0.5", "-0.7", "1", "2", "-1.2e-3", "+4", ".25", "5.")
WORDS = (
    *("revolute", "prismatic", "continuous", "fixed", "floating", "planar", "base", "link1", "tool", "q1", "world"),
    *("universe", "", " "),
    *(
        "\u00e9",
        "a" * 5000,
        "../x",
        "package://p/x.stl",
        "&amp;",
        "${pi}",
        "$(find p)",
        "root_joint",
    ),
)
TAGS = (
    *("robot", "link", "joint", "origin", "axis", "limit", "mimic", "parent", "child", "inertial", "mass", "inertia"),
    *(
        "visual",
        "collision",
        "geometry",
        "box",
        "cylinder",
        "mesh",
        "material",
        "color",
        "safety_controller",
        "dynamics",
    ),
    *("xacro:property", "xacro:arg", "xacro:if", "xacro:include", "xacro:macro", "calibration", "transmission", "a"),
)


def _between(random, text):
    start = random.randrange(len(text) + 1)
    return start, min(len(text), start + int(random.expovariate(1 / 12)) + 1)


def flip_bytes(random, text):
    data = bytearray(text.encode("utf-8", errors="replace"))
    for _ in range(random.choice((1, 1, 2, 8))):
        if data:
            data[random.randrange(len(data))] ^= 1 << random.randrange(8)
    return data.decode("latin-1" if random.random() < 0.2 else "utf-8", errors="replace")


def delete(random, text):
    start, end = _between(random, text)
    return text[:start] + text[end:]


def duplicate(random, text):
    start, end = _between(random, text)
    return text[:end] + text[start:end] * random.choice((1, 1, 3, 50)) + text[end:]


def _one(random, pattern, text, new):
    """Replace one match of a pattern by new(match)."""
    match = random.choice([*pattern.finditer(text)] or [re.match("", text)])
    return text[: match.start()] + (new(match) if match[0] else "") + text[match.end() :]


def _swap(random, pattern, text):
    found = list(pattern.finditer(text))
    if len(found) < 2:
        return text
    a, b = sorted(random.sample(found, 2), key=lambda match: match.start())
    if a.end() > b.start():
        return text
    return text[: a.start()] + b[0] + text[a.end() : b.start()] + a[0] + text[b.end() :]


def swap_attributes(random, text):
    return _swap(random, ATTRIBUTE, text)


def swap_elements(random, text):
    return _swap(random, ELEMENT, text)


def move_element(random, text):
    found = [*ELEMENT.finditer(text)] or [re.match("", text)]
    match, place = random.choice(found), random.choice(found).start()
    return text[:place] + match[0] * random.choice((1, 1, 2)) + text[place:]


def drop_element(random, text):
    return _one(random, ELEMENT, text, lambda _: "")


def repeat_element(random, text):
    def numbered(match):
        count = random.choice((2, 10, 140, 1100))
        return "".join(match[0].replace('name="', f'name="{i}', 1) for i in range(count))

    return _one(random, ELEMENT, text, numbered)


def nest_element(random, text):
    depth, tag = random.choice((1, 1, 60, 200, 3000)), random.choice(TAGS)
    return _one(random, ELEMENT, text, lambda match: f"<{tag}>" * depth + match[0] + f"</{tag}>" * depth)


def change_number(random, text):
    numbers = random.choice((MILD, EXTREMES))
    return _one(random, NUMBER, text, lambda _: random.choice(numbers))


def change_value(random, text):
    values = [*WORDS, *EXTREMES, *(match[2] for match in ATTRIBUTE.finditer(text))]
    return _one(random, ATTRIBUTE, text, lambda match: f'{match[1]}="{random.choice(values)}"')


def drop_attribute(random, text):
    return _one(random, ATTRIBUTE, text, lambda _: "")


def rename_attribute(random, text):
    names = [match[1] for match in ATTRIBUTE.finditer(text)] or ["a"]
    return _one(random, ATTRIBUTE, text, lambda match: f'{random.choice(names)}="{match[2]}"')


def rename_tag(random, text):
    return _one(random, TAG, text, lambda match: "/" * match[0].startswith("/") + random.choice(TAGS))


def rename_element(random, text):
    tag = random.choice(TAGS)
    return _one(
        random, ELEMENT, text, lambda match: re.sub(rf"(?<=<)(/?){match[1] or match[2]}\b", rf"\1{tag}", match[0])
    )


def change_all_numbers(random, text):
    return NUMBER.sub(lambda match: random.choice(EXTREMES) if random.random() < 0.05 else match[0], text)


CHANGES = (
    *(flip_bytes, delete, duplicate, swap_attributes, swap_elements, move_element, drop_element, repeat_element),
    *(nest_element, change_number, change_value, drop_attribute, rename_attribute, rename_tag, rename_element),
    *(change_number, change_value, change_all_numbers),
)


@cache
def sources():
    """Name → text of every small robot file; those that include others come with what they include."""
    files = [*(TESTS.parent / "urdf").glob("*.urdf*"), *(TESTS / "robots").glob("*.urdf*")]
    texts = {path.name: path.read_text(encoding="utf-8") for path in sorted(files)}
    texts |= {f"{name.replace(' ', '_')}.urdf": text for name, (text, *_) in KINDS.items()}
    return texts | {"base.urdf": BASE, "rich.urdf.xacro": RICH}


def mutant(seed, i):
    """The name, text, and text of `parts.xacro` of mutant i."""
    random = Random(f"{seed}:{i}")
    texts = sources()
    name = random.choice([*sorted(texts), *["rich.urdf.xacro"] * RICHES])
    text, parts = texts[name], (TESTS.parent / "urdf" / "parts.xacro").read_text(encoding="utf-8")
    for _ in range(random.choice((1, 1, 1, 1, 2, 4))):
        change = random.choice(CHANGES if "$" not in text or random.random() < 0.4 else EXPRESSION_CHANGES)
        if len(text) > LARGE:
            break
        if 'filename="parts.xacro"' in text and random.random() < 0.2:
            parts = change(random, parts)
        else:
            text = change(random, text)
    return name, text, parts


def verdict(path, seed):
    """ "accepted" or "refused"; anything else is raised."""
    import numpy as np
    import pinocchio as pin

    from robotics1 import Robotics1Error, RobotWarning, load_robot

    try:
        with warnings.catch_warnings(action="ignore", category=RobotWarning):
            robot = load_robot(path)
    except Robotics1Error:
        return "refused"
    model, data, random = robot.model, robot.model.createData(), np.random.default_rng(seed)
    pin.buildGeomFromUrdfString(model, robot.urdf, pin.GeometryType.VISUAL)  # what a viewer reads, without a word
    tried = [neutral := pin.neutral(model)]
    if robot.nq == robot.nv:
        low, high = (np.where(np.isfinite(q), q, s * 1e6) for q, s in ((robot.lower, -1), (robot.upper, 1)))
        tried = [np.clip(q, low, high) for q in (neutral, random.uniform(-3, 3, robot.nq), low, high)]
    for q in tried:
        pin.framesForwardKinematics(model, data, q)
        for frame, T in zip(model.frames, data.oMf, strict=True):
            if not (np.isfinite(T.translation).all() and np.abs(T.rotation.T @ T.rotation - np.eye(3)).max() < 1e-6):
                raise AssertionError(f"frame {frame.name!r} has no pose at q = {q.tolist()}: {T}")
    return "accepted"


def try_batch(folder, seed, first, count):
    """In the child: try mutants; what is tried now stands in the folder."""
    outcomes = Counter()
    for i in range(first, first + count):
        name, text, parts = mutant(seed, i)
        (folder / "parts.xacro").write_text(parts, encoding="utf-8", errors="replace")
        (folder / name).write_text(text, encoding="utf-8", errors="replace")
        (folder / "now").write_text(f"{i} {name}", encoding="utf-8")
        outcomes[verdict(folder / name, i)] += 1
    sys.stdout.write(f"{outcomes['accepted']} {outcomes['refused']}")


def run(command, folder):
    """Run a batch; return (accepted, refused), or the reason and the text with which it fails."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
        why = f"exit code {done.returncode}\n{done.stdout[-1000:]}{done.stderr[-6000:]}"
    except subprocess.TimeoutExpired:
        why = f"it takes more than {PATIENCE} s"
    else:
        if done.returncode == 0 and not done.stderr:
            return tuple(int(number) for number in done.stdout.split())
    if not (folder / "now").is_file():
        return why
    number, name = (folder / "now").read_text(encoding="utf-8").split()
    files = [name, "parts.xacro"] if name.endswith(".xacro") else [name]
    texts = [(folder / file).read_text(encoding="utf-8", errors="replace") for file in files]
    return "\n".join([f"mutant {number} of {name}: {why}", *texts, ""])


def main():
    parser = argparse.ArgumentParser(description="Load robot files that are changed at random.")
    parser.add_argument("--count", type=int, default=BATCH)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--child", type=Path, help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.child is not None:
        try_batch(asked.child, asked.seed, asked.first, asked.count)
        return 0
    accepted = refused = 0
    for first in range(asked.first, asked.first + asked.count, BATCH):
        count = min(BATCH, asked.first + asked.count - first)
        with tempfile.TemporaryDirectory() as folder:
            options = ["--child", folder, "--seed", str(asked.seed), "--first", str(first), "--count", str(count)]
            result = run([sys.executable, "-X", "faulthandler", "-W", "error", __file__, *options], Path(folder))
        if isinstance(result, str):
            sys.stdout.write(result)
            return 1
        accepted, refused = accepted + result[0], refused + result[1]
    sys.stdout.write(f"{accepted + refused} mutants tried, {accepted} accepted, {refused} refused\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
