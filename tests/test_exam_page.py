"""The page of formulas, and named formulas as text."""

import re

import pytest
import sympy
from exams.formula_page import write_formula_page
from exams.named_formulas import FormulaSection, NamedFormula

from robotics1 import InputError

l2, q2, nu = sympy.symbols("l2 q2 nu", real=True)
SECTIONS = [
    FormulaSection(
        "Matrices & <tags>",
        [
            NamedFormula("a < b", "J_r", sympy.Matrix([[1, -l2 * sympy.sin(q2)], [0, -1]])),
            NamedFormula("null space", "qdot_0", sympy.MatMul(nu, sympy.Matrix([l2, 1])), "ν (0.6, 1)"),
            NamedFormula("a long one", "w", sympy.Matrix([[sympy.Symbol(f"l{i}") for i in range(60)]])),
        ],
        "l2 = 0.6 m",
        ["line < one", "line two"],
    ),
    FormulaSection("Conditions", [NamedFormula("ṙ", "", sympy.Ne(sympy.Symbol("rdot1"), 0))]),
]


# --- text


def test_a_formula_of_one_line_stands_beside_its_name_and_its_number():
    assert NamedFormula("determinant", "det(J_r)", l2 * sympy.cos(q2)).text() == "determinant: det(Jᵣ) = l₂⋅cos(q₂)"
    assert NamedFormula("time", "t_rv", 2 * l2, "1.2 s").text() == "time: tᵣᵥ = 2⋅l₂ = 1.2 s"


def test_a_matrix_stands_below_its_name_without_the_lines_between_its_rows():
    assert NamedFormula("a", "J", sympy.eye(3), "1").text() == (
        "a:\n        ⎡1  0  0⎤\n    J = ⎢0  1  0⎥\n        ⎣0  0  1⎦\n    = 1"
    )
    assert NamedFormula("b", "J", sympy.eye(2)).text() == "b:\n        ⎡1  0⎤\n    J = ⎢    ⎥\n        ⎣0  1⎦"


def test_a_condition_stands_for_itself():
    condition = sympy.Ne(sympy.Symbol("rdot1"), 0)
    assert NamedFormula("c", "", condition).equation is condition
    assert NamedFormula("c", "", condition).text() == "c: r\N{COMBINING DOT ABOVE}₁ ≠ 0"


# --- page


def test_the_page_has_each_section_name_number_and_formula_and_escapes_them(tmp_path):
    path = write_formula_page(tmp_path / "f.html", SECTIONS, title="A <b>title</b>")
    text = path.read_text(encoding="utf-8")
    assert path == tmp_path / "f.html"
    assert [file.name for file in tmp_path.iterdir()] == ["f.html"]  # no unfinished one beside it
    assert text.count("<math ") == 4
    assert text.count("A &lt;b&gt;title&lt;/b&gt;") == 2
    for part in (
        "<h2>Matrices &amp; &lt;tags&gt;</h2>",
        "<dt>a &lt; b</dt>",
        "<p>l2 = 0.6 m</p>",
        "<p>line &lt; one</p>",
    ):
        assert part in text
    assert "<p>line two</p>" in text
    assert '<p class="number">= ν (0.6, 1)</p>' in text
    assert "<script" not in text
    assert not re.search(r"""(src|href)=|url\(|@import""", text)


def test_velocities_have_a_dot_and_numbers_a_minus(tmp_path):
    text = write_formula_page(tmp_path / "f.html", SECTIONS, title="").read_text(encoding="utf-8")
    assert "<msub><mover><mi>q</mi><mo>˙</mo></mover><mi>0</mi></msub>" in text
    assert "<mover><mi>r</mi><mo>˙</mo></mover>" in text
    assert "dot<" not in text
    assert "<mn>−1</mn>" in text
    assert "<mo>−</mo>" in text
    assert ">-" not in text


def test_a_page_in_a_folder_that_does_not_exist_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"there is no folder .*nowhere"):
        write_formula_page(tmp_path / "nowhere" / "f.html", SECTIONS, title="t")


def test_an_old_page_is_replaced_as_a_whole(tmp_path):
    (tmp_path / "f.html").write_text("old " * 100_000)
    text = write_formula_page(tmp_path / "f.html", SECTIONS[1:], title="t").read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert text.endswith("</html>\n")


@pytest.fixture
def shown(browser, tmp_path):
    """Return a function that opens the page in a window, with what went wrong in it."""
    path = write_formula_page(tmp_path / "f.html", SECTIONS, title="Formulas")
    pages = []

    def show(**options):
        page = browser.new_page(**options)
        page.wrong = []
        page.on("console", lambda message: page.wrong.append(message.text))
        page.on("request", lambda request: page.wrong.append(request.url) if "file:" not in request.url else None)
        page.goto(path.as_uri())
        pages.append(page)
        return page

    yield show
    for page in pages:
        page.close()


def style(page, element, name):
    return page.evaluate(f"getComputedStyle(document.querySelector('{element}')).{name}")


def test_the_formulas_are_drawn_and_the_matrices_have_brackets(shown):
    page = shown(viewport={"width": 1000, "height": 800})
    boxes = page.evaluate("[...document.querySelectorAll('math')].map(m => m.getBoundingClientRect().toJSON())")
    assert len(boxes) == 4
    assert all(box["width"] > 20 and box["height"] > 10 for box in boxes)
    assert style(page, "mtable", "borderLeftWidth") in ("1px", "1.5px")
    assert style(page, "mo:has(+ mtable)", "display") == "none"
    assert page.wrong == []


@pytest.mark.parametrize("width", [1000, 380])
def test_a_long_formula_scrolls_by_itself_and_not_the_page(shown, width):
    page = shown(viewport={"width": width, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert page.evaluate("[...document.querySelectorAll('dd')].map(d => d.scrollWidth > d.clientWidth)")[2]


def luminance(colour):
    channels = [int(x) / 255 for x in re.findall(r"\d+", colour)[:3]]
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
    return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_text_has_a_contrast_of_more_than_4_5_in_light_and_dark(shown, scheme):
    page = shown(color_scheme=scheme)
    paper = luminance(style(page, "body", "backgroundColor"))
    assert (paper < 0.1) == (scheme == "dark")
    for element in ("body", "math", ".number"):
        ink = luminance(style(page, element, "color"))
        assert (max(ink, paper) + 0.05) / (min(ink, paper) + 0.05) > 4.5
