"""Floatframe: flexible multibody dynamics with the floating frame of reference formulation.

SI units, angles in radians, z up unless the model says otherwise, quaternions (w, x, y, z).

>>> import floatframe as ff
>>> model = ff.Model.load(ff.example("iltis"), speed=10)
>>> res = ff.run(model, step=0.01)
>>> res["chassis.z"], res.time
"""

from ._core import __version__
from .build import build_info, example, program
from .errors import Error, ErrorEntry, InputError, OutputError, RunError, StepError
from .model import Model
from .run import Result, run

__all__ = [
    "Error",
    "ErrorEntry",
    "InputError",
    "Model",
    "OutputError",
    "Result",
    "RunError",
    "StepError",
    "__version__",
    "build_info",
    "example",
    "program",
    "run",
]
