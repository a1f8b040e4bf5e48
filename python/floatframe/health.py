"""The health report of a reduction: figures to check before using a reduced body. SI units."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np

from .arrays import Array


@dataclass(frozen=True, eq=False)
class MassProperties:
    mass: float
    """[kg]"""
    centre: Array
    """Centre of mass, shape (3,) [m]."""
    J_origin: Array
    """Inertia tensor about the origin of the body frame, shape (3, 3) [kg m2]."""


@dataclass(frozen=True, eq=False)
class InterfaceHealth:
    name: str
    kind: str
    """"rigid", "mean" or "node"."""
    nodes: int
    p: Array
    """Reference point, shape (3,) [m]."""
    condition: float
    """Condition of the node geometry: largest over smallest singular value of their rigid motions, scaled by their size."""
    static_error: float
    """Largest displacement error under its six unit loads, relative to the largest displacement."""


@dataclass(frozen=True, eq=False)
class ModeHealth:
    name: str
    frequency: float
    """[Hz]"""
    effective_mass: Array
    """Fractions of mass and inertia in x y z rx ry rz, shape (6,)."""
    kept: bool


@dataclass(frozen=True)
class FrequencyPair:
    full: float
    """Frequency of the full model [Hz]; nan if not computed."""
    reduced: float
    """[Hz]"""

    @property
    def relative_error(self) -> float:
        return self.reduced / self.full - 1.0 if self.full > 0.0 else 0.0


class Report:
    """The report printed by `floatframe reduce`; `print(report)` gives the same tables."""

    nodes: int
    elements: int
    dofs: int
    modes: int
    volume: float
    volume_times_density: float
    rigid_residual: float
    modal_mass_condition: float
    rotary_inertia: bool | None
    static_support: str
    solver: str
    notes: list[str]
    warnings: list[str]
    """Warnings, one sentence each."""

    def __init__(self, text: str, content: str) -> None:
        d: dict[str, Any] = json.loads(content)
        self._text = text
        self.nodes = d["nodes"]
        self.elements = d["elements"]
        self.dofs = d["degrees_of_freedom"]
        self.modes = d["modes"]
        self.volume = _number(d["volume_m3"])
        self.volume_times_density = _number(d["volume_times_density_kg"])
        self.rigid_residual = _number(d["rigid_residual"])
        self.modal_mass_condition = _number(d["modal_mass_condition"])
        self.rotary_inertia = d.get("rotary_inertia")
        self.static_support = d["static_support"]
        self.solver = d["solver"]
        self.notes = d["notes"]
        self.warnings = d["warnings"]
        self.from_elements = _mass(d["from_elements"])
        """From the mass matrix of the elements."""
        self.from_invariants = _mass(d["from_invariants"])
        """From the integrals of the reduced body."""
        eigenvalues = d.get("rigid_eigenvalues")
        self.rigid_eigenvalues = None if eigenvalues is None else _array(eigenvalues)
        """Six lowest of the free body relative to the first elastic one, shape (6,)."""
        self.normal_modes = [
            ModeHealth(m["name"], _number(m["frequency_Hz"]), _array(m["effective_mass_fraction"]), m["kept"])
            for m in d["normal_modes"]
        ]
        self.free_frequencies = [FrequencyPair(_number(p["full_Hz"]), _number(p["reduced_Hz"])) for p in d["free_frequencies"]]
        self.interfaces = [
            InterfaceHealth(
                i["name"], i["kind"], i["nodes"], _array(i["position_m"]), _number(i["condition"]), _number(i["static_error"])
            )
            for i in d["interfaces"]
        ]
        self.seconds: dict[str, float] = {s["stage"]: s["seconds"] for s in d["seconds"]}
        """Duration of each stage."""

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return (
            f"<floatframe.Report: {self.nodes} nodes, {self.dofs} degrees of freedom -> {self.modes} modes, "
            f"{self.from_invariants.mass:.6g} kg, {len(self.warnings)} warnings>"
        )

    def _repr_html_(self) -> str:
        a, b = self.from_elements, self.from_invariants
        mass = [["mass [kg]", f"{a.mass:.6g}", f"{b.mass:.6g}"]]
        mass += [[f"centre of mass {'xyz'[k]} [m]", f"{a.centre[k]:.6g}", f"{b.centre[k]:.6g}"] for k in range(3)]
        modes = [
            [m.name, f"{m.frequency:.3f}", *(f"{100 * x:.1f}" for x in m.effective_mass), "yes" if m.kept else "no"]
            for m in self.normal_modes
        ]
        pairs = [
            [str(k), _hertz(p.full), _hertz(p.reduced), f"{100 * p.relative_error:+.4f}" if p.full > 0 else "-"]
            for k, p in enumerate(self.free_frequencies, 1)
        ]
        places = [
            [i.name, i.kind, str(i.nodes), ", ".join(f"{x:.4g}" for x in i.p), f"{i.static_error:.2g}"] for i in self.interfaces
        ]
        warnings = "".join(f"<li>{escape(w)}</li>" for w in self.warnings)
        return "".join(
            [
                f"<p><b>{self.nodes} nodes, {self.elements} elements, {self.dofs} degrees of freedom &rarr; {self.modes} modes</b></p>",
                f"<p>Warnings:</p><ul>{warnings}</ul>" if warnings else "<p>No warnings.</p>",
                _table("Mass properties", ["", "elements", "reduced"], mass),
                _table("Interfaces", ["interface", "kind", "nodes", "place [m]", "static error"], places),
                _table(
                    "Normal modes, effective mass [% of mass and inertia]",
                    ["mode", "[Hz]", "x", "y", "z", "rx", "ry", "rz", "kept"],
                    modes,
                ),
                _table("Free frequencies, reduced against full", ["mode", "full [Hz]", "reduced [Hz]", "error [%]"], pairs),
            ]
        )


def _number(x: float | None) -> float:
    return math.nan if x is None else float(x)


def _array(values: Any) -> Array:
    return np.array(values, dtype=float)


def _mass(d: dict[str, Any]) -> MassProperties:
    return MassProperties(_number(d["mass_kg"]), _array(d["centre_m"]), _array(d["inertia_about_origin_kgm2"]))


def _hertz(f: float) -> str:
    return f"{f:.3f}" if f > 0.0 else "-"


def _table(title: str, head: list[str], rows: list[list[str]]) -> str:
    if not rows:
        return ""
    lines = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><caption>{escape(title)}</caption><tr>{''.join(f'<th>{escape(h)}</th>' for h in head)}</tr>{lines}</table>"
