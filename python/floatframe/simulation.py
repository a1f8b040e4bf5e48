"""Models stepped by a program: controllers, co-simulation, learning."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, MutableMapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core
from .arrays import texts, whole
from .errors import InputError, worded
from .model import Model, built
from .options import Array, Options, as_dict
from .run import Controller, Result, settings_of
from .states import StateName, Values, given

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


class Recording:
    """What `sim.record()` has recorded so far: `result()` is that of a run of the same steps. It ends with `stop()`, with the next
    `record()`, or at the end of a `with` block."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._result: Result | None = None

    def result(self) -> Result:
        """Samples, summary, states and state of the steps up to now, as of a run: `save`, `view`, `to_pyvista` go on from there.
        The simulation may go on."""
        if self._result is not None:
            return self._result
        if self._simulation._recording is not self:
            raise InputError("found a recording that has ended, expected the last one of the simulation")
        model = self._simulation.model
        return Result(self._simulation.recorded(built(model), model.file, settings_of(model)), model)

    def stop(self) -> Result:
        """Ends the recording. Returns its result."""
        if self._simulation._recording is self:
            self._result = self.result()
            self._simulation._recording = None
            self._simulation.begin_recording(None, 0)
        return self.result()

    def __len__(self) -> int:
        """Number of recorded instants."""
        return self._simulation.instants if self._result is None else len(self._result.table)

    def __enter__(self) -> Recording:
        return self

    def __exit__(self, *_: object) -> None:
        if self._simulation._recording is self:
            self.stop()

    def __repr__(self) -> str:
        return f"<floatframe.Recording of '{self._simulation.model.name}': {len(self)} instants>"


class Simulation(_core.Simulation):
    """A model one step at a time. `run` makes the same steps, bit for bit.

    >>> sim = ff.Simulation(model, step=1e-3)
    >>> while sim.time < 8.0:
    ...     sim.inputs["damper"] = 300.0
    ...     sim.step()
    ...     z = sim.outputs["chassis.z"]

    It watches the range of the method and the energy as a run does; each limit that is exceeded is told once as a warning
    (`ff.RunWarning`), within the next quarter of the steps, and `warnings` has all of them at any time. watch=False: it does not.

    Options are those of `Options`. `time` is the end of the last step [s], `counters` the sums over all steps, `notes` reports
    on the start values. A simulation belongs to one thread at a time: calls from a second one while it steps raise
    RuntimeError, as do calls from its own callbacks. Steps leave other Python threads free. It cannot be copied or pickled; its
    saved states can.

    Raises InputError for invalid options, RunError if the start cannot be found.
    """

    def __init__(self, model: Model, *, watch: bool = True, **options: Unpack[Options]) -> None:
        super().__init__(built(model), as_dict(options), bool(watch))
        self._model = model
        self._recording: Recording | None = None
        self._states: list[StateName] | None = None

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

    @property
    def warnings(self) -> list[str]:
        """How the motion has left the range of the method so far: the sentences that a run has in its summary."""
        return [worded(sentence) for _, sentence in self.warning_list()]

    def record(self, every: int = 1, keep: int | None = None) -> Recording:
        """Records outputs and states at the present instant and at every `every`-th step from now on; `keep`: only the last so
        many instants, in memory that does not grow. What was recorded before is dropped. A state that is restored or set drops the
        instants after its time, another model drops all.

        >>> recording = sim.record(every=10)
        >>> ...
        >>> recording.result().save("out")
        """
        count = 0 if keep is None else whole("keep", keep, 1, 10**9)
        self.begin_recording(whole("every", every, 1, 10**9), count)
        self._recording = Recording(self)
        return self._recording

    def set(self, q: Values | None = None, v: Values | None = None) -> None:
        """Sets coordinates (`q`) and their rates (`v`) at the present time, by the names of joints, or of flexible bodies for the
        amplitudes of their modes: a number, or a list of all coordinates [m, rad, m/s, rad/s]. What is given is met, and all else
        changes as little as the loops need; states of elements and inputs stay. It takes as long as a start; `reset()` and
        `restore()` take less than a step.

        >>> sim.set(q={"crank": 0.5}, v={"crank": 10.0})

        Raises InputError for an unknown name and RunError, with the remaining gap, if the loops do not close with these values.
        Nothing is changed then.
        """
        joints, bodies = self._model.core.joints, self._model.core.bodies
        self.set_state(given("q", q, False, joints, bodies) + given("v", v, True, joints, bodies))

    def change(self, model: Model | None = None, /, **parameters: Any) -> None:
        """From the next step on the model is another one of the same structure: `model`, or the present one with other values of
        its parameters. The state, inputs and options stay; it need not be the equilibrium of the new numbers. `reset()` returns to
        the start of the first model. Raises InputError, and changes nothing, if the structure is another one."""
        if (model is None) == (not parameters):
            raise InputError("change: expected a model, or values of parameters")
        changed = model if model is not None else self._model.with_parameters(**parameters)
        self.change_model(built(changed))
        self._model = changed

    def linear_model(self, inputs: Sequence[str] | None = None, outputs: Sequence[str] | None = None) -> _core.LinearModel:
        """The linear system at the present state, with the inputs as they are, in changes from there: its `states` are
        `StateName`s, and `x` has their present values in the same order. `control.ss(*lm)` takes it.

        inputs: None for those of the model, or all (with prescribed motions and roads) if it has none. outputs: None for all. The
        coordinates are relative ones, whatever the simulation steps in.
        """
        ports = texts("inputs", inputs if inputs is not None else list(self.inputs)), texts("outputs", outputs or ())
        model = self.linear(*ports)
        self._states = [StateName(*state) for state in model.states]
        return model

    @property
    def states(self) -> list[StateName]:
        """The states of the last `linear_model()`; of one made now if there is none."""
        if self._states is None:
            self.linear_model()
        return list(self._states or [])

    @property
    def x(self) -> Array:
        """The present values of `states`, shape (states,), also within `on_step`. Of a joint with a rotation vector they are its
        components, which differ from changes of the linear system by second order of the rotation."""
        return self.values(self.states)

    def values(self, states: Sequence[StateName]) -> Array:
        """The present values of numbers of the state by their names, shape (states,); of derivatives of inputs zeros, as the
        simulation has them."""
        known = iter(self.state_values([name for name in states if name[0] != "input"]))
        return np.array([0.0 if name[0] == "input" else next(known) for name in states])

    def on_step(self, function: Controller | None, period: float | None = None) -> None:
        """A sampled controller: `function(time, outputs, inputs)` is called at the beginning of every step: time [s], outputs at
        this time, shape (outputs,), and inputs, shape (inputs,). It changes the inputs in place or returns a map of their names and
        values; any other result but None raises InputError. They are held from then on. period [s]: the time from one call to the
        next. None as the function removes it. Cost: 0.2 us per step, plus the function itself."""
        self.set_on_step(function, period)

    def law(self, input: str, function: Callable[..., float] | None, of: Sequence[str] = ()) -> None:
        """A sampled force law: the input is set to `function(time, *values)` at the beginning of every step, with the values of the
        outputs named in `of`. The input drives an actuator, a load or a target of the model. The value is held during the step:
        an error of first order, by which a stiff law gains energy. A force of the type `force_law` with a function as its `law` is
        evaluated in every iteration instead. None removes it. Cost: 0.35
        us per step, plus the function itself."""
        self.set_law(input, function, texts("of", of))

    def __repr__(self) -> str:
        try:
            found = [limit for limit, _ in self.warning_list()]
        except RuntimeError:  # it steps
            return f"<floatframe.Simulation of '{self._model.name}'>"
        said = f", {len(found)} warning{'s' if len(found) > 1 else ''}: {', '.join(found)}" if found else ""
        return f"<floatframe.Simulation of '{self._model.name}' at {self.time:g} s{said}>"

    def __reduce_ex__(self, protocol: object) -> str:
        raise TypeError("a simulation is not copied or pickled; save() gives a state that is")
