from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))

PICTURES = {"exercise_1": 1, "exercise_2": 0, "exercise_3": 0, "arm_ur5": 1, "arm_panda": 0, "own_urdf": 0}  # figures


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_the_notebook_is_thin_stripped_and_runs(path):
    notebook = nbformat.read(path, as_version=4)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert cells
    for cell in cells:
        assert len(cell.source.splitlines()) <= 12
        assert "def " not in cell.source
        assert cell.outputs == []
        assert cell.execution_count is None
    NotebookClient(notebook, timeout=120, resources={"metadata": {"path": path.parent}}).execute()
    shown = [output.data for cell in cells for output in cell.outputs if "data" in output]
    pages = [html for data in shown if (html := data.get("text/html", "")).startswith("<iframe srcdoc=")]
    assert len(pages) == 1  # a page stands in the notebook, without a file or a server
    assert "default-src &#x27;none&#x27;" in pages[0]
    assert pages[0].count("<iframe") == 1
    pictures = [data["image/png"] for data in shown if "image/png" in data]
    assert len(pictures) == PICTURES[path.stem[:10]]


def test_there_is_one_notebook_an_exercise_and_one_a_real_arm():
    assert {path.stem[:10] for path in NOTEBOOKS} == set(PICTURES)
