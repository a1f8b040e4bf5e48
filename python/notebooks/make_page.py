#!/usr/bin/env python3
"""Runs the notebooks of the course and makes docs/course.md with their pictures, or notebooks with all they show.

  python python/notebooks/make_page.py                    docs/course.md and docs/figures/course_*.png
  python python/notebooks/make_page.py --ipynb FOLDER     executed notebooks for Jupyter
  python python/notebooks/make_page.py --check [NAME]     runs them only; FLOATFRAME_SHORT=1 for short runs

The notebooks are Python files with cells ("# %%"), which Jupyter with jupytext and most editors open as they are. Needs
floatframe, jupytext, nbclient, ipykernel and matplotlib.
"""

import argparse
import base64
import os
import sys
from pathlib import Path

import jupytext
import nbclient
import nbformat

HERE = Path(__file__).resolve().parent
DOCS = HERE.parents[1] / "docs"
HEAD = """# Course

Eight short notebooks, from a pendulum to inertia terms of one's own. Each has a little theory, a picture, and a check by a formula or by a second
method; the tests run them all. Their sources are [`python/notebooks`](../python/notebooks): Python files with cells, which Jupyter opens
with jupytext. In a folder of their own, with everything they show:

```sh
python python/notebooks/make_page.py --ipynb out/notebooks
```

Text, pictures and numbers below are theirs; `python python/notebooks/make_page.py` makes this page. Times are those of one
machine.
"""
TAIL = """## Mechanisms as model files

One idea each, as a model file with a picture and numbers that a test compares with closed forms
(`tests/cli/course_examples_test.py`):

| example | idea |
|---|---|
| [`four_bar`](../examples/four_bar/README.md) | a loop closes by itself; directions that are held twice |
| [`gear_train`](../examples/gear_train/README.md) | couplings, and forces of teeth on bearings |
| [`cam`](../examples/cam/README.md) | lifts with exact derivatives, and lift-off |
| [`robot_arm`](../examples/robot_arm/README.md) | flexible links with PID controllers |
| [`scissor_lift`](../examples/scissor_lift/README.md) | several loops, and a cylinder |
| [`crane_with_trolley`](../examples/crane_with_trolley/README.md) | what rolls along a flexible body |

Mechanisms with closed forms to learn from are the [benchmarks](../examples/benchmarks/README.md): differential, screw jack, belt, friction, restitution,
cycloid.
"""


def sources():
    return sorted(HERE.glob("[0-9][0-9]_*.py"))


def executed(source):
    """The notebook of a file after it has run; an error in a cell is raised. It runs in the folder of the notebooks."""
    notebook = jupytext.read(source)
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    folders = [os.path.abspath(folder) for folder in os.environ.get("PYTHONPATH", "").split(os.pathsep) if folder]
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join(folders),  # the kernel starts in another folder
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",  # whichever the shell has
    }
    client = nbclient.NotebookClient(notebook, timeout=600, resources={"metadata": {"path": str(HERE)}})
    client.execute(env=environment)
    return notebook


def outputs(notebook):
    for cell in notebook.cells:
        yield from cell.get("outputs", [])


def pictures(notebook):
    data = [output.get("data", {}) for output in outputs(notebook)]
    return [base64.b64decode(d["image/png"]) for d in data if "image/png" in d]


def printed(notebook):
    return "".join(output["text"] for output in outputs(notebook) if output["output_type"] == "stream" and output["name"] == "stdout")


def section(source, notebook):
    """What the page says of a notebook: its first text, its picture, what it prints. Writes the picture."""
    title, _, text = notebook.cells[0].source.partition("\n")
    number = int(source.name[:2])
    parts = [f"## {number}. {title.removeprefix('# ')}\n", text.strip() + "\n"]
    for k, picture in enumerate(pictures(notebook)):
        name = f"course_{number:02}{chr(ord('a') + k) if k else ''}.png"
        (DOCS / "figures" / name).write_bytes(picture)
        parts.append(f"![{title.removeprefix('# ')}](figures/{name})\n")
    parts.append(f"```\n{printed(notebook).rstrip()}\n```\n")
    parts.append(f"[{source.name}](../python/notebooks/{source.name})\n")
    return "\n".join(parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ipynb", metavar="FOLDER", type=Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("names", nargs="*", help="beginnings of names of notebooks; all if none is given")
    options = parser.parse_args()
    chosen = [s for s in sources() if not options.names or any(s.name.startswith(n) for n in options.names)]
    page = [HEAD]
    for source in chosen:
        print(source.name, file=sys.stderr)
        notebook = executed(source)
        if options.ipynb:
            options.ipynb.mkdir(parents=True, exist_ok=True)
            nbformat.write(notebook, options.ipynb / f"{source.stem}.ipynb")
        elif options.check:
            print(printed(notebook))
        else:
            page.append(section(source, notebook))
    if not options.ipynb and not options.check:
        if options.names:
            parser.error("the page is made of all notebooks")
        page.append(TAIL)
        (DOCS / "course.md").write_text("\n".join(page), encoding="utf-8")


if __name__ == "__main__":
    main()
