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
from .bodies import Body, Invariants, Node, Projection
from .build import build_info, example, program
from .errors import Error, ErrorEntry, InputError, OutputError, RunError, RunWarning, StepError, UnknownNameError
from .fmu import FmuReport, export_fmu
from .health import Report
from .meshes import BeamSection, Material, Mesh
from .model import Model
from .options import Options
from .parts import FileInfo, Part, convert, info, read_body, reduce
from .places import Place, cylinder, nearest, node, nodes, plane, set_, sphere
from .roads import Road
from .run import Result, run
from .simulation import Recording, Simulation
from .states import StateName
from .study import sweep

__version__ = version()

set = set_  # not in __all__: a star would hide that of Python

__all__ = [
    "BeamSection",
    "Body",
    "Error",
    "ErrorEntry",
    "FileInfo",
    "FmuReport",
    "InputError",
    "Invariants",
    "Material",
    "Mesh",
    "Model",
    "Node",
    "Options",
    "OutputError",
    "Part",
    "Place",
    "Projection",
    "Recording",
    "Report",
    "Result",
    "Road",
    "RunError",
    "RunWarning",
    "Simulation",
    "SimulationState",
    "State",
    "StateName",
    "StepError",
    "StepReport",
    "UnknownNameError",
    "__version__",
    "advise",
    "build_info",
    "campbell",
    "check",
    "convert",
    "cylinder",
    "example",
    "export_fmu",
    "frequency_response",
    "info",
    "linear_inputs",
    "linear_model",
    "linear_system",
    "linearize",
    "mass_properties",
    "model_order",
    "modes",
    "nearest",
    "node",
    "nodes",
    "plane",
    "program",
    "read_body",
    "reduce",
    "road_response",
    "run",
    "sphere",
    "statics",
    "sweep",
    "version",
]
