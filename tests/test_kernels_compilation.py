"""Kernels compiled as one program, in two processes; all of it here where the other process fails."""

import json
import os
import subprocess
import sys
import textwrap
from importlib.util import find_spec

import numpy as np
import pytest

from robotics1 import PoseTask, forward_kinematics, load_robot
from robotics1.ik import SolutionSolver
from robotics1.kernels import newton, placements
from robotics1.kernels.compilation import COMPILED

pytestmark = pytest.mark.skipif(find_spec("numba") is None, reason="Numba is not installed")

Q = [0.3, -1.2, 1.1, 0.4, 0.5, 0.6]

FIRST_SOLVER = """
{before}
import json
from robotics1 import PoseTask, forward_kinematics, load_robot
from robotics1.ik import SolutionSolver
from robotics1.kernels import every_solution, loops
robot = load_robot("ur5", tool="tool0")
found = SolutionSolver(robot, PoseTask())(forward_kinematics(robot, {q}))
hits = [sum(kernel.stats.cache_hits.values()) for kernel in (every_solution.settled, loops.beside_a_plane)]
print(json.dumps([found.q.tolist(), found.method, hits]))
"""


def first_solver(folder, before="", **environment):
    """The solutions of a UR5 in a new process with an empty cache, and which parts it found on disk."""
    done = subprocess.run(
        [sys.executable, "-c", FIRST_SOLVER.format(before=textwrap.dedent(before), q=Q)],
        env=os.environ | {"NUMBA_CACHE_DIR": str(folder), "NUMBA_NUM_THREADS": "2"} | environment,
        check=True, capture_output=True, text=True, timeout=300,
    )  # fmt: skip
    return json.loads(done.stdout)


def here():
    robot = load_robot("ur5", tool="tool0")
    return SolutionSolver(robot, PoseTask())(forward_kinematics(robot, Q)).q


@pytest.mark.sweep
def test_half_of_a_kernel_is_compiled_by_another_process_and_found_on_disk(tmp_path):
    q, _, (settled, candidates) = first_solver(tmp_path)
    assert (settled, candidates) == (1, 0)
    assert np.array(q) == pytest.approx(here(), rel=0, abs=1e-12)


@pytest.mark.sweep
def test_where_the_other_process_fails_all_is_compiled_here(tmp_path):
    (tmp_path / "python").symlink_to("/bin/false")
    q, _, hits = first_solver(tmp_path, f"import sys\nsys.executable = {str(tmp_path / 'python')!r}")
    assert hits == [0, 0]
    assert np.array(q) == pytest.approx(here(), rel=0, abs=1e-12)


KERNELS = """
import json
import numpy as np
from robotics1.kernels.compilation import compiled

@compiled(inner=True)
def square(x):
    return x * x

@compiled(inner=True)
def sums(a, b):
    total = 0.0
    for i in range(len(a)):
        b[i] = square(a[i])
        total += b[i]
    return total

@compiled()
def twice(a):
    b = np.empty(len(a))
    return sums(a, b) + sums(b, b)

print(json.dumps([twice(np.array([1.0, 2.0, 3.0])), len(square.signatures), sum(twice.stats.cache_hits.values())]))
"""


def test_inner_kernels_are_linked_with_what_calls_them_when_compiled_and_when_read_from_disk(tmp_path):
    (tmp_path / "three_kernels.py").write_text(KERNELS)
    answers = []
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "three_kernels.py"], cwd=tmp_path, check=True, capture_output=True, text=True, timeout=120,
            env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)},
        )  # fmt: skip
        answers.append(json.loads(done.stdout))
    assert answers == [[14.0 + 98.0, 1, 0], [14.0 + 98.0, 0, 1]]  # Σ x² + Σ x⁴; from disk, nothing is compiled


FROM_PYTHON = """
import numpy as np
from robotics1.kernels.compilation import compiled
from three_kernels import square

print(compiled()(square.py_func)(3.0))
"""


def test_a_kernel_for_python_does_not_take_the_code_on_disk_that_only_kernels_can_call(tmp_path):
    (tmp_path / "three_kernels.py").write_text(KERNELS)
    (tmp_path / "from_python.py").write_text(FROM_PYTHON)
    for program in ("three_kernels.py", "from_python.py"):
        done = subprocess.run(
            [sys.executable, program], cwd=tmp_path, check=True, capture_output=True, text=True, timeout=120,
            env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "cache")},
        )  # fmt: skip
    assert done.stdout.splitlines()[-1] == "9.0"


def test_a_kernel_calls_its_own_copies_of_functions_so_that_it_rounds_as_it_does_alone():
    from llvmlite.binding import Linkage
    from numba import njit

    from robotics1.kernels.one_program import KernelCompiler

    options = {"pipeline_class": KernelCompiler, "nogil": True, "no_cfunc_wrapper": True}
    inner = njit(**options, no_cpython_wrapper=True)(lambda x: np.sin(x) * np.linalg.det(np.eye(3)))
    kernel = njit(**options)(lambda x: inner(x) + inner(2 * x))
    assert kernel(0.5) == pytest.approx(np.sin(0.5) + np.sin(1.0), rel=1e-15)
    (program,) = (compiled.library for compiled in kernel.overloads.values())
    shared = {Linkage.linkonce_any, Linkage.linkonce_odr, Linkage.weak_any, Linkage.weak_odr}
    functions = [each for each in program._final_module.functions if not each.is_declaration]
    assert functions
    assert not [each.name for each in functions if each.linkage in shared]


@pytest.mark.skipif(not COMPILED, reason="kernels run as Python")
def test_an_inner_kernel_called_from_python_raises_a_type_error_also_once_it_is_compiled():
    robot = load_robot("ur5", tool="tool0")
    SolutionSolver(robot, PoseTask())(forward_kinematics(robot, Q))
    for kernel, arguments in [
        (placements.turn, (np.eye(3, 4), np.ones(3), np.zeros(3))),
        (newton.norm, (np.ones(3), np.arange(3), 1.0)),
    ]:
        for _ in range(2):
            with pytest.raises(TypeError, match=f"{kernel.__name__} is called by other kernels only"):
                kernel(*arguments)


def elements(A, whole, small, C):
    """Entries read and written by every kind of index."""
    A[-1, 0], A[0, -1], whole[1] = whole[-2], 7, A[1, 1]
    k = -2
    A[k, k + 3] += small[1] + C[1, 0, -1] + C[k + 1][1, k]
    A[:, 2][k] = A.T[0, 1] + A[::2][1, 0]  # not contiguous
    A[1] = whole[:3]
    for i in range(len(whole) - 1, -1, -2):
        whole[i - 1] = whole[i] + i
    return A[2, 1] + whole[-1]


def test_an_element_of_an_array_is_read_and_written_as_numpy_does():
    from numba import njit

    from robotics1.kernels.one_program import KernelCompiler

    def given():
        A, C = np.arange(9.0).reshape(3, 3) + 0.5, np.arange(8.0).reshape(2, 2, 2) / 3
        return A, np.arange(10, 14), np.array([3, 200], dtype=np.uint8), C

    expected, found = given(), given()
    kernel = njit(elements, pipeline_class=KernelCompiler, no_cfunc_wrapper=True)
    assert kernel(*found) == elements(*expected)
    for own, numpy in zip(found, expected, strict=True):
        np.testing.assert_array_equal(own, numpy)
