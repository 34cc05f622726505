"""Hypothesis profiles, robots, mesh files, and a browser."""

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
settings.register_profile("fuzz", parent=settings.get_profile("default"), max_examples=100)
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


@pytest.fixture
def mesh(tmp_path):
    """Write a mesh file, and files beside it, and read it."""

    from robotics1.viewer.meshes import read_mesh

    def read(name, content, beside=None, **options):
        path = tmp_path / "pkg/meshes" / name
        for file, data in {
            path: content,
            **{path.parent / name: data for name, data in (beside or {}).items()},
        }.items():
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data)
        return read_mesh(path, **options)

    return read


@pytest.fixture
def picture(tmp_path):
    """A picture of two halves, red and blue, in a format."""

    from PIL import Image

    def written(name, size=(8, 8)):
        image = Image.new("RGB", size, (255, 0, 0))
        image.paste((0, 0, 255), (0, 0, size[0] // 2, size[1]))
        image.save(tmp_path / name)
        return (tmp_path / name).read_bytes()

    return written


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
