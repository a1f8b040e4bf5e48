"""What other programs find in the files of `floatframe export`, against the solver (make test-export).

Usage: outside_programs.py BINARY EXAMPLES TOOLS, in an interpreter that has the package vtk; TOOLS: a folder where npm has
installed gltf-validator. Each example is run and exported; then
  - every .vtu that the .pvd names is opened by vtkXMLUnstructuredGridReader without a complaint; named nodes have the positions and
    displacements of `floatframe outputs`; stress is that of the .npz file, turned to the world by the quaternion there, and at the
    twenty hottest nodes of parts that of gauges in the model,
  - Khronos' validator finds neither an error nor a warning in the .glb; vtkGLTFReader, which knows nothing of us, plays its
    animation and morph targets: named nodes are at key frames where the solver has them, and so is the whole surface.
A line of figures for each example; exit code 1 if one is beyond its limit.
"""
import csv
import io
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import vtk

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
from export_readers import Glb, read_npz, read_pvd, rotated  # noqa: E402  pylint: disable=wrong-import-position

BINARY, EXAMPLES, TOOLS = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
LIMITS = {"vtu points [m]": 1e-6, "vtu displacement [m]": 1e-6, "vtu stress [of largest]": 1e-5,
          "vtu stress to gauges [of largest]": 1e-5, "glb nodes [m]": 1e-5, "glb surface [m]": 1e-5}
# Every so many of the recorded instants.
CASES = {"flexible_pendulum": 5, "slider_crank": 10, "rotor": 50, "quarter_car": 20, "spin_up": 5, "iltis": 4, "iltis_solid": 10}
WITH_PARTS = ("iltis_solid",)

VALIDATE = """
const fs = require('fs'), validator = require(process.argv[1] + '/node_modules/gltf-validator');
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then(r => console.log(JSON.stringify(r.issues)));
"""


def program(*arguments):
    done = subprocess.run([BINARY, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"floatframe {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


class Grid:
    """A .vtu file as VTK reads it."""

    def __init__(self, path):
        reader = vtk.vtkXMLUnstructuredGridReader()
        complaints = []
        for event in ("ErrorEvent", "WarningEvent"):
            reader.AddObserver(event, lambda *_: complaints.append(str(path)))
        if not reader.CanReadFile(str(path)):
            sys.exit(f"{path}: VTK cannot read it")
        reader.SetFileName(str(path))
        reader.Update()
        if complaints:
            sys.exit(f"{path}: VTK complains")
        self.grid = reader.GetOutput()
        self.data = self.grid.GetPointData()
        texts = [self.grid.GetFieldData().GetAbstractArray(name) for name in ("body_names", "node_names")]
        self.bodies, names = ([a.GetValue(k) for k in range(a.GetNumberOfValues())] for a in texts)
        body, self.nodes = self.data.GetArray("body"), {}
        for cell in range(self.grid.GetNumberOfCells()):
            if self.grid.GetCellType(cell) == vtk.VTK_VERTEX:
                point = self.grid.GetCell(cell).GetPointId(0)
                self.nodes[self.bodies[int(body.GetTuple1(point))], names[len(self.nodes)]] = point


def distance(a, b):
    return max(abs(x - y) for x, y in zip(a, b, strict=True))


def solver_positions(folder, nodes, every):
    """{(body, node): [position at each instant]}"""
    channels = []
    for k, (body, node) in enumerate(nodes):
        channels += ["--add", f"n{k}: " + json.dumps({"position": {"body": body, "node": node}})]
    rows = list(csv.reader(io.StringIO(program("outputs", folder, *channels))))[1:]
    numbers = [[float(x) for x in row] for row in rows[::every]]
    return {node: [row[1 + 3 * k:4 + 3 * k] for row in numbers] for k, node in enumerate(nodes)}


def von_mises(s):
    return math.sqrt(0.5 * ((s[0] - s[1]) ** 2 + (s[1] - s[2]) ** 2 + (s[2] - s[0]) ** 2) + 3 * (s[3] ** 2 + s[4] ** 2 + s[5] ** 2))


def turned(q, s):
    """Six components turned by a quaternion w, x, y, z: columns R S, then rows."""
    q = (*q[1:], q[0])
    S = ((s[0], s[3], s[5]), (s[3], s[1], s[4]), (s[5], s[4], s[2]))
    half = [rotated(q, column) for column in S]  # S is symmetric: columns of R S
    rows = [rotated(q, [half[j][i] for j in range(3)]) for i in range(3)]
    return (rows[0][0], rows[1][1], rows[2][2], rows[0][1], rows[1][2], rows[2][0])


def check_stress(grid, arrays, frame, worst):
    """Surface points of parts: each shows the place of the largest von Mises stress at its node."""
    tensor, scalar = grid.data.GetArray("stress"), grid.data.GetArray("von_mises")
    if tensor is None:
        return
    body, node = grid.data.GetArray("body"), grid.data.GetArray("node")
    named = set(grid.nodes.values())
    by_body = {}
    for name in grid.bodies:
        if f"{name}/stress" not in arrays or "section" in arrays[f"{name}/stress_layers"].values:
            continue
        size = len(arrays[f"{name}/stress_nodes"].values)
        at = by_body.setdefault(name, {})
        for k in range(size):
            at.setdefault(arrays[f"{name}/stress_nodes"].values[k], []).append(arrays[f"{name}/stress"].row(frame, k))
    largest = max((von_mises(s) for at in by_body.values() for some in at.values() for s in some), default=0.0)
    for point in range(grid.grid.GetNumberOfPoints()):
        name = grid.bodies[int(body.GetTuple1(point))]
        if name not in by_body or point in named:
            continue
        expected = max(by_body[name][int(node.GetTuple1(point))], key=von_mises)
        world = turned(arrays[f"{name}/rotation"].row(frame), expected)
        worst["vtu stress [of largest]"] = max(
            worst.get("vtu stress [of largest]", 0.0), distance(tensor.GetTuple(point), world) / largest,
            abs(scalar.GetTuple1(point) - von_mises(expected)) / largest)


def check_gauges(folder, out, every, arrays, worst):
    """The hottest nodes of parts in the middle of the motion: gauges of the model there, turned to the world."""
    files = read_pvd(out / "motion.pvd")
    middle = Grid(out / files[len(files) // 2][1])
    number, scalar, body = (middle.data.GetArray(name) for name in ("node_number", "von_mises", "body"))
    if number is None:
        return
    points = range(middle.grid.GetNumberOfPoints())
    hottest = sorted((k for k in points if number.GetTuple1(k) > 0), key=scalar.GetTuple1)[-20:]
    if not hottest:
        return
    channels = []
    for k in hottest:
        place = {"body": middle.bodies[int(body.GetTuple1(k))], "node": int(number.GetTuple1(k))}
        channels += ["--add", f"g{k}: " + json.dumps({"stress": place})]  # six components, von Mises, four others
    rows = list(csv.reader(io.StringIO(program("outputs", folder, *channels))))[1::every]
    largest = scalar.GetTuple1(hottest[-1])
    for frame in range(0, len(files), max(1, len(files) // 20)):
        grid = Grid(out / files[frame][1])
        for column, k in enumerate(hottest):
            gauge = [float(x) for x in rows[frame][1 + 11 * column:8 + 11 * column]]
            world = turned(arrays[grid.bodies[int(body.GetTuple1(k))] + "/rotation"].row(frame), gauge[:6])
            worst["vtu stress to gauges [of largest]"] = max(
                worst.get("vtu stress to gauges [of largest]", 0.0),
                distance(grid.data.GetArray("stress").GetTuple(k), world) / largest,
                abs(grid.data.GetArray("von_mises").GetTuple1(k) - gauge[6]) / largest)


def check_vtk(folder, out, every, arrays, worst):
    files = read_pvd(out / "motion.pvd")
    first = Grid(out / files[0][1])
    positions = solver_positions(folder, first.nodes, every) if first.nodes else {}
    times = list(arrays["time"].values)
    for frame, (time, name) in enumerate(files):
        assert time == times[frame]
        grid = Grid(out / name)
        moved = grid.data.GetArray("displacement")
        for key, point in grid.nodes.items():
            expected = positions[key][frame]
            worst["vtu points [m]"] = max(worst.get("vtu points [m]", 0.0), distance(grid.grid.GetPoint(point), expected))
            # Of two instants: the design is the same.
            change = [a - b for a, b in zip(expected, positions[key][0])]
            found = [a - b for a, b in zip(moved.GetTuple(point), first.data.GetArray("displacement").GetTuple(first.nodes[key]))]
            worst["vtu displacement [m]"] = max(worst.get("vtu displacement [m]", 0.0), distance(found, change))
        if frame % max(1, len(files) // 5) == 0:
            check_stress(grid, arrays, frame, worst)
    check_gauges(folder, out, every, arrays, worst)
    return len(files), positions


def played(path, time):
    """World points of all primitives at a time, as VTK plays the animation."""
    reader = vtk.vtkGLTFReader()
    reader.SetFileName(str(path))
    reader.SetApplyDeformationsToGeometry(True)
    reader.UpdateInformation()
    reader.EnableAnimation(0)
    reader.SetFrameRate(60)
    reader.UpdateInformation()
    reader.UpdateTimeStep(time)
    iterator, out = reader.GetOutput().NewIterator(), []
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        data = iterator.GetCurrentDataObject()
        out.append([data.GetPoint(k) for k in range(data.GetNumberOfPoints())])
        iterator.GoToNextItem()
    return out


def check_glb(path, series, positions, worst):
    done = subprocess.run(["node", "-e", VALIDATE, "--", str(TOOLS), str(path)], capture_output=True, text=True, check=True)
    issues = json.loads(done.stdout)
    if issues["numErrors"] or issues["numWarnings"]:
        sys.exit(f"{path}: {json.dumps(issues, indent=1)}")
    scene = Glb(path)
    files = read_pvd(series / "motion.pvd")
    assert len(files) == len(scene.times)
    root = scene.json["nodes"][0]
    inverse = [-x for x in root["rotation"][:3]] + [root["rotation"][3]]
    origin = root["extras"]["origin_m"]
    bodies = [node["name"] for node in scene.json["nodes"][1:]]
    frames = range(0, len(scene.times), max(1, len(scene.times) // 10))
    for frame in frames:
        parts = iter(played(path, scene.times[frame]))
        grid = Grid(series / files[frame][1])
        surface = 0
        for body in bodies:
            for primitive in scene.json["meshes"][scene.nodes[body]["mesh"]]["primitives"]:
                points = [[a + b for a, b in zip(rotated(inverse, p), origin)] for p in next(parts)]
                if primitive["mode"] == 0:
                    for name, p in zip(scene.named(body), points, strict=True):
                        worst["glb nodes [m]"] = max(worst.get("glb nodes [m]", 0.0), distance(p, positions[body, name][frame]))
                elif primitive["mode"] == 4:
                    for k, p in enumerate(points):
                        worst["glb surface [m]"] = max(worst.get("glb surface [m]", 0.0), distance(p, grid.grid.GetPoint(surface + k)))
            surface += sum(1 for k in range(grid.grid.GetNumberOfPoints())
                           if grid.bodies[int(grid.data.GetArray("body").GetTuple1(k))] == body)
    far = max(abs(x) for (_, path), track in scene.tracks.items() if path == "translation" for place in track for x in place)
    return issues["numInfos"] + issues["numHints"], far


def main():
    failed = False
    for case, every in CASES.items():
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            program("run", EXAMPLES / case / f"{case}.yaml", "--out", folder / "run", "--quiet", "--no-report")
            program("export", folder / "run", "--vtk", folder / "vtk", "--glb", folder / "m.glb", "--npz", folder / "m.npz",
                    "--every", str(every), *(["--stress"] if case in WITH_PARTS else []))
            worst = {}
            files, positions = check_vtk(folder / "run", folder / "vtk", every, read_npz(folder / "m.npz"), worst)
            notes, far = check_glb(folder / "m.glb", folder / "vtk", positions, worst)
            print(f"{case}: {files} instants, {len(positions)} nodes; " + "; ".join(f"{name} {value:.1e}" for name, value in worst.items()) +
                  f"; validator: no error, no warning, {notes} remarks", flush=True)
            for name, value in worst.items():
                # Of glTF's floats half a digit there, and as much in the program that reads them.
                limit = max(LIMITS[name], 1.2e-7 * far) if name.startswith("glb") else LIMITS[name]
                if not value <= limit:
                    print(f"{case}: {name}: found {value:g}, expected at most {limit:g}", file=sys.stderr)
                    failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
