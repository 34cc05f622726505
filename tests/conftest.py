"""Hypothesis profiles, robots, and a browser."""

import os
import shutil

import pytest
from arms import arm
from hypothesis import settings
from hypothesis.internal.conjecture import providers
from sweeps import put_off_long_tests

CHROMIUM = shutil.which("chromium")
FLAGS = [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]

settings.register_profile("default", deadline=None, derandomize=True, max_examples=12, database=None, print_blob=True)
providers.is_local_module_file = lambda _: False  # else the numbers in whatever modules are loaded are tried as well
settings.register_profile("sweep", parent=settings.get_profile("default"), max_examples=100)
settings.load_profile("default")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Mark what takes long, before pytest selects by marks."""
    narrowed = config.args != config.getini("testpaths") or config.getoption("ignore_glob")
    put_off_long_tests(items, every_file=not narrowed)


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


@pytest.fixture(scope="module")
def browser():
    """Chromium without a window; closed after each module, since Playwright's event loop runs until then."""
    if CHROMIUM is None:
        if os.environ.get("CI"):
            pytest.fail("chromium is not installed, and CI must see the pages")
        pytest.skip("chromium is not installed")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield browser
        browser.close()
