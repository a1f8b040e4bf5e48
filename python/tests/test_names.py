"""Names of C++, Python and the model file are equal: docs/python.md has the table."""

import re
from pathlib import Path

import floatframe as ff
import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "src" / "floatframe"

pytestmark = pytest.mark.skipif(not SOURCES.is_dir(), reason="the package is not that of the source tree")


def rows():
    text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    table = re.search(r"^\| C\+\+ \| Python \| model file, command \|\n\|[-|]+\|\n((?:\|.*\n)+)", text, re.M)
    return [[re.findall(r"`([^`]+)`", cell) for cell in line.strip().strip("|").split("|")] for line in table[1].splitlines()]


def members(struct, header):
    """Names of the members of a struct."""
    text = (SOURCES / header).read_text(encoding="utf-8")
    body = re.search(rf"struct {struct} \{{\n(.*?)\n\}};", text, re.S)[1]
    body = re.sub(r"//.*", "", body)
    return set(re.findall(r"\b([a-z_]+) = ", body))


def test_every_name_of_the_table_exists():
    headers = "\n".join(p.read_text(encoding="utf-8") for p in SOURCES.rglob("*.hpp"))
    words = (ROOT / "docs" / "model-file.md").read_text(encoding="utf-8") + (ROOT / "docs" / "commands.md").read_text(encoding="utf-8")
    words += (ROOT / "docs" / "parts.md").read_text(encoding="utf-8")
    found = rows()
    assert len(found) >= 20
    for cpp, python, file in found:
        for name in cpp:
            assert re.search(rf"\b{re.escape(name.split('::')[-1])}\b", headers), name
        for name in python:
            thing = ff
            for step in name.split("."):
                assert hasattr(thing, step), name
                thing = getattr(thing, step)
        for name in file:
            assert name in words, name


def test_one_word_in_all_three():
    """Where the columns have one name each they are the same word, but for what the table says of them."""
    def word(name):
        return re.sub(r"[^a-z]", "", name.split("::")[-1].split(".")[-1].lower())

    different = {python[0] for cpp, python, file in rows() if len(cpp) == len(python) == 1 and word(cpp[0]) != word(python[0])}
    text = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
    said = re.search(r"^Different are (.*?)\.$", text, re.M | re.S)
    assert different == set(re.findall(r"`([^`]+)`", said[1])), different


def test_options_of_runs_are_keys_of_the_section_simulation():
    from floatframe.builders import TABLES
    options = set(ff.Options.__annotations__)
    assert options == members("SimulationOptions", "stepping/stepping.hpp") - {"state"}
    table = (ROOT / "python" / "floatframe" / "builders.pyi").read_text(encoding="utf-8")
    keys = set(re.findall(r"^    (\w+):", re.search(r"class SimulationKeys.*?\n\n", table, re.S)[0], re.M))
    assert options <= keys and set(TABLES) == {"joints", "constraints", "couplings", "forces", "controllers"}


def test_sections_are_keys_of_the_file():
    text = (ROOT / "docs" / "model-file.md").read_text(encoding="utf-8")
    table = text[text.index("## Keys of a model file") : text.index("### Points")]
    keys = {name for line in table.splitlines() if line.startswith("| `") for name in re.findall(r"`([a-z]+)`", line.split("|")[1])}
    own = {"floatframe", "name", "gravity", "snap", "parameters", "vehicle", "external"}
    assert keys - own == {name for name in dir(ff.Model) if isinstance(getattr(ff.Model, name), property)} & keys - own


def test_invariants_have_the_letters_of_the_theory():
    text = (SOURCES / "body" / "inertia_invariants.hpp").read_text(encoding="utf-8") if (SOURCES / "body" / "inertia_invariants.hpp").exists() else \
        "\n".join(p.read_text(encoding="utf-8") for p in (SOURCES / "body").glob("*.hpp"))
    for letter in ("m", "m_u", "P_u", "S", "Si", "Sij"):
        assert re.search(rf"\b{letter}\b", text) and hasattr(ff.Invariants, letter)
