"""The blocks of the documents run in their order, as they are written, in an empty folder."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
BEFORE = "import matplotlib\nmatplotlib.use('agg')\n"


def blocks(name):
    return BLOCK.findall((ROOT / name).read_text(encoding="utf-8"))


def run(text, folder):
    """In a program of its own: no name of the tests is there."""
    done = subprocess.run([sys.executable, "-c", text], cwd=folder, capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stdout


@pytest.mark.parametrize("name, least", [("docs/python.md", 9), ("README.md", 1)])
def test_blocks_run_as_they_are_written(name, least, tmp_path):
    for library in ("control", "pandas", "matplotlib", "meshio", "pyvista", "IPython"):
        pytest.importorskip(library)
    found = blocks(name)
    assert len(found) >= least
    run(BEFORE + "\n".join(found), tmp_path)


def test_a_wrong_block_fails(tmp_path):
    found = blocks("docs/python.md")
    wrong = found[0].replace('"chassis.z"', '"chassis.up"')
    assert wrong != found[0]
    with pytest.raises(AssertionError, match="chassis.up"):
        run(BEFORE + wrong, tmp_path)
