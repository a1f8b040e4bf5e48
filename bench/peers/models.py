"""Data of the models of the race, and the same as model files of Floatframe.

Chain: N steel links of 1 m with a square section of 20 mm, hung from the ground and from each other by hinges about y,
level, straight and at rest when they are released under gravity along -z.
"""
import numpy as np

GRAVITY = 9.81                                   # [m/s2]
LENGTH, SIDE = 1.0, 0.02                         # [m] of a link
YOUNG, POISSON, DENSITY = 2.0e11, 0.3, 7500.0    # steel [Pa], [-], [kg/m3]
MASS = DENSITY * LENGTH * SIDE**2                # [kg] of a link
ALONG = 20                                       # brick elements of 20 nodes along a link, one across
NORMAL_MODES = 2                                 # in addition to the six static modes of the far end

# Rigid link: a solid box, about its centre of mass [kg m2].
LINK_INERTIA = (MASS * SIDE**2 / 6, MASS * (LENGTH**2 + SIDE**2) / 12, MASS * (LENGTH**2 + SIDE**2) / 12)

CORNERS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1),
                    (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])
# Nodes 9 to 20 are the midpoints of these edges: the order of Abaqus and CalculiX (C3D20).
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
LOCAL = np.vstack([CORNERS, [(CORNERS[a] + CORNERS[b]) // 2 for a, b in EDGES]])


def link_mesh(along=ALONG):
    """Node coordinates [m] (n x 3) and bricks of 20 nodes (zero-based) of one link, x from 0 to 1 m."""
    numbers, positions, bricks = {}, [], []
    for e in range(along):
        brick = []
        for corner in LOCAL:
            key = (2 * e + 1 + corner[0], *corner[1:])
            if key not in numbers:
                numbers[key] = len(positions)
                positions.append((LENGTH * key[0] / (2 * along), SIDE / 2 * key[1], SIDE / 2 * key[2]))
            brick.append(numbers[key])
        bricks.append(brick)
    return np.array(positions), np.array(bricks)


def faces(positions):
    """Nodes of the two end faces."""
    return [np.flatnonzero(np.abs(positions[:, 0] - x) < 1e-9).tolist() for x in (0.0, LENGTH)]


def write_deck(file):
    """The mesh as a deck that Floatframe reads [m, kg, s]."""
    positions, bricks = link_mesh()
    lines = ["*NODE"] + [f"{i + 1}, " + ", ".join(repr(float(x)) for x in p) for i, p in enumerate(positions)]
    lines.append("*ELEMENT, TYPE=C3D20, ELSET=LINK")
    for i, brick in enumerate(bricks):
        numbers = [str(n + 1) for n in brick]
        lines += [f"{i + 1}, " + ", ".join(numbers[:15]) + ",", ", ".join(numbers[15:])]
    for name, nodes in zip(("START", "END"), faces(positions)):
        lines += [f"*NSET, NSET={name}", ", ".join(str(n + 1) for n in nodes)]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{YOUNG!r}, {POISSON!r}", "*DENSITY", repr(DENSITY),
              "*SOLID SECTION, ELSET=LINK, MATERIAL=STEEL", ""]
    file.write_text("\n".join(lines))


def shapes(point):
    """Serendipity shape functions of the brick of 20 nodes and their local derivatives (20, 3 x 20)."""
    n, d = np.empty(20), np.empty((3, 20))
    for i, corner in enumerate(LOCAL):
        a = 1.0 + corner * point
        if i < 8:
            s = corner @ point - 2.0
            n[i] = a.prod() * s / 8
            for k in range(3):
                others = a[(k + 1) % 3] * a[(k + 2) % 3]
                d[k, i] = corner[k] * others * (s + a[k]) / 8
        else:
            k = int(np.flatnonzero(corner == 0)[0])
            u, v = (k + 1) % 3, (k + 2) % 3
            bubble = 1.0 - point[k]**2
            n[i] = bubble * a[u] * a[v] / 4
            d[k, i] = -2.0 * point[k] * a[u] * a[v] / 4
            d[u, i] = bubble * corner[u] * a[v] / 4
            d[v, i] = bubble * a[u] * corner[v] / 4
    return n, d


def link_matrices():
    """Mass and stiffness of the mesh (sparse); three displacements per node, 3 x 3 x 3 Gauss points: exact here."""
    from scipy.sparse import coo_matrix
    positions, bricks = link_mesh()
    half = np.array([LENGTH / ALONG, SIDE, SIDE]) / 2
    lame = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    shear = YOUNG / (2 * (1 + POISSON))
    material = np.diag([2 * shear] * 3 + [shear] * 3)
    material[:3, :3] += lame
    mass, stiffness = np.zeros((60, 60)), np.zeros((60, 60))
    points, weights = np.polynomial.legendre.leggauss(3)
    for i in np.ndindex(3, 3, 3):
        n, d = shapes(points[list(i)])
        gradient = d / half[:, None]
        strain = np.zeros((6, 60))
        for k in range(3):
            strain[k, k::3] = gradient[k]
        for row, (j, k) in enumerate(((1, 2), (0, 2), (0, 1)), start=3):
            strain[row, j::3], strain[row, k::3] = gradient[k], gradient[j]
        volume = weights[list(i)].prod() * half.prod()
        stiffness += volume * strain.T @ material @ strain
        mass += volume * DENSITY * np.kron(np.outer(n, n), np.eye(3))
    rows = (3 * bricks[:, :, None] + np.arange(3)).reshape(len(bricks), 60)
    index = (np.repeat(rows, 60, axis=1).ravel(), np.tile(rows, (1, 60)).ravel())
    size = (3 * len(positions),) * 2
    return [coo_matrix((np.tile(m.ravel(), len(bricks)), index), shape=size).tocsr() for m in (mass, stiffness)]


def chain_yaml(links, flexible):
    """A chain as a model file of Floatframe; flexible: 'brick' (the mesh), 'bar' (beams of the program) or None."""
    lines = ["floatframe: 1", f"gravity: [0, 0, -{GRAVITY}]", "parameters: {step: 0.001, duration: 1, tolerance: 1e-9}",
             "points:"]
    lines += [f"  p{i}: [{i * LENGTH}, 0, 0]" for i in range(links + 1)] + ["bodies:"]
    for i in range(links):
        lines += [f"  link_{i + 1}:"]
        if flexible == "brick":
            lines += [f"    position: p{i}", "    flexible:", "      file: link.inp", "      units: m-kg-s",
                      "      interfaces: {START: {set: START}, END: {set: END}}",
                      f"      modes: {NORMAL_MODES}", "      reference: {node: START}", "      stresses: false"]
        elif flexible == "bar":
            lines += ["    flexible:",
                      f"      material: {{young: {YOUNG}, poisson: {POISSON}, density: {DENSITY}}}".replace("e+", "e"),
                      f"      bars: {{bar: {{from: p{i}, to: p{i + 1}, elements: 40, "
                      f"section: {{rectangle: [{SIDE}, {SIDE}]}}}}}}", f"      clamped: [p{i}]",
                      f"      static_modes: [{{point: p{i + 1}, dofs: [x, y, z, rx, ry, rz]}}]",
                      f"      normal_modes: {NORMAL_MODES}"]
        else:
            inertia = ", ".join(f"{x:.17g}" for x in LINK_INERTIA)
            lines += [f"    rigid: {{mass: {MASS!r}, centre_of_mass: [{(i + 0.5) * LENGTH}, 0, 0], inertia: [{inertia}]}}"]
    lines.append("joints:")
    for i in range(links):
        at = f"parent: {'ground' if i == 0 else f'link_{i}'}, child: link_{i + 1}, at: p{i}"
        if flexible == "brick":
            at = f"child: link_{i + 1}, child_node: START" + (f", parent: link_{i}, parent_node: END" if i else "")
        lines.append(f"  hinge_{i + 1}: {{type: revolute, {at}, axis: y}}")
    place = "node: END" if flexible == "brick" else f"at: p{links}"
    lines += ["outputs:", f"  tip: {{position: {{body: link_{links}, {place}}}}}",
              "simulation: {step: '${step}', duration: '${duration}', tolerance: '${tolerance}'}"]
    return "\n".join(lines).replace("'${", "${").replace("}'", "}") + "\n"


def chain_mjcf(links, step):
    """The rigid chain for MuJoCo: joint coordinates, no contacts, no damping."""
    body = ""
    for i in reversed(range(links)):
        inertia = " ".join(repr(x) for x in LINK_INERTIA)
        site = f'<site name="tip" pos="{LENGTH} 0 0"/>' if i == links - 1 else ""
        body = (f'<body pos="{LENGTH if i else 0} 0 0"><joint type="hinge" axis="0 1 0"/>'
                f'<inertial pos="{LENGTH / 2} 0 0" mass="{MASS!r}" diaginertia="{inertia}"/>{site}{body}</body>')
    return (f'<mujoco><option gravity="0 0 -{GRAVITY}" timestep="{step!r}" integrator="RK4">'
            f'<flag contact="disable" constraint="disable"/></option><worldbody>{body}</worldbody></mujoco>')


# Vehicle on a rig: a chassis, four arms on hinges along x, four wheels on axles along y. Each wheel is held by three springs
# with dampers to the ground in the place of a tyre: below, to the side, ahead (1 m, free length as drawn).
CORNERS_OF_CAR = {"fl": (1.2, 1), "fr": (1.2, -1), "rl": (-1.2, 1), "rr": (-1.2, -1)}    # x [m], side
CHASSIS = {"mass": 1200.0, "height": 0.6, "inertia": (200.0, 1500.0, 1600.0)}
ARM = {"mass": 12.0, "inner": 0.3, "outer": 0.75, "height": 0.5, "inertia": (0.25, 0.05, 0.28)}
WHEEL = {"mass": 20.0, "inertia": (0.6, 1.1, 0.6), "spin": 10.0}
STRUT = {"stiffness": 6e4, "damping": 2000.0, "free": 0.615, "y": 0.5, "z": 1.0}         # wheel centre to chassis
HOLD = {"below": (1.5e5, 500.0, 0.5217), "side": (5e4, 500.0, 1.0), "ahead": (5e4, 500.0, 1.0)}
PUSH = (1.0, 0.0, 0.0, 0.3, 0.2, 0.1)            # velocity and angular velocity of the chassis at the start


def anchors(x, side):
    """Ground points of the springs of one wheel."""
    y, z = side * ARM["outer"], ARM["height"]
    return {"below": (x, y, 0.0), "side": (x, y + side, z), "ahead": (x + 1.0, y, z)}


def vehicle_yaml():
    def rigid(part, *centre):
        return f"{{rigid: {{mass: {part['mass']}, centre_of_mass: {list(centre)}, inertia: {list(part['inertia'])}}}}}"

    def spring(start, end, stiffness, damping, free):
        return (f"{{type: spring_damper, from: {{body: {start[0]}, at: {list(start[1])}}}, to: {{body: {end[0]}, "
                f"at: {list(end[1])}}}, spring: {{linear: {{stiffness: {stiffness:.1f}, free: {free}}}}}, damper: {damping}}}")

    z, h = ARM["height"], CHASSIS["height"]
    bodies, joints, forces = [f"  chassis: {rigid(CHASSIS, 0, 0, h)}"], [
        f"  chassis: {{type: free, child: chassis, at: [0, 0, {h}], velocity: {list(PUSH)}}}"], []
    for name, (x, side) in CORNERS_OF_CAR.items():
        hub = (x, side * ARM["outer"], z)
        bodies += [f"  arm_{name}: {rigid(ARM, x, side * (ARM['inner'] + ARM['outer']) / 2, z)}",
                   f"  wheel_{name}: {rigid(WHEEL, *hub)}"]
        joints += [f"  hinge_{name}: {{type: revolute, parent: chassis, child: arm_{name}, "
                   f"at: [{x}, {side * ARM['inner']}, {z}], axis: x}}",
                   f"  axle_{name}: {{type: revolute, parent: arm_{name}, child: wheel_{name}, at: {list(hub)}, axis: y, "
                   f"velocity: {WHEEL['spin']}}}"]
        forces.append(f"  strut_{name}: " + spring((f"arm_{name}", hub), ("chassis", (x, side * STRUT["y"], STRUT["z"])),
                                                   STRUT["stiffness"], STRUT["damping"], STRUT["free"]))
        forces += [f"  {way}_{name}: " + spring((f"wheel_{name}", hub), ("ground", anchors(x, side)[way]), *law)
                   for way, law in HOLD.items()]
    return "\n".join(["floatframe: 1", f"gravity: [0, 0, -{GRAVITY}]",
                      "parameters: {step: 0.001, duration: 1, tolerance: 1e-9}", "bodies:", *bodies, "joints:", *joints,
                      "forces:", *forces, "outputs:", f"  chassis: {{position: {{body: chassis, at: [0, 0, {h}]}}}}",
                      "simulation: {step: ${step}, duration: ${duration}, tolerance: ${tolerance}}"]) + "\n"


def vehicle_mjcf():
    def inertial(part, y=0.0):
        return f'<inertial pos="0 {y!r} 0" mass="{part["mass"]!r}" diaginertia="{" ".join(map(repr, part["inertia"]))}"/>'

    def spring(a, b, stiffness, damping, free):
        return (f'<spatial stiffness="{stiffness!r}" damping="{damping!r}" springlength="{free!r}"><site site="{a}"/>'
                f'<site site="{b}"/></spatial>')

    ground, bodies, springs, h = "", "", "", CHASSIS["height"]
    for name, (x, side) in CORNERS_OF_CAR.items():
        reach = side * (ARM["outer"] - ARM["inner"])
        for way, (px, py, pz) in anchors(x, side).items():
            ground += f'<site name="{way}_{name}" pos="{px!r} {py!r} {pz!r}"/>'
            springs += spring(f"wheel_{name}", f"{way}_{name}", *HOLD[way])
        springs += spring(f"arm_{name}", f"strut_{name}", STRUT["stiffness"], STRUT["damping"], STRUT["free"])
        bodies += (f'<site name="strut_{name}" pos="{x!r} {side * STRUT["y"]!r} {STRUT["z"] - h!r}"/>'
                   f'<body pos="{x!r} {side * ARM["inner"]!r} {ARM["height"] - h!r}"><joint type="hinge" axis="1 0 0"/>'
                   f'{inertial(ARM, reach / 2)}<site name="arm_{name}" pos="0 {reach!r} 0"/><body pos="0 {reach!r} 0">'
                   f'<joint name="axle_{name}" type="hinge" axis="0 1 0"/>{inertial(WHEEL)}<site name="wheel_{name}"/>'
                   f'</body></body>')
    return (f'<mujoco><option gravity="0 0 -{GRAVITY}"><flag contact="disable" constraint="disable"/></option><worldbody>'
            f'{ground}<body pos="0 0 {h!r}"><freejoint/>{inertial(CHASSIS)}<site name="tip"/>{bodies}</body></worldbody>'
            f'<tendon>{springs}</tendon></mujoco>')
