"""Floatframe: flexible multibody dynamics with the floating frame of reference formulation.

SI units, angles in radians, z up unless the model says otherwise, quaternions (w, x, y, z).

>>> import floatframe as ff
>>> model = ff.Model.load(ff.example("iltis"), speed=10)
>>> res = ff.run(model, step=0.01)
>>> res["chassis.z"], res.time
"""

from ._core import SimulationState, State, StepReport, version
from .analyses import (
    advise,
    campbell,
    check,
    frequency_response,
    linear_inputs,
    linear_model,
    linear_system,
    linearize,
    mass_properties,
    model_order,
    modes,
    road_response,
    statics,
)
from .build import build_info, example, program
from .errors import Error, ErrorEntry, InputError, OutputError, RunError, StepError
from .model import Model
from .options import Options
from .run import Result, run
from .simulation import Simulation
from .study import sweep

__version__ = version()

__all__ = [
    "Error",
    "ErrorEntry",
    "InputError",
    "Model",
    "Options",
    "OutputError",
    "Result",
    "RunError",
    "Simulation",
    "SimulationState",
    "State",
    "StepError",
    "StepReport",
    "__version__",
    "advise",
    "build_info",
    "campbell",
    "check",
    "example",
    "frequency_response",
    "linear_inputs",
    "linear_model",
    "linear_system",
    "linearize",
    "mass_properties",
    "model_order",
    "modes",
    "program",
    "road_response",
    "run",
    "statics",
    "sweep",
    "version",
]
