"""The pages as a site: each page has its place, each link leads somewhere, and pictures are made by the build."""

import re
import sys
from pathlib import Path

import pytest

import robotics1 as r1

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
PAGES = {page.stem: page.read_text(encoding="utf-8") for page in sorted(DOCS.glob("*.md"))}
LINK = re.compile(r'\]\(([^)\s]+)\)|(?:href|src)="([^"]+)"')


@pytest.fixture(scope="module")
def gallery():
    sys.path.insert(0, str(DOCS))
    try:
        import gallery

        yield gallery
    finally:
        sys.path.remove(str(DOCS))


def prose(text):
    """A page without its code, in which brackets are no links."""
    return re.sub(r"```\w+\n.*?```|`[^`\n]*`", "", text, flags=re.DOTALL)


def test_every_page_is_in_the_table_of_contents():
    listed = re.findall(
        r"^([a-z_/]+)$", "\n".join(re.findall(r"```\{toctree\}(.*?)```", PAGES["index"], re.DOTALL)), re.M
    )
    assert len(listed) == len(set(listed))
    assert set(listed) - {"reference/index"} == set(PAGES) - {"index"}


@pytest.mark.parametrize("name", PAGES)
def test_every_link_of_a_page_leads_to_a_file_or_a_heading(name, gallery):
    for first, second in LINK.findall(prose(PAGES[name])):
        target, _, anchor = (first or second).partition("#")
        if re.match(r"https?://", target) or target.startswith("reference/"):
            continue
        if target.startswith(("_static/", "_made/")):
            assert Path(target).name in gallery.MADE, target
            continue
        path = DOCS / target if target else DOCS / f"{name}.md"
        assert path.exists(), target
        headings = re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), re.M) if anchor else []
        slugs = {re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-") for heading in headings}
        assert not anchor or anchor in slugs, (target, anchor)


def test_the_gallery_draws_each_of_its_pictures(gallery, tmp_path):
    drawn = [gallery.MADE[name](tmp_path / name) or tmp_path / name for name in gallery.MADE if name.endswith(".svg")]
    assert len(drawn) >= 3
    assert all(file.read_bytes().startswith(b"<?xml") for file in drawn)
    for name in gallery.MADE:
        assert name in PAGES["gallery"]


def test_the_sizes_told_add_up():
    total = int(re.search(r"has (\d+) MB on Linux", PAGES["install"])[1])
    parts = [int(size) for size in re.findall(r"^\| [^|]+ \| (\d+) \|", PAGES["install"], re.M)]
    assert sum(parts) == total


def test_what_the_front_page_prints_is_what_its_call_says():
    page = (DOCS / "index.md").read_text(encoding="utf-8")
    (printed,) = re.findall(r"```text\n(.*?)```", page, flags=re.DOTALL)
    said = r1.find_singularities("prr", "planar-pose").explain().splitlines()
    lines = [line for line in printed.splitlines() if line.strip() != "..."]
    assert len(lines) >= 7
    assert [line for line in lines if line not in said] == []
