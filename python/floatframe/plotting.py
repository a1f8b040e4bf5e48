"""Plots of results by matplotlib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .run import Result


def plot(res: Result, names: Sequence[str] | str | None, axes: Any) -> Any:
    """See `Result.plot`."""
    if names is None:
        names = [name for name in res if name != "time"]
    elif isinstance(names, str):
        names = [names]
    groups = by_unit({name: res.units[name] for name in names if res[name] is not None})
    if axes is None:
        import matplotlib.pyplot as plt

        _, axes = plt.subplots(len(groups), 1, sharex=True, squeeze=False, figsize=(8, 1.2 + 2.2 * len(groups)), layout="constrained")
    axes = np.asarray(axes, dtype=object).ravel()
    if len(axes) not in (1, len(groups)):
        raise ValueError(f"axes: found {len(axes)}, expected 1 or {len(groups)}, one for each unit")
    for k, (unit, members) in enumerate(groups.items()):
        ax = axes[min(k, len(axes) - 1)]
        for name in members:
            ax.plot(res.time, res[name], label=name)
        ax.set_ylabel(f"[{unit}]" if unit else "")
        ax.grid(True, alpha=0.3)
        ax.legend(loc="best", fontsize="small")
    axes[-1].set_xlabel("time [s]")
    return axes


def by_unit(units: Mapping[str, str]) -> dict[str, list[str]]:
    """Names grouped by unit, in their order."""
    groups: dict[str, list[str]] = {}
    for name, unit in units.items():
        groups.setdefault(unit, []).append(name)
    return groups
