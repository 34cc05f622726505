"""The page on formulas: its code runs, and its table names what is there."""

import re
from pathlib import Path

import pytest

from robotics1 import Formulas

PAGE = (Path(__file__).parents[1] / "docs" / "formulas.md").read_text("utf-8")


@pytest.fixture(scope="module")
def space():
    """One namespace for all blocks of the page, in their order."""
    return {}


@pytest.mark.parametrize("block", re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL))
def test_the_code_of_the_page_on_formulas_runs(block, space):
    exec(compile(block, "formulas.md", "exec"), space)


def test_the_page_names_attributes_that_exist():
    named = set(re.findall(r"`f\.(\w+)", PAGE))
    assert {"value", "jacobian", "determinant", "minors", "jacobian_rate", "velocity_product", "python"} <= named
    fields = {*Formulas.__dataclass_fields__, *dir(Formulas)}
    assert named <= fields
