#!/usr/bin/env python3
"""Writes the keys of model files for Python from the tables of docs/model-file.md: python/floatframe/keys.json, which `help` and
the checks of names read, and python/floatframe/builders.pyi, which mypy and editors read.

Usage: write_python_keys.py [--check]
--check: exit code 1 if the files are not those of the tables.
"""
import json
import keyword
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "python" / "floatframe"
# Section -> heading of its table of types, and what heads the first column.
TYPED = {"constraints": ("Constraints", "constraint"), "couplings": ("Couplings", "coupling"), "forces": ("Forces", "type"),
         "controllers": ("Controllers", "controller")}
# Class of the stub -> heading of its table of keys.
PLAIN = {"BodyKeys": ["Bodies"], "FlexibleKeys": ["Flexible bodies", "Parts from files"], "InputKeys": ["Inputs"], "SimulationKeys": ["Simulation"]}
# What is more than Any.
VALUES = {("BodyKeys", "rigid"): "RigidKeys | Invariants", ("BodyKeys", "flexible"): "FlexibleKeys | Part | Body | str | bool",
          ("BodyKeys", "part"): "FlexibleKeys | Part | Body | str", ("FlexibleKeys", "material"): "Mapping[str, float] | Material",
          ("FlexibleKeys", "interfaces"): "Mapping[str, Place | Mapping[str, Any]]", ("FlexibleKeys", "markers"): "Mapping[str, Place | Mapping[str, Any]]",
          ("SimulationKeys", "step"): "Number", ("SimulationKeys", "duration"): "Number"}
CLASSES = {"constraints": "Constraints", "couplings": "Couplings", "forces": "Forces", "controllers": "Controllers", "joints": "Joints"}


def tables(text, heading):
    """The tables below a heading, up to the next of its level or above: lists of rows, which are lists of cells."""
    lines = text.splitlines()
    first = next(k for k, line in enumerate(lines) if re.fullmatch(rf"##+ {re.escape(heading)}", line))
    level = len(lines[first].split()[0])
    found, inside = [], False
    for line in lines[first + 1:]:
        if re.match(rf"#{{2,{level}}} ", line):
            break
        if line.startswith("| ") or line.startswith("|--"):
            if not inside:
                found.append([])
            inside = True
            if not line.startswith("|--"):
                found[-1].append([cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))])
        else:
            inside = False
    return found


def plain(cell):
    """The words of a cell without its links and quotes."""
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", cell).replace("`", "").replace("\\|", "|")


def names(cell):
    return re.findall(r"`([A-Za-z_][A-Za-z_0-9]*)`", cell)


def read(text):
    """Section -> {"types": {type: what it does}, "keys": {type: {key: [value, meaning, default]}}}."""
    out = {}
    for section, (heading, first) in TYPED.items():
        all_tables = tables(text, heading)
        types = next(t for t in all_tables if t[0][:2] == [first, "what it does"])
        keys = next(t for t in all_tables if t[0][:3] == [first, "key", "value"])
        entry = {"types": {names(row[0])[0]: plain(row[1]) for row in types[1:]}, "keys": {}}
        current = ""
        for row in keys[1:]:
            current = names(row[0])[0] if row[0] else current
            for key in names(row[1]):
                entry["keys"].setdefault(current, {})[key] = [plain(cell) for cell in row[2:5]]
            if row[2].startswith("body; and "):  # keys beside it that say where on the body
                entry["keys"][current] |= {key: ["", f"place on the {names(row[1])[0]}", ""] for key in names(row[2])}
        out[section] = {"types": entry["types"], "keys": {t: entry["keys"].get(t, {}) for t in entry["types"]}}
    joint = tables(text, "Joints")
    keys = {key: ["", plain(row[1]), ""] for row in joint[0][1:] for key in names(row[0]) if key != "type"}
    types = {names(row[0])[0]: plain(row[2]) for row in joint[1][1:]}
    out["joints"] = {"types": types, "keys": {t: keys for t in types}}
    return out


def plain_keys(text):
    """Class of the stub -> keys."""
    out = {}
    for name, headings in PLAIN.items():
        found = [next(t for t in tables(text, heading) if t[0][0] == "key") for heading in headings]
        out[name] = list(dict.fromkeys(key for table in found for row in table[1:] for key in names(row[0])))
    table = next(t for t in tables(text, "Outputs") if t[0][0] == "quantity")
    out["OutputKeys"] = list(dict.fromkeys(key for row in table[1:] for key in names(row[0])))
    components = [k for row in table[1:] for k in re.findall(r"`([a-z_0-9]+)`(?=:| \(|,|$)", row[3])]
    out["OutputKeys"] += [k for k in dict.fromkeys(components) if k not in out["OutputKeys"]]
    for key in ("relative_to", "in", "when", "of", "scale", "unit", "node", "at", "body"):
        if key not in out["OutputKeys"]:
            out["OutputKeys"].append(key)
    return out


def python_name(key):
    return key + "_" if keyword.iskeyword(key) else key


def annotation(value):
    if value == "true or false":
        return "bool | str"
    if re.match(r"a (positive |whole )*number|a number", value):
        return "Number"
    return "Any"


def stub(sections, plain_sections):
    lines = ['"""Builders of models, typed: written by scripts/write_python_keys.py from docs/model-file.md."""', "",
             "from collections.abc import Mapping", "from typing import Any, TypedDict", "", "from typing_extensions import Unpack", "",
             "from .bodies import Body, Invariants", "from .meshes import Material", "from .parts import Part", "from .places import Place", "from .sections import Section", "",
             "Number = float | str", '"""A number, or an expression as a text: "${2 * m}"."""', "",
             "class RigidKeys(TypedDict, total=False):", "    mass: Number", "    centre_of_mass: Any", "    inertia: Any", ""]
    for name, keys in plain_sections.items():
        lines.append(f"class {name}(TypedDict, total=False):")
        lines += [f"    {python_name(key)}: {VALUES.get((name, key), 'Any')}" for key in keys]
        lines.append("")
    for section, entry in sections.items():
        methods, whole = [], {}
        for kind, keys in entry["keys"].items():
            name = "".join(word.capitalize() for word in kind.split("_")) + {"joints": "Joint", "forces": "Force", "controllers": "Controller",
                                                                              "couplings": "Coupling", "constraints": "Constraint"}[section] + "Keys"
            lines.append(f"class {name}(TypedDict, total=False):")
            for key, (value, _, _) in {**keys, "when": ["true or false", "", ""]}.items():
                lines.append(f"    {python_name(key)}: {annotation(value)}")
                known = whole.setdefault(python_name(key), annotation(value))
                whole[python_name(key)] = known if known == annotation(value) else "Any"
            lines.append("")
            methods.append(f"    def {kind}(self, name: str, /, **keys: Unpack[{name}]) -> str: ...")
        title = CLASSES[section]
        lines += [f"class {title}Keys(TypedDict, total=False):", "    type: str"] + [f"    {k}: {v}" for k, v in whole.items() if k != "type"]
        lines += ["", f"class {title}(Section):",
                  f"    def add(self, name: str, value: Mapping[str, Any] | None = None, /, **values: Unpack[{title}Keys]) -> str: ...  # type: ignore[override]",
                  *methods, ""]
    for title, name in (("Bodies", "BodyKeys"), ("Inputs", "InputKeys"), ("Outputs", "OutputKeys")):
        lines += [f"class {title}(Section):",
                  f"    def add(self, name: str, value: Mapping[str, Any] | None = None, /, **values: Unpack[{name}]) -> str: ...  # type: ignore[override]", ""]
    lines += ["class SimulationSection(Section):",
              "    def update(self, other: Mapping[str, Any] = ..., /, **values: Unpack[SimulationKeys]) -> None: ...  # type: ignore[override]", "",
              ]
    return "\n".join(lines)


def main():
    text = (ROOT / "docs" / "model-file.md").read_text(encoding="utf-8")
    sections = read(text)
    content = {PACKAGE / "keys.json": json.dumps(sections, ensure_ascii=False, indent=0) + "\n",
               PACKAGE / "builders.pyi": stub(sections, plain_keys(text))}
    if "--check" in sys.argv[1:]:
        stale = [path.name for path, made in content.items() if not path.exists() or path.read_text(encoding="utf-8") != made]
        for name in stale:
            print(f"python/floatframe/{name}: found other keys than docs/model-file.md has; run scripts/write_python_keys.py")
        return 1 if stale else 0
    for path, made in content.items():
        path.write_text(made, encoding="utf-8")
    return 0


sys.exit(main())
