"""Bodies for the equations of motion: inertia integrals, modal stiffness, and mass matrix and velocity forces of a moving body
by both methods. Arrays share the memory of the C++ library, keep it alive and are read-only."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from .arrays import Array, Whole, number, numbers
from .errors import InputError
from .meshes import BeamSection, Material, fe_model
from .options import Coordinates, Inertia

if TYPE_CHECKING:
    from .meshes import AnyMesh

Matrix3 = tuple[Array, Array, Array]


class Invariants:
    """The 16 integrals of a body (paper (19), (22)-(24)) over its mass, X: mode shapes, r_u: undeformed positions.

    m: int dm [kg]. m_u: int r_u dm, shape (3,) [kg m]. P_u: int r_ui r_uj dm, shape (3, 3) [kg m2]. S: int X dm, shape
    (3, modes). Si[i]: int r_ui X dm, shape (3, modes). Sij[i][j]: int X_i^T X_j dm, shape (modes, modes).

    `Invariants(m, m_u, P_u, S, Si, Sij)` accepts integrals from other sources, Si with the shape (3, 3, modes) and Sij with (3,
    3, modes, modes); without modes S, Si and Sij are omitted.
    """

    __slots__ = ("_core", "__weakref__")

    def __init__(
        self,
        m: float,
        m_u: npt.ArrayLike,
        P_u: npt.ArrayLike,
        S: npt.ArrayLike | None = None,
        Si: npt.ArrayLike | None = None,
        Sij: npt.ArrayLike | None = None,
    ) -> None:
        if [S is None, Si is None, Sij is None].count(True) in (1, 2):
            raise InputError("Invariants: expected S, Si and Sij, or none of them for a rigid body")
        S = numbers("S", np.zeros((3, 0)) if S is None else S, 3, "modes")
        nm = S.shape[1]
        Si = numbers("Si", np.zeros((3, 3, 0)) if Si is None else Si, 3, 3, nm)
        Sij = numbers("Sij", np.zeros((3, 3, 0, 0)) if Sij is None else Sij, 3, 3, nm, nm)
        mass = number("m", m, positive=True)
        self._core = _core.make_invariants(mass, numbers("m_u", m_u, 3), numbers("P_u", P_u, 3, 3), S, Si, Sij)

    @classmethod
    def _of(cls, core: _core.Invariants) -> Invariants:
        self = cls.__new__(cls)
        self._core = core
        return self

    @classmethod
    def rigid(cls, mass: float, centre: npt.ArrayLike, inertia: npt.ArrayLike) -> Invariants:
        """For a rigid body: mass [kg], centre of mass, shape (3,) [m], inertia tensor about it, shape (3, 3) [kg m2]."""
        J = numbers("inertia", inertia, 3, 3)
        return cls._of(_core.rigid_invariants(number("mass", mass, positive=True), numbers("centre", centre, 3), J))

    @classmethod
    def of_mesh(
        cls,
        mesh: AnyMesh,
        X: npt.ArrayLike,
        *,
        material: Material,
        thickness: float | None = None,
        section: BeamSection | None = None,
    ) -> Invariants:
        """Integrals of the elements of a mesh in SI units, any modes, shape (nodes, 3, modes): exact for linear elements."""
        return cls._of(_core.invariants_of_mesh(fe_model(mesh, material, thickness, section), _shapes(X)))

    @property
    def m(self) -> float:
        """Mass [kg]."""
        return self._core.m

    @property
    def m_u(self) -> Array:
        """int r_u dm, shape (3,) [kg m]."""
        return self._core.m_u

    @property
    def P_u(self) -> Array:
        """int r_ui r_uj dm, shape (3, 3) [kg m2]."""
        return self._core.P_u

    @property
    def S(self) -> Array:
        """int X dm, shape (3, modes)."""
        return self._core.S

    @property
    def Si(self) -> Matrix3:
        """Si[i] = int r_ui X dm, shape (3, modes) each."""
        return self._core.Si

    @property
    def Sij(self) -> tuple[Matrix3, Matrix3, Matrix3]:
        """Sij[i][j] = int X_i^T X_j dm, shape (modes, modes) each."""
        return self._core.Sij

    @property
    def modes(self) -> int:
        """Number of modes."""
        return self._core.modes

    @property
    def centre_of_mass(self) -> Array:
        """Centre of mass of the undeformed body, shape (3,) [m]."""
        return self._core.centre_of_mass

    @property
    def inertia_about_origin(self) -> Array:
        """Inertia tensor of the undeformed body about the origin of the body frame, shape (3, 3) [kg m2]."""
        return self._core.inertia_about_origin

    @property
    def inertia_about_centre(self) -> Array:
        """Inertia tensor of the undeformed body about its centre of mass, shape (3, 3) [kg m2]."""
        return self._core.inertia_about_centre

    def __copy__(self) -> Invariants:
        return self

    def __deepcopy__(self, memo: object) -> Invariants:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return Invariants, (self.m, np.array(self.m_u), np.array(self.P_u), np.array(self.S), np.array(self.Si), np.array(self.Sij))

    def __repr__(self) -> str:
        return f"<floatframe.Invariants: {self.m:.6g} kg, {self.modes} modes>"


def _shapes(X: npt.ArrayLike) -> Array:
    return numbers("X", X, "nodes", 3, "modes")


class Projection:
    """Nodes, their modes and their mass matrix: the data of the projection method.

    p: positions, shape (nodes, 3) [m]. X: modal translations, shape (nodes, 3, modes). M_s: scalar mass matrix of the
    elements, shape (nodes, nodes) [kg], symmetric; a sparse matrix of scipy or an array.
    """

    __slots__ = ("_core", "__weakref__")

    def __init__(self, p: npt.ArrayLike, X: npt.ArrayLike, M_s: Any) -> None:
        points = numbers("p", p, "nodes", 3)
        if hasattr(M_s, "tocoo"):
            entries = M_s.tocoo()
            rows, columns, values = entries.row, entries.col, numbers("M_s", entries.data, "entries")
            if M_s.shape != (len(points), len(points)):
                raise InputError(f"M_s: found the shape {M_s.shape}, expected ({len(points)}, {len(points)})")
        else:
            dense = numbers("M_s", M_s, len(points), len(points))
            rows, columns = np.nonzero(dense)
            values = dense[rows, columns]
        ends = np.ascontiguousarray(rows, dtype=np.int64), np.ascontiguousarray(columns, dtype=np.int64)
        self._core = _core.make_projection(points, _shapes(X), *ends, values)

    @classmethod
    def _of(cls, core: _core.Projection) -> Projection:
        self = cls.__new__(cls)
        self._core = core
        return self

    @classmethod
    def of_mesh(
        cls,
        mesh: AnyMesh,
        X: npt.ArrayLike,
        *,
        material: Material,
        thickness: float | None = None,
        section: BeamSection | None = None,
    ) -> Projection:
        """Projection data of the elements of a mesh in SI units with any modes, shape (nodes, 3, modes)."""
        return cls._of(_core.projection_of_mesh(fe_model(mesh, material, thickness, section), _shapes(X)))

    @property
    def p(self) -> Array:
        """Positions, shape (nodes, 3) [m]."""
        return self._core.p

    @property
    def X(self) -> Array:
        """Modal translations, shape (nodes, 3, modes)."""
        return self._core.X

    @property
    def mass_rows(self) -> tuple[Array, npt.NDArray[np.int32], npt.NDArray[np.int32]]:
        """The mass matrix in the form accepted by scipy: `scipy.sparse.csr_array(projection.mass_rows)`: values [kg], columns,
        row offsets. One row per node; for bodies whose nodes have rotations six rows per node (ux uy uz rx ry rz)."""
        return self._core.mass_rows

    def invariants(self) -> Invariants:
        """The 16 integrals of these nodes. Not available for bodies whose nodes have rotations."""
        return Invariants._of(_core.invariants_of_projection(self._core))

    def __copy__(self) -> Projection:
        return self

    def __deepcopy__(self, memo: object) -> Projection:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        if self._core.six_dof:
            raise InputError("a projection whose nodes have rotations is pickled with its part")
        return _projection_again, (np.array(self.p), np.array(self.X), *(np.array(a) for a in self.mass_rows))


class Node(NamedTuple):
    """An interface or marker of a body."""

    p: Array
    """Undeformed position, shape (3,) [m]."""
    X: Array
    """Translation per modal amplitude, shape (3, modes)."""
    X_theta: Array
    """Rotation per modal amplitude, shape (3, modes) [rad]."""


class Body:
    """A rigid or flexible body. The body of a reduced part is `part.body`.

    `Body(invariants, K=, D=, projection=)`: from given integrals, with modal stiffness and damping, shape (modes, modes);
    `projection` enables the projection method. Integrals that no physical body can have raise InputError.
    """

    __slots__ = ("_core", "_part", "_frequencies", "__weakref__")
    _frequencies: Array

    def __init__(
        self,
        invariants: Invariants,
        *,
        K: npt.ArrayLike | None = None,
        D: npt.ArrayLike | None = None,
        projection: Projection | None = None,
    ) -> None:
        if not isinstance(invariants, Invariants):
            raise InputError(f"invariants: found {type(invariants).__name__}, expected floatframe.Invariants")
        if projection is not None and not isinstance(projection, Projection):
            raise InputError(f"projection: found {type(projection).__name__}, expected floatframe.Projection")
        nm = invariants.modes
        self._core = _core.make_body(
            invariants._core,
            None if K is None else numbers("K", K, nm, nm),
            None if D is None else numbers("D", D, nm, nm),
            None if projection is None else projection._core,
        )
        self._part: object = None

    @classmethod
    def _of(cls, core: _core.Body, part: object) -> Body:
        self = cls.__new__(cls)
        self._core = core
        self._part = part
        return self

    @property
    def invariants(self) -> Invariants:
        """The 16 integrals."""
        return Invariants._of(self._core.invariants)

    @property
    def projection(self) -> Projection | None:
        """Nodes and mass matrix, if the body has them (`ff.reduce(..., projection=True)`)."""
        core = self._core.projection
        return None if core is None else Projection._of(core)

    @property
    def K(self) -> Array:
        """Modal stiffness, shape (modes, modes)."""
        return self._core.K

    @property
    def D(self) -> Array:
        """Modal damping, shape (modes, modes)."""
        return self._core.D

    def damped_modes(self, reference: Literal["frame", "free", "mounted"] = "free") -> Array:
        """Frequencies [Hz] and fractions of critical damping, shape (n, 2), of the body's own modes: with its frame fixed,
        free, or mounted, i.e. with its interfaces fixed (empty if these are unknown)."""
        return np.array(self._core.damped_modes(reference), dtype=float).reshape(-1, 2)

    @property
    def modes(self) -> int:
        """Number of modes; 0: rigid."""
        return self._core.modes

    @property
    def mode_names(self) -> list[str]:
        return self._core.mode_names

    @property
    def mass_model(self) -> str:
        """Mass formulation of the elements: "isoparametric", "six_dof" or "hermite"."""
        return self._core.mass_model

    @property
    def frequencies(self) -> Array:
        """Frequency of each mode alone, sqrt(K_kk / M_kk) / 2 pi, shape (modes,) [Hz]."""
        try:
            return self._frequencies
        except AttributeError:
            self._frequencies = self._core.frequencies
            return self._frequencies

    @property
    def nodes(self) -> Mapping[str, Node]:
        """Interfaces, then markers, by name."""
        return MappingProxyType({name: Node(p, X, X_theta) for name, p, X, X_theta in self._core.nodes})

    def inertia(
        self,
        A: npt.ArrayLike,
        y: npt.ArrayLike,
        omega: npt.ArrayLike,
        ydot: npt.ArrayLike,
        *,
        r0: npt.ArrayLike = (0.0, 0.0, 0.0),
        method: Inertia = "preprocessing",
        coordinates: Coordinates = "relative",
        geometric_stiffening: bool = False,
    ) -> tuple[Array, Array]:
        """Mass matrix M and velocity-dependent forces Qv, as computed by a formulation in each step.

        A: orientation, columns are the body axes in the world, shape (3, 3). y, ydot: modal amplitudes and their rates,
        shape (modes,). omega: angular velocity, world, shape (3,) [rad/s]. r0: origin of the body frame, world, shape (3,) [m];
        only "relative" depends on it. method: "preprocessing" or "projection" (needs `projection`). coordinates:

        "relative": velocities (sdot, omega, ydot), sdot that of the point of the body in the world's origin. M has the shape
        (6 + modes, 6 + modes), Qv (6 + modes,). "absolute": velocities (r0dot, udot, vdot, wdot, ydot) with A = [u v w]. M has the
        shape (12 + modes, 12 + modes), Qv (12 + modes,).
        """
        R = numbers("A", A, 3, 3)
        if np.abs(R.T @ R - np.eye(3)).max() > 1e-6 or np.linalg.det(R) < 0.0:
            raise InputError("A: found a matrix that is no rotation, expected orthonormal, right-handed columns")
        if not isinstance(geometric_stiffening, bool):
            raise InputError(f"geometric_stiffening: found {geometric_stiffening!r}, expected True or False")
        return self._core.inertia(
            R,
            numbers("y", y, self.modes),
            numbers("omega", omega, 3),
            numbers("ydot", ydot, self.modes),
            numbers("r0", r0, 3),
            _word("method", method, ("preprocessing", "projection")),
            _word("coordinates", coordinates, ("relative", "absolute")),
            geometric_stiffening,
        )

    def __copy__(self) -> Body:
        return self

    def __deepcopy__(self, memo: object) -> Body:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        if self._part is None:
            return _rebuilt, (self.invariants, np.array(self.K), np.array(self.D), self.projection)
        return getattr, (self._part, "body")

    def __repr__(self) -> str:
        return f"<floatframe.Body: {self.invariants.m:.6g} kg, {self.modes} modes>"


def _projection_again(p: Array, X: Array, values: Array, columns: Whole, starts: Whole) -> Projection:
    rows = np.repeat(np.arange(len(p), dtype=np.int64), np.diff(starts))
    return Projection._of(_core.make_projection(p, X, rows, columns.astype(np.int64), values))


def _rebuilt(invariants: Invariants, K: Array, D: Array, projection: Projection | None) -> Body:
    return Body(invariants, K=K if K.any() else None, D=D if D.any() else None, projection=projection)


def _word(name: str, value: object, words: tuple[str, ...]) -> str:
    if value not in words:
        raise InputError(f"{name}: found {value!r}, expected one of {', '.join(words)}")
    return str(value)
