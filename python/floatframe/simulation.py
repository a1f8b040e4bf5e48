"""Models stepped by a program: controllers, co-simulation, learning."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, MutableMapping, Sequence
from typing import TYPE_CHECKING

from . import _core
from .arrays import texts
from .errors import InputError
from .model import Model, built
from .options import Array, Options, as_dict

if TYPE_CHECKING:
    from typing_extensions import Unpack


class Outputs(Mapping[str, float]):
    """Outputs at the end of the last step, by name; `array` has them all, shape (outputs,), as a copy."""

    __slots__ = ("_simulation",)

    def __init__(self, simulation: _core.Simulation) -> None:
        self._simulation = simulation

    def __getitem__(self, name: str) -> float:
        return self._simulation.output(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._simulation.output_names)

    def __len__(self) -> int:
        return len(self._simulation.output_names)

    @property
    def array(self) -> Array:
        return self._simulation.outputs_array()

    def __repr__(self) -> str:
        return f"Outputs({dict(self)})"


class Inputs(MutableMapping[str, float]):
    """Inputs by name: a value set applies from the next step on. `array` has them all, shape (inputs,), as a copy.

    Setting raises InputError for a value that is not finite or outside of the limits of the input.
    """

    __slots__ = ("_simulation",)

    def __init__(self, simulation: _core.Simulation) -> None:
        self._simulation = simulation

    def __getitem__(self, name: str) -> float:
        return self._simulation.input(name)

    def __setitem__(self, name: str, value: float) -> None:
        self._simulation.set_input(name, value)

    def __delitem__(self, name: str) -> None:
        raise InputError(f"the input '{name}' belongs to the model and cannot be deleted")

    def __iter__(self) -> Iterator[str]:
        return iter(self._simulation.input_names)

    def __len__(self) -> int:
        return len(self._simulation.input_names)

    @property
    def array(self) -> Array:
        return self._simulation.inputs_array()

    def __repr__(self) -> str:
        return f"Inputs({dict(self)})"


class Simulation(_core.Simulation):
    """A model one step at a time. `run` makes the same steps, bit for bit.

    >>> sim = ff.Simulation(model, step=1e-3)
    >>> while sim.time < 8.0:
    ...     sim.inputs["damper"] = 300.0
    ...     sim.step()
    ...     z = sim.outputs["chassis.z"]

    Options are those of `Options`. `time` is the end of the last step [s], `counters` the sums over all steps, `notes` reports
    on the start values. A simulation belongs to one thread at a time: calls from a second one while it steps raise
    RuntimeError, as do calls from its own callbacks. Steps leave other Python threads free. It cannot be copied or pickled; its
    saved states can.

    Raises InputError for invalid options, RunError if the start cannot be found.
    """

    def __init__(self, model: Model, **options: Unpack[Options]) -> None:
        super().__init__(built(model), as_dict(options))
        self._model = model

    @property
    def model(self) -> Model:
        """The simulated model."""
        return self._model

    @property
    def inputs(self) -> Inputs:
        """`sim.inputs["damper"] = 300.0`: held from the next step on."""
        return Inputs(self)

    @property
    def outputs(self) -> Outputs:
        """`sim.outputs["chassis.z"]`: at the end of the last step."""
        return Outputs(self)

    def on_step(self, function: Callable[[float, Array, Array], object] | None) -> None:
        """A sampled controller: `function(time, outputs, inputs)` is called at the beginning of every step: time [s], outputs at this time, shape
        (outputs,), and inputs, shape (inputs,), which it may change in place. They are held during the step. None removes it.
        Cost: 0.2 us per step, plus the function itself."""
        self.set_on_step(function)

    def law(self, input: str, function: Callable[..., float] | None, of: Sequence[str] = ()) -> None:
        """A sampled force law: the input is set to `function(time, *values)` at the beginning of every step, with the values of the
        outputs named in `of`. The input drives an actuator, a load or a target of the model. The value is held during the step:
        an error of first order, by which a stiff law gains energy. A force of the type `force_law` with a function as its `law` is
        evaluated in every iteration instead. None removes it. Cost: 0.35
        us per step, plus the function itself."""
        self.set_law(input, function, texts("of", of))

    def __repr__(self) -> str:
        return f"<floatframe.Simulation of '{self._model.name}' at {self.time:g} s>"

    def __reduce_ex__(self, protocol: object) -> str:
        raise TypeError("a simulation is not copied or pickled; save() gives a state that is")
