"""The notebooks of the course run as they are, in short versions; each shows a picture and checks itself."""

import ast
import importlib.util
from pathlib import Path

import pytest

pytest.importorskip("jupytext")
pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("[0-9][0-9]_*.py"))


@pytest.fixture(scope="module")
def course():
    spec = importlib.util.spec_from_file_location("make_page", FOLDER / "make_page.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_notebooks_are_there():
    assert [int(path.name[:2]) for path in NOTEBOOKS] == list(range(1, 9))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook(path, course, monkeypatch):
    monkeypatch.setenv("FLOATFRAME_SHORT", "1")
    notebook = course.executed(path)
    assert course.pictures(notebook)
    assert course.printed(notebook)
    text = path.read_text(encoding="utf-8")
    assert any(isinstance(node, ast.Assert) for node in ast.walk(ast.parse(text)))
    assert len(text.splitlines()) < 100


def test_the_page_has_every_notebook():
    page = (FOLDER.parents[1] / "docs" / "course.md").read_text(encoding="utf-8")
    for path in NOTEBOOKS:
        assert f"python/notebooks/{path.name}" in page
        assert f"figures/course_{path.name[:2]}.png" in page
        assert (FOLDER.parents[1] / "docs" / "figures" / f"course_{path.name[:2]}.png").is_file()


def test_a_wrong_notebook_fails(tmp_path, course):
    path = tmp_path / "09_wrong.py"
    path.write_text("# %%\nassert 1 == 2\n", encoding="utf-8")
    with pytest.raises(Exception, match="AssertionError"):
        course.executed(path)
