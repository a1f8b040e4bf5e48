"""Builders of models, typed: written by scripts/write_python_keys.py from docs/model-file.md."""

from collections.abc import Mapping
from typing import Any, TypedDict

from typing_extensions import Unpack

from .bodies import Body, Invariants
from .meshes import Material
from .parts import Part
from .places import Place
from .sections import Section

Number = float | str
"""A number, or an expression as a text: "${2 * m}"."""

class RigidKeys(TypedDict, total=False):
    mass: Number
    centre_of_mass: Any
    inertia: Any

class BodyKeys(TypedDict, total=False):
    position: Any
    orientation: Any
    rigid: RigidKeys | Invariants
    flexible: FlexibleKeys | Part | Body | str | bool
    part: FlexibleKeys | Part | Body | str
    align: Any
    align_tolerance: Any
    geometric_stiffening: Any
    geometry: Any
    use: Any
    when: Any

class FlexibleKeys(TypedDict, total=False):
    material: Mapping[str, float] | Material
    bars: Any
    masses: Any
    clamped: Any
    static_modes: Any
    path_shapes: Any
    normal_modes: Any
    analytic: Any
    basis: Any
    orthonormal: Any
    mass_model: Any
    section_inertia: Any
    damping: Any
    file: Any
    units: Any
    interfaces: Mapping[str, Place | Mapping[str, Any]]
    markers: Mapping[str, Place | Mapping[str, Any]]
    modes: Any
    fmax: Any
    effective_mass: Any
    method: Any
    reference: Any
    density: Any
    thickness: Any
    temperature: Any
    contact: Any
    integration: Any
    projection: Any
    stresses: Any
    free_check: Any
    solver: Any
    format: Any
    dialect: Any
    beam_shear: Any
    shell_shear: Any
    grounded_springs: Any
    mass_form: Any
    nodes: Any
    mass: Any
    dofs: Any
    damping_matrix: Any

class InputKeys(TypedDict, total=False):
    unit: Any
    initial: Any
    min: Any
    max: Any
    clamp: Any

class SimulationKeys(TypedDict, total=False):
    coordinates: Any
    inertia: Any
    geometric_stiffening: Any
    step: Number
    duration: Number
    output_interval: Any
    until: Any
    start: Any
    velocity: Any
    spectral_radius: Any
    tolerance: Any
    max_iterations: Any
    min_step: Any
    penalty: Any
    position_tolerance: Any
    velocity_tolerance: Any
    input: Any
    locate_edges: Any
    record: Any

class OutputKeys(TypedDict, total=False):
    position: Any
    velocity: Any
    acceleration: Any
    rotation: Any
    angular_velocity: Any
    joint_position: Any
    joint_velocity: Any
    modal_amplitude: Any
    force: Any
    length: Any
    rate: Any
    distance: Any
    joint_force: Any
    joint_torque: Any
    projection_impulse: Any
    rod_force: Any
    motion_force: Any
    motion_power: Any
    power: Any
    angular_acceleration: Any
    modal_rate: Any
    modal_acceleration: Any
    kinetic_energy: Any
    potential_energy: Any
    elastic_energy: Any
    stress: Any
    strain: Any
    section_force: Any
    coupling_force: Any
    travel: Any
    travel_rate: Any
    controller: Any
    quaternion: Any
    distance_rate: Any
    elastic_displacement: Any
    elastic_rotation: Any
    centre_of_mass: Any
    momentum: Any
    angular_momentum: Any
    state: Any
    formula: Any
    first_crossing: Any
    axis: Any
    relative_to: Any
    in_: Any
    angle: Any
    coordinate: Any
    mode: Any
    output: Any
    about: Any
    component: Any
    direction: Any
    number: Any
    when: Any
    of: Any
    scale: Any
    unit: Any
    node: Any
    at: Any
    body: Any

class InLineConstraintKeys(TypedDict, total=False):
    from_: Any
    to: Any
    axis: Any
    when: bool | str

class InPlaneConstraintKeys(TypedDict, total=False):
    from_: Any
    to: Any
    axis: Any
    when: bool | str

class ParallelConstraintKeys(TypedDict, total=False):
    from_: Any
    to: Any
    axis: Any
    when: bool | str

class PerpendicularConstraintKeys(TypedDict, total=False):
    from_: Any
    to: Any
    axis: Any
    axis_2: Any
    when: bool | str

class ConstantVelocityConstraintKeys(TypedDict, total=False):
    from_: Any
    to: Any
    axis: Any
    axis_2: Any
    slides: bool | str
    when: bool | str

class PointOnCurveConstraintKeys(TypedDict, total=False):
    from_: Any
    to: Any
    points: Any
    x: Any
    y: Any
    z: Any
    range: Any
    closed: bool | str
    when: bool | str

class CurveOnCurveConstraintKeys(TypedDict, total=False):
    from_: Any
    to: Any
    axis: Any
    points: Any
    x: Any
    y: Any
    z: Any
    range: Any
    closed: bool | str
    points_2: Any
    x_2: Any
    y_2: Any
    z_2: Any
    range_2: Any
    closed_2: bool | str
    when: bool | str

class SlideAlongConstraintKeys(TypedDict, total=False):
    from_: Any
    to: Any
    points: Any
    motion: Any
    when: bool | str

class ConstraintsKeys(TypedDict, total=False):
    type: str
    from_: Any
    to: Any
    axis: Any
    when: bool | str
    axis_2: Any
    slides: bool | str
    points: Any
    x: Any
    y: Any
    z: Any
    range: Any
    closed: bool | str
    points_2: Any
    x_2: Any
    y_2: Any
    z_2: Any
    range_2: Any
    closed_2: bool | str
    motion: Any

class Constraints(Section):
    def add(self, name: str, value: Mapping[str, Any] | None = None, /, **values: Unpack[ConstraintsKeys]) -> str: ...  # type: ignore[override]
    def in_line(self, name: str, /, **keys: Unpack[InLineConstraintKeys]) -> str: ...
    def in_plane(self, name: str, /, **keys: Unpack[InPlaneConstraintKeys]) -> str: ...
    def parallel(self, name: str, /, **keys: Unpack[ParallelConstraintKeys]) -> str: ...
    def perpendicular(self, name: str, /, **keys: Unpack[PerpendicularConstraintKeys]) -> str: ...
    def constant_velocity(self, name: str, /, **keys: Unpack[ConstantVelocityConstraintKeys]) -> str: ...
    def point_on_curve(self, name: str, /, **keys: Unpack[PointOnCurveConstraintKeys]) -> str: ...
    def curve_on_curve(self, name: str, /, **keys: Unpack[CurveOnCurveConstraintKeys]) -> str: ...
    def slide_along(self, name: str, /, **keys: Unpack[SlideAlongConstraintKeys]) -> str: ...

class CouplingCouplingKeys(TypedDict, total=False):
    terms: Any
    value: Any
    when: bool | str

class GearCouplingKeys(TypedDict, total=False):
    driver: Any
    driven: Any
    ratio: Number
    teeth: Any
    internal: bool | str
    pressure_angle: Any
    helix_angle: Any
    flank: Any
    mesh_stiffness: Number
    mesh_damping: Number
    backlash: Number
    when: bool | str

class BevelGearCouplingKeys(TypedDict, total=False):
    driver: Any
    driven: Any
    ratio: Number
    teeth: Any
    same_sense: bool | str
    when: bool | str

class PlanetaryCouplingKeys(TypedDict, total=False):
    sun: Any
    ring: Any
    carrier: Any
    teeth: Any
    when: bool | str

class DifferentialCouplingKeys(TypedDict, total=False):
    left: Any
    right: Any
    cage: Any
    when: bool | str

class RackAndPinionCouplingKeys(TypedDict, total=False):
    rack: Any
    pinion: Any
    radius: Number
    reversed: bool | str
    when: bool | str

class ScrewCouplingKeys(TypedDict, total=False):
    joint: Any
    translation: Any
    rotation: Any
    lead: Number
    when: bool | str

class BeltCouplingKeys(TypedDict, total=False):
    driver: Any
    driven: Any
    radii: Any
    crossed: bool | str
    stiffness: Number
    damping: Number
    when: bool | str

class MimicCouplingKeys(TypedDict, total=False):
    joint: Any
    follows: Any
    factor: Number
    offset: Number
    when: bool | str

class CamCouplingKeys(TypedDict, total=False):
    follower: Any
    cam: Any
    segments: Any
    law: Any
    points: Any
    formula: Any
    phase: Number
    when: bool | str

class CouplingsKeys(TypedDict, total=False):
    type: str
    terms: Any
    value: Any
    when: bool | str
    driver: Any
    driven: Any
    ratio: Number
    teeth: Any
    internal: bool | str
    pressure_angle: Any
    helix_angle: Any
    flank: Any
    mesh_stiffness: Number
    mesh_damping: Number
    backlash: Number
    same_sense: bool | str
    sun: Any
    ring: Any
    carrier: Any
    left: Any
    right: Any
    cage: Any
    rack: Any
    pinion: Any
    radius: Number
    reversed: bool | str
    joint: Any
    translation: Any
    rotation: Any
    lead: Number
    radii: Any
    crossed: bool | str
    stiffness: Number
    damping: Number
    follows: Any
    factor: Number
    offset: Number
    follower: Any
    cam: Any
    segments: Any
    law: Any
    points: Any
    formula: Any
    phase: Number

class Couplings(Section):
    def add(self, name: str, value: Mapping[str, Any] | None = None, /, **values: Unpack[CouplingsKeys]) -> str: ...  # type: ignore[override]
    def coupling(self, name: str, /, **keys: Unpack[CouplingCouplingKeys]) -> str: ...
    def gear(self, name: str, /, **keys: Unpack[GearCouplingKeys]) -> str: ...
    def bevel_gear(self, name: str, /, **keys: Unpack[BevelGearCouplingKeys]) -> str: ...
    def planetary(self, name: str, /, **keys: Unpack[PlanetaryCouplingKeys]) -> str: ...
    def differential(self, name: str, /, **keys: Unpack[DifferentialCouplingKeys]) -> str: ...
    def rack_and_pinion(self, name: str, /, **keys: Unpack[RackAndPinionCouplingKeys]) -> str: ...
    def screw(self, name: str, /, **keys: Unpack[ScrewCouplingKeys]) -> str: ...
    def belt(self, name: str, /, **keys: Unpack[BeltCouplingKeys]) -> str: ...
    def mimic(self, name: str, /, **keys: Unpack[MimicCouplingKeys]) -> str: ...
    def cam(self, name: str, /, **keys: Unpack[CamCouplingKeys]) -> str: ...

class SpringDamperForceKeys(TypedDict, total=False):
    from_: Any
    to: Any
    spring: Any
    damper: Any
    bump_stop: Any
    rebound_stop: Any
    actuator: Any
    target: Any
    target_rate: Any
    when: bool | str

class GuidedSpringForceKeys(TypedDict, total=False):
    reference: Any
    tip: Any
    axis: Any
    spring: Any
    damper: Any
    bump_stop: Any
    rebound_stop: Any
    actuator: Any
    when: bool | str

class JointSpringForceKeys(TypedDict, total=False):
    joint: Any
    spring: Any
    damper: Any
    actuator: Any
    target: Any
    target_rate: Any
    when: bool | str

class TyreForceKeys(TypedDict, total=False):
    body: Any
    at: Any
    node: Any
    radius: Number
    stiffness: Number
    damping: Number
    law: Any
    axis: Any
    road: Any
    when: bool | str

class BushingForceKeys(TypedDict, total=False):
    from_: Any
    to: Any
    axis: Any
    axis_2: Any
    spring_x: Any
    spring_y: Any
    spring_z: Any
    spring_rx: Any
    spring_ry: Any
    spring_rz: Any
    damper_x: Any
    damper_y: Any
    damper_z: Any
    damper_rx: Any
    damper_ry: Any
    damper_rz: Any
    rotation_rate: Any
    when: bool | str

class ForceForceKeys(TypedDict, total=False):
    body: Any
    at: Any
    node: Any
    direction: Any
    magnitude: Any
    follows: bool | str
    when: bool | str

class TorqueForceKeys(TypedDict, total=False):
    body: Any
    at: Any
    node: Any
    direction: Any
    magnitude: Any
    follows: bool | str
    when: bool | str

class MaxwellForceKeys(TypedDict, total=False):
    from_: Any
    to: Any
    branches: Any
    when: bool | str

class BristleFrictionForceKeys(TypedDict, total=False):
    joint: Any
    coordinate: Any
    breakaway: Number
    kinetic: Number
    stribeck: Number
    stiffness: Number
    damping: Number
    viscous: Number
    elastic: Number
    normal: Any
    preload: Number
    radius: Number
    reaction: bool | str
    bearing_radius: Number
    axial_radius: Number
    bearing_length: Number
    when: bool | str

class UnilateralSpringForceKeys(TypedDict, total=False):
    from_: Any
    to: Any
    length: Number
    stiffness: Number
    exponent: Number
    restitution: Number
    least_speed: Number
    when: bool | str

class BearingForceKeys(TypedDict, total=False):
    from_: Any
    to: Any
    axis: Any
    axis_2: Any
    stiffness: Any
    damping: Any
    speed_table: Any
    when: bool | str

class ForceLawForceKeys(TypedDict, total=False):
    from_: Any
    to: Any
    joint: Any
    law: Any
    when: bool | str

class JointStopForceKeys(TypedDict, total=False):
    joint: Any
    coordinate: Any
    lower: Number
    upper: Number
    stiffness: Number
    exponent: Number
    restitution: Number
    least_speed: Number
    when: bool | str

class JournalBearingForceKeys(TypedDict, total=False):
    from_: Any
    to: Any
    axis: Any
    radius: Number
    clearance: Number
    stiffness: Number
    exponent: Number
    restitution: Number
    least_speed: Number
    friction: Number
    kinetic: Number
    stribeck: Number
    deflection: Number
    bristle_damping: Number
    elastic: Number
    when: bool | str

class LinearTyreForceKeys(TypedDict, total=False):
    body: Any
    at: Any
    node: Any
    axis: Any
    road: Any
    lift: Any
    radius: Number
    stiffness: Number
    slip_stiffness: Number
    cornering_stiffness: Number
    camber_stiffness: Number
    nominal_load: Number
    trail: Number
    friction: Number
    relaxation_x: Number
    relaxation_y: Number
    rolling_resistance: Number
    spinning: bool | str
    side: Any
    contact: Any
    patch_length: Number
    patch_width: Number
    damping: Number
    relaxation: bool | str
    rest_damping: Number
    damping_speed: Number
    when: bool | str

class MagicFormulaTyreForceKeys(TypedDict, total=False):
    body: Any
    at: Any
    node: Any
    axis: Any
    road: Any
    lift: Any
    file: Any
    form: Any
    pressure: Number
    limits: bool | str
    friction: Number
    stiffness_factor: Number
    spinning: bool | str
    side: Any
    contact: Any
    patch_length: Number
    patch_width: Number
    damping: Number
    relaxation: bool | str
    rest_damping: Number
    damping_speed: Number
    when: bool | str

class TmeasyTyreForceKeys(TypedDict, total=False):
    body: Any
    at: Any
    node: Any
    axis: Any
    road: Any
    lift: Any
    radius: Number
    nominal_load: Number
    max_load: Number
    stiffness: Any
    longitudinal: Any
    lateral: Any
    trail: Any
    longitudinal_stiffness: Number
    lateral_stiffness: Number
    rolling_radius: Number
    friction: Number
    normalised: bool | str
    rolling_resistance: Number
    spinning: bool | str
    side: Any
    contact: Any
    patch_length: Number
    patch_width: Number
    damping: Number
    relaxation: bool | str
    rest_damping: Number
    damping_speed: Number
    when: bool | str

class CalspanTyreForceKeys(TypedDict, total=False):
    body: Any
    at: Any
    node: Any
    axis: Any
    road: Any
    lift: Any
    radius: Number
    stiffness: Number
    cornering: Any
    camber: Any
    friction: Any
    aligning: Any
    load_limit: Number
    skid_number: Number
    relaxation_y: Number
    spinning: bool | str
    side: Any
    contact: Any
    patch_length: Number
    patch_width: Number
    damping: Number
    relaxation: bool | str
    rest_damping: Number
    damping_speed: Number
    when: bool | str

class AerodynamicLoadForceKeys(TypedDict, total=False):
    body: Any
    at: Any
    node: Any
    axis: Any
    axis_2: Any
    area: Number
    drag: Number
    side: Number
    lift: Number
    density: Number
    wind: Any
    wind_direction: Any
    when: bool | str

class ForcesKeys(TypedDict, total=False):
    type: str
    from_: Any
    to: Any
    spring: Any
    damper: Any
    bump_stop: Any
    rebound_stop: Any
    actuator: Any
    target: Any
    target_rate: Any
    when: bool | str
    reference: Any
    tip: Any
    axis: Any
    joint: Any
    body: Any
    at: Any
    node: Any
    radius: Number
    stiffness: Any
    damping: Any
    law: Any
    road: Any
    axis_2: Any
    spring_x: Any
    spring_y: Any
    spring_z: Any
    spring_rx: Any
    spring_ry: Any
    spring_rz: Any
    damper_x: Any
    damper_y: Any
    damper_z: Any
    damper_rx: Any
    damper_ry: Any
    damper_rz: Any
    rotation_rate: Any
    direction: Any
    magnitude: Any
    follows: bool | str
    branches: Any
    coordinate: Any
    breakaway: Number
    kinetic: Number
    stribeck: Number
    viscous: Number
    elastic: Number
    normal: Any
    preload: Number
    reaction: bool | str
    bearing_radius: Number
    axial_radius: Number
    bearing_length: Number
    length: Number
    exponent: Number
    restitution: Number
    least_speed: Number
    speed_table: Any
    lower: Number
    upper: Number
    clearance: Number
    friction: Any
    deflection: Number
    bristle_damping: Number
    lift: Any
    slip_stiffness: Number
    cornering_stiffness: Number
    camber_stiffness: Number
    nominal_load: Number
    trail: Any
    relaxation_x: Number
    relaxation_y: Number
    rolling_resistance: Number
    spinning: bool | str
    side: Any
    contact: Any
    patch_length: Number
    patch_width: Number
    relaxation: bool | str
    rest_damping: Number
    damping_speed: Number
    file: Any
    form: Any
    pressure: Number
    limits: bool | str
    stiffness_factor: Number
    max_load: Number
    longitudinal: Any
    lateral: Any
    longitudinal_stiffness: Number
    lateral_stiffness: Number
    rolling_radius: Number
    normalised: bool | str
    cornering: Any
    camber: Any
    aligning: Any
    load_limit: Number
    skid_number: Number
    area: Number
    drag: Number
    density: Number
    wind: Any
    wind_direction: Any

class Forces(Section):
    def add(self, name: str, value: Mapping[str, Any] | None = None, /, **values: Unpack[ForcesKeys]) -> str: ...  # type: ignore[override]
    def spring_damper(self, name: str, /, **keys: Unpack[SpringDamperForceKeys]) -> str: ...
    def guided_spring(self, name: str, /, **keys: Unpack[GuidedSpringForceKeys]) -> str: ...
    def joint_spring(self, name: str, /, **keys: Unpack[JointSpringForceKeys]) -> str: ...
    def tyre(self, name: str, /, **keys: Unpack[TyreForceKeys]) -> str: ...
    def bushing(self, name: str, /, **keys: Unpack[BushingForceKeys]) -> str: ...
    def force(self, name: str, /, **keys: Unpack[ForceForceKeys]) -> str: ...
    def torque(self, name: str, /, **keys: Unpack[TorqueForceKeys]) -> str: ...
    def maxwell(self, name: str, /, **keys: Unpack[MaxwellForceKeys]) -> str: ...
    def bristle_friction(self, name: str, /, **keys: Unpack[BristleFrictionForceKeys]) -> str: ...
    def unilateral_spring(self, name: str, /, **keys: Unpack[UnilateralSpringForceKeys]) -> str: ...
    def bearing(self, name: str, /, **keys: Unpack[BearingForceKeys]) -> str: ...
    def force_law(self, name: str, /, **keys: Unpack[ForceLawForceKeys]) -> str: ...
    def joint_stop(self, name: str, /, **keys: Unpack[JointStopForceKeys]) -> str: ...
    def journal_bearing(self, name: str, /, **keys: Unpack[JournalBearingForceKeys]) -> str: ...
    def linear_tyre(self, name: str, /, **keys: Unpack[LinearTyreForceKeys]) -> str: ...
    def magic_formula_tyre(self, name: str, /, **keys: Unpack[MagicFormulaTyreForceKeys]) -> str: ...
    def tmeasy_tyre(self, name: str, /, **keys: Unpack[TmeasyTyreForceKeys]) -> str: ...
    def calspan_tyre(self, name: str, /, **keys: Unpack[CalspanTyreForceKeys]) -> str: ...
    def aerodynamic_load(self, name: str, /, **keys: Unpack[AerodynamicLoadForceKeys]) -> str: ...

class PidControllerKeys(TypedDict, total=False):
    measured: Any
    target: Any
    rate: Any
    proportional: Number
    integral: Number
    derivative: Number
    filter: Number
    lower: Number
    upper: Number
    unwind: Number
    period: Number
    offset: Number
    delay: Number
    when: bool | str

class FormulaControllerKeys(TypedDict, total=False):
    formula: Any
    when: bool | str

class TransferFunctionControllerKeys(TypedDict, total=False):
    input: Any
    numerator: Any
    denominator: Any
    initial: Any
    period: Number
    offset: Number
    delay: Number
    when: bool | str

class StateSpaceControllerKeys(TypedDict, total=False):
    file: Any
    inputs: Any
    A: Any
    B: Any
    C: Any
    D: Any
    outputs: Any
    initial: Any
    period: Number
    offset: Number
    delay: Number
    when: bool | str

class IntegratorControllerKeys(TypedDict, total=False):
    input: Any
    initial: Number
    lower: Number
    upper: Number
    unwind: Number
    when: bool | str

class FilterControllerKeys(TypedDict, total=False):
    input: Any
    time: Number
    frequency: Number
    damping: Number
    initial: Any
    when: bool | str

class LimiterControllerKeys(TypedDict, total=False):
    input: Any
    lower: Number
    upper: Number
    when: bool | str

class RateLimiterControllerKeys(TypedDict, total=False):
    input: Any
    rising: Number
    falling: Number
    time: Number
    when: bool | str

class HysteresisControllerKeys(TypedDict, total=False):
    input: Any
    lower: Number
    upper: Number
    below: Number
    above: Number
    initial: Any
    when: bool | str

class ZeroOrderHoldControllerKeys(TypedDict, total=False):
    input: Any
    initial: Number
    period: Number
    offset: Number
    delay: Number
    when: bool | str

class DelayControllerKeys(TypedDict, total=False):
    input: Any
    time: Number
    pade: Number
    when: bool | str

class PathFollowerControllerKeys(TypedDict, total=False):
    x: Any
    y: Any
    vx: Any
    vy: Any
    yaw_rate: Any
    points: Any
    circle: Any
    closed: bool | str
    wheelbase: Number
    course_gain: Number
    offset_gain: Number
    preview: Number
    yaw_gain: Number
    integral_time: Number
    largest_angle: Number
    when: bool | str

class SpeedControllerControllerKeys(TypedDict, total=False):
    measured: Any
    target: Any
    mass: Number
    proportional: Number
    integral: Number
    lower: Number
    upper: Number
    when: bool | str

class ControllersKeys(TypedDict, total=False):
    type: str
    measured: Any
    target: Any
    rate: Any
    proportional: Number
    integral: Number
    derivative: Number
    filter: Number
    lower: Number
    upper: Number
    unwind: Number
    period: Number
    offset: Number
    delay: Number
    when: bool | str
    formula: Any
    input: Any
    numerator: Any
    denominator: Any
    initial: Any
    file: Any
    inputs: Any
    A: Any
    B: Any
    C: Any
    D: Any
    outputs: Any
    time: Number
    frequency: Number
    damping: Number
    rising: Number
    falling: Number
    below: Number
    above: Number
    pade: Number
    x: Any
    y: Any
    vx: Any
    vy: Any
    yaw_rate: Any
    points: Any
    circle: Any
    closed: bool | str
    wheelbase: Number
    course_gain: Number
    offset_gain: Number
    preview: Number
    yaw_gain: Number
    integral_time: Number
    largest_angle: Number
    mass: Number

class Controllers(Section):
    def add(self, name: str, value: Mapping[str, Any] | None = None, /, **values: Unpack[ControllersKeys]) -> str: ...  # type: ignore[override]
    def pid(self, name: str, /, **keys: Unpack[PidControllerKeys]) -> str: ...
    def formula(self, name: str, /, **keys: Unpack[FormulaControllerKeys]) -> str: ...
    def transfer_function(self, name: str, /, **keys: Unpack[TransferFunctionControllerKeys]) -> str: ...
    def state_space(self, name: str, /, **keys: Unpack[StateSpaceControllerKeys]) -> str: ...
    def integrator(self, name: str, /, **keys: Unpack[IntegratorControllerKeys]) -> str: ...
    def filter(self, name: str, /, **keys: Unpack[FilterControllerKeys]) -> str: ...
    def limiter(self, name: str, /, **keys: Unpack[LimiterControllerKeys]) -> str: ...
    def rate_limiter(self, name: str, /, **keys: Unpack[RateLimiterControllerKeys]) -> str: ...
    def hysteresis(self, name: str, /, **keys: Unpack[HysteresisControllerKeys]) -> str: ...
    def zero_order_hold(self, name: str, /, **keys: Unpack[ZeroOrderHoldControllerKeys]) -> str: ...
    def delay(self, name: str, /, **keys: Unpack[DelayControllerKeys]) -> str: ...
    def path_follower(self, name: str, /, **keys: Unpack[PathFollowerControllerKeys]) -> str: ...
    def speed_controller(self, name: str, /, **keys: Unpack[SpeedControllerControllerKeys]) -> str: ...

class WeldJointKeys(TypedDict, total=False):
    parent: Any
    child: Any
    at: Any
    parent_node: Any
    child_node: Any
    axis: Any
    axis_2: Any
    position: Any
    velocity: Any
    keep: Any
    motion: Any
    stops: Any
    friction: Any
    cut: Any
    when: bool | str

class RevoluteJointKeys(TypedDict, total=False):
    parent: Any
    child: Any
    at: Any
    parent_node: Any
    child_node: Any
    axis: Any
    axis_2: Any
    position: Any
    velocity: Any
    keep: Any
    motion: Any
    stops: Any
    friction: Any
    cut: Any
    when: bool | str

class PrismaticJointKeys(TypedDict, total=False):
    parent: Any
    child: Any
    at: Any
    parent_node: Any
    child_node: Any
    axis: Any
    axis_2: Any
    position: Any
    velocity: Any
    keep: Any
    motion: Any
    stops: Any
    friction: Any
    cut: Any
    when: bool | str

class CylindricalJointKeys(TypedDict, total=False):
    parent: Any
    child: Any
    at: Any
    parent_node: Any
    child_node: Any
    axis: Any
    axis_2: Any
    position: Any
    velocity: Any
    keep: Any
    motion: Any
    stops: Any
    friction: Any
    cut: Any
    when: bool | str

class UniversalJointKeys(TypedDict, total=False):
    parent: Any
    child: Any
    at: Any
    parent_node: Any
    child_node: Any
    axis: Any
    axis_2: Any
    position: Any
    velocity: Any
    keep: Any
    motion: Any
    stops: Any
    friction: Any
    cut: Any
    when: bool | str

class SphericalJointKeys(TypedDict, total=False):
    parent: Any
    child: Any
    at: Any
    parent_node: Any
    child_node: Any
    axis: Any
    axis_2: Any
    position: Any
    velocity: Any
    keep: Any
    motion: Any
    stops: Any
    friction: Any
    cut: Any
    when: bool | str

class PlanarJointKeys(TypedDict, total=False):
    parent: Any
    child: Any
    at: Any
    parent_node: Any
    child_node: Any
    axis: Any
    axis_2: Any
    position: Any
    velocity: Any
    keep: Any
    motion: Any
    stops: Any
    friction: Any
    cut: Any
    when: bool | str

class FreeJointKeys(TypedDict, total=False):
    parent: Any
    child: Any
    at: Any
    parent_node: Any
    child_node: Any
    axis: Any
    axis_2: Any
    position: Any
    velocity: Any
    keep: Any
    motion: Any
    stops: Any
    friction: Any
    cut: Any
    when: bool | str

class JointsKeys(TypedDict, total=False):
    type: str
    parent: Any
    child: Any
    at: Any
    parent_node: Any
    child_node: Any
    axis: Any
    axis_2: Any
    position: Any
    velocity: Any
    keep: Any
    motion: Any
    stops: Any
    friction: Any
    cut: Any
    when: bool | str

class Joints(Section):
    def add(self, name: str, value: Mapping[str, Any] | None = None, /, **values: Unpack[JointsKeys]) -> str: ...  # type: ignore[override]
    def weld(self, name: str, /, **keys: Unpack[WeldJointKeys]) -> str: ...
    def revolute(self, name: str, /, **keys: Unpack[RevoluteJointKeys]) -> str: ...
    def prismatic(self, name: str, /, **keys: Unpack[PrismaticJointKeys]) -> str: ...
    def cylindrical(self, name: str, /, **keys: Unpack[CylindricalJointKeys]) -> str: ...
    def universal(self, name: str, /, **keys: Unpack[UniversalJointKeys]) -> str: ...
    def spherical(self, name: str, /, **keys: Unpack[SphericalJointKeys]) -> str: ...
    def planar(self, name: str, /, **keys: Unpack[PlanarJointKeys]) -> str: ...
    def free(self, name: str, /, **keys: Unpack[FreeJointKeys]) -> str: ...

class Bodies(Section):
    def add(self, name: str, value: Mapping[str, Any] | None = None, /, **values: Unpack[BodyKeys]) -> str: ...  # type: ignore[override]

class Inputs(Section):
    def add(self, name: str, value: Mapping[str, Any] | None = None, /, **values: Unpack[InputKeys]) -> str: ...  # type: ignore[override]

class Outputs(Section):
    def add(self, name: str, value: Mapping[str, Any] | None = None, /, **values: Unpack[OutputKeys]) -> str: ...  # type: ignore[override]

class SimulationSection(Section):
    def update(self, other: Mapping[str, Any] = ..., /, **values: Unpack[SimulationKeys]) -> None: ...  # type: ignore[override]
