"""What a page is made of may be junk: meshes that are none, motions that are not finite."""

import struct

import numpy as np
import pytest

import robotics1 as r1

TRIANGLE = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
SOUND = bytes(80) + struct.pack("<I", 1) + TRIANGLE
JUNK = {
    "random": np.random.default_rng(0).bytes(500),
    "empty": b"",
    "truncated": SOUND[:100],
    "a count of 4 milliards": bytes(80) + struct.pack("<I", 4_000_000_000) + TRIANGLE,
    "text": b"not found",
    "html": b"<html><body>404</body></html>",
    "a pointer of git lfs": b"version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12345\n",
    "nan": bytes(80) + struct.pack("<I", 1) + struct.pack("<12fH", *[float("nan")] * 12, 0),
    "infinite": bytes(80) + struct.pack("<I", 1) + struct.pack("<12fH", *[float("inf")] * 12, 0),
}
KINDS = ("stl", "dae", "obj")


def robot_with(folder, *meshes):
    """A robot of one joint with meshes, and a box on the link that moves."""
    visuals = "".join(f'<visual><geometry><mesh filename="{mesh}"/></geometry></visual>' for mesh in meshes)
    path = folder / "arm.urdf"
    path.write_text(
        f'<robot name="r"><link name="base">{visuals}</link>'
        '<link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>'
        '<joint name="q1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>'
        '<limit lower="-3" upper="3" velocity="1" effort="1"/>'
        "</joint></robot>"
    )
    return r1.load_robot(path)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("content", JUNK.values(), ids=JUNK)
def test_a_junk_mesh_is_left_out_with_a_warning_that_names_it(kind, content, tmp_path):
    (tmp_path / f"junk.{kind}").write_bytes(content)
    robot = robot_with(tmp_path, f"junk.{kind}")
    with pytest.warns(r1.RobotWarning, match=rf"junk\.{kind}' .*, so it is not drawn") as warned:
        page = r1.view(robot, [0], tmp_path / "page.html")
    assert len(warned) == 1
    assert page.file.stat().st_size > 500_000


def test_the_rest_of_the_robot_is_drawn(tmp_path):
    (tmp_path / "sound.stl").write_bytes(SOUND)
    (tmp_path / "junk.stl").write_bytes(b"junk")
    drawn = []
    for meshes in (["sound.stl"], ["junk.stl", "sound.stl", "junk.stl"], []):
        robot = robot_with(tmp_path, *meshes)
        if "junk.stl" in meshes:
            with pytest.warns(r1.RobotWarning, match="junk") as warned:
                page = r1.view(robot, [0])
            assert len(warned) == 1
            assert "junk.stl" in page.html
        else:
            page = r1.view(robot, [0])
        drawn.append((page.html.count('"kind":"mesh"'), page.html.count('"kind":"box"')))
    assert drawn == [(1, 1), (1, 1), (0, 1)]


@pytest.mark.parametrize("q", [[np.nan, 0], [0, np.inf], [0], [[0, 0]], ["a", "b"]])
def test_a_view_of_what_is_no_configuration_is_an_input_error(q, tmp_path):
    with pytest.raises(r1.InputError):
        r1.view(r1.load_robot("planar_2r"), q, tmp_path / "page.html")
    assert list(tmp_path.iterdir()) == []


class Motion:
    """A trajectory that gives q at every time."""

    def __init__(self, q, duration=1.0):
        self.q, self.duration = np.asarray(q, dtype=float), duration

    def __call__(self, t):
        return np.broadcast_to(self.q, (*np.shape(t), *self.q.shape))

    def velocity(self, t, *, side="right"):
        return np.zeros((*np.shape(t), *self.q.shape))


@pytest.mark.parametrize(
    "wrong",
    [Motion([np.nan, 0]), Motion([0, np.inf]), *(Motion([0, 0], T) for T in (np.nan, np.inf, 0.0, -1.0))],
    ids=["nan", "inf", "T nan", "T inf", "T 0", "T negative"],
)
def test_a_motion_that_is_not_finite_is_an_input_error(wrong, tmp_path):
    with pytest.raises(r1.InputError):
        r1.animate(r1.load_robot("planar_2r"), wrong, tmp_path / "page.html")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("p", [[np.nan, 0], [np.inf, 0, 0], [1], [1, 2, 3, 4], "x", None])
def test_a_target_that_is_no_point_is_an_input_error(p, tmp_path):
    with pytest.raises(r1.InputError):
        r1.animate(r1.load_robot("planar_2r"), Motion([0, 0]), tmp_path / "page.html", target=lambda _: p)
    assert list(tmp_path.iterdir()) == []
