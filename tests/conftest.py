"""Hypothesis profiles and robots."""

import os

import pytest
from arms import arm
from hypothesis import settings

settings.register_profile("default", deadline=None, derandomize=True, max_examples=40, database=None)
settings.register_profile("ci", parent=settings.get_profile("default"), max_examples=60, print_blob=True)
settings.load_profile("ci" if os.environ.get("CI") else "default")


@pytest.fixture(scope="session")
def prr():
    return arm("prr")


@pytest.fixture(scope="session")
def cylindrical():
    return arm("cylindrical")


@pytest.fixture(scope="session")
def planar_2r():
    return arm("planar_2r")


@pytest.fixture(scope="session")
def spatial():
    """R P R R R about skewed axes, with a turned tool."""
    return arm("spatial")


@pytest.fixture(scope="session")
def one_joint():
    return arm("one_joint")
