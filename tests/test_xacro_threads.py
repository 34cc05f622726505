"""xacro files in threads: each gets its own lengths, and the library xacro stays as it is for everybody else."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier
from xml.dom import minidom

import pytest
import xacro
from xacro import substitution_args

from robotics1 import forward_kinematics, load_robot, robot_from_dh

ARM = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:arg name="l" default="0.5"/><xacro:property name="l" value="$(arg l)"/>
<xacro:include filename="part.xacro"/>
<xacro:arm length="${l}"/>
</robot>"""
PART = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:macro name="arm" params="length"><link name="base"/><joint name="q1" type="revolute">
<parent link="base"/><child link="tool"/><origin xyz="${length} $(arg l) $(eval 2*l)"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="2" velocity="1" effort="1"/></joint><link name="tool"/></xacro:macro>
</robot>"""
THREADS, LOADS = 4, 15


@pytest.fixture
def arm(tmp_path):
    (tmp_path / "arm.xacro").write_text(ARM)
    (tmp_path / "part.xacro").write_text(PART)
    return tmp_path / "arm.xacro"


def from_file(arm, length):
    return forward_kinematics(load_robot(arm, parameters={"l": length}), [0]).translation / [1, 1, 2]


def from_dh(_, length):
    rows = [("R", "l", 0, "l", 0), ("P", 0, 0, "-l", 0)]
    x, _, z = forward_kinematics(robot_from_dh(rows, parameters={"l": length}), [0, 0]).translation
    return [x, length, z + length]


def by_xacro_itself(arm, length):
    document = xacro.process_file(str(arm), mappings={"l": str(length)})
    return document.getElementsByTagName("origin")[0].getAttribute("xyz")


def in_threads(work, lengths):
    """Run work(length) for the lengths of each thread at once."""
    barrier = Barrier(len(lengths))

    def run(own):
        barrier.wait()
        return [work(length) for length in own]

    with ThreadPoolExecutor(len(lengths)) as pool:
        return list(pool.map(run, lengths))


def drawn(thread):
    return [1 + thread + i / 100 for i in range(LOADS)]


@pytest.mark.parametrize("load", [from_file, from_dh])
def test_robots_built_in_threads_have_their_own_lengths(arm, load):
    lengths = [drawn(thread) for thread in range(THREADS)]
    found = in_threads(lambda length: load(arm, length), lengths)
    for own, places in zip(lengths, found, strict=True):
        for length, p in zip(own, places, strict=True):
            assert p == pytest.approx([length] * 3, abs=1e-12)


def test_somebody_who_uses_xacro_meanwhile_gets_his_own_lengths(arm):
    lengths = [drawn(thread) for thread in range(3)]

    def work(length):
        return from_file(arm, length) if length >= 2 else by_xacro_itself(arm, length)

    found = in_threads(work, lengths)
    assert found[0] == [f"{length} {length} {2 * length}" for length in lengths[0]]
    for own, places in zip(lengths[1:], found[1:], strict=True):
        assert [p[1] for p in places] == pytest.approx(own)


def test_nothing_of_xacro_or_python_is_exchanged(arm):
    def state():
        modules = [dict(vars(module)) for module in (xacro, substitution_args)]
        tables = [dict(xacro._global_symbols), dict(xacro._global_symbols["xacro"]), dict(substitution_args._eval_dict)]
        return [*modules, *tables, sys.stderr, sys.stdout, minidom.Element.writexml]

    before = state()
    in_threads(lambda length: from_file(arm, length), [drawn(thread) for thread in range(THREADS)])
    assert state() == before


def test_a_robot_of_a_xacro_file_does_not_import_the_library_for_others(arm):
    code = (
        "import sys; from xml.dom import minidom; before = minidom.Element.writexml; import robotics1 as r1; "
        f"r1.load_robot({str(arm)!r}); assert 'xacro' not in sys.modules; assert minidom.Element.writexml is before"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=120)
