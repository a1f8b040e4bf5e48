"""Readers of what `floatframe export` writes, from the descriptions of the formats and with the standard library only."""
import array
import ast
import csv
import json
import math
import re
import struct
import xml.etree.ElementTree as ElementTree
import zipfile


def read_vtu(path):
    """Points, cells and arrays of an unstructured grid with raw appended data: {"time", "points", "cells", "point", "cell", "texts"}."""
    data = path.read_bytes()
    at = data.index(b'<AppendedData encoding="raw">')
    begin = data.index(b"_", at) + 1
    assert data.endswith(b"\n</AppendedData>\n</VTKFile>\n")
    root = ElementTree.fromstring(data[:at].decode() + "</VTKFile>")
    assert root.attrib["header_type"] == "UInt64" and root.attrib["byte_order"] == "LittleEndian"
    letters = {"Float64": "d", "Float32": "f", "Int32": "i", "UInt8": "B"}

    def numbers(element):
        values = array.array(letters[element.attrib["type"]])
        offset = begin + int(element.attrib["offset"])
        length, = struct.unpack_from("<Q", data, offset)
        values.frombytes(data[offset + 8:offset + 8 + length])
        n = int(element.attrib["NumberOfComponents"])
        return list(values) if n == 1 else [tuple(values[k:k + n]) for k in range(0, len(values), n)]

    def named(tag):
        return {element.attrib["Name"]: numbers(element) for element in root.find(f".//{tag}")}
    out = {"texts": {}}
    for element in root.find(".//FieldData"):
        if element.attrib["type"] == "String":
            codes = bytes(int(code) for code in element.text.split())
            out["texts"][element.attrib["Name"]] = codes.decode().split("\0")[:-1]
            assert len(out["texts"][element.attrib["Name"]]) == int(element.attrib["NumberOfTuples"])
        else:
            out["time"] = float(element.text)
    cells = named("Cells")
    out["points"], out["point"], out["cell"] = named("Points")["Points"], named("PointData"), named("CellData")
    out["cells"], first = [], 0
    for kind, end in zip(cells["types"], cells["offsets"]):
        out["cells"].append((kind, cells["connectivity"][first:end]))
        first = end
    piece = root.find(".//Piece").attrib
    assert int(piece["NumberOfPoints"]) == len(out["points"]) and int(piece["NumberOfCells"]) == len(out["cells"])
    for values in out["point"].values():
        assert len(values) == len(out["points"])
    for values in out["cell"].values():
        assert len(values) == len(out["cells"])
    return out


def node_points(grid, body):
    """Names of the named nodes of a body, and their points."""
    number = grid["texts"]["body_names"].index(body)
    names = iter(grid["texts"]["node_names"])
    out = {}
    for kind, points in grid["cells"]:
        if kind == 1:
            name = next(names)
            if grid["point"]["body"][points[0]] == number:
                out[name] = points[0]
    return out


def read_pvd(path):
    """Times and names."""
    return [(float(entry.attrib["timestep"]), entry.attrib["file"])
            for entry in ElementTree.parse(path).getroot().find("Collection")]


class Glb:
    """A scene of glTF: where points of its meshes are at the key frames."""

    def __init__(self, path):
        data = path.read_bytes()
        magic, version, length = struct.unpack_from("<4sII", data)
        assert (magic, version, length) == (b"glTF", 2, len(data))
        size, kind = struct.unpack_from("<I4s", data, 12)
        assert kind == b"JSON" and size % 4 == 0
        self.json = json.loads(data[20:20 + size])
        length, kind = struct.unpack_from("<I4s", data, 20 + size)
        assert kind == b"BIN\0" and 28 + size + length == len(data)
        self.buffer = data[28 + size:]
        self.nodes = {node["name"]: node for node in self.json["nodes"][1:]}
        animation = self.json.get("animations", [{"channels": [], "samplers": []}])[0]
        self.tracks = {}
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            target = channel["target"]
            self.tracks[target["node"], target["path"]] = self.numbers(sampler["output"])
            self.times = self.numbers(sampler["input"])

    def numbers(self, accessor):
        entry = self.json["accessors"][accessor]
        view = self.json["bufferViews"][entry["bufferView"]]
        values = array.array({5126: "f", 5125: "I"}[entry["componentType"]])
        values.frombytes(self.buffer[view["byteOffset"]:view["byteOffset"] + view["byteLength"]])
        n = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[entry["type"]]
        assert len(values) == n * entry["count"]
        return list(values) if n == 1 else [tuple(values[k:k + n]) for k in range(0, len(values), n)]

    def primitive(self, body, mode):
        return next(p for p in self.json["meshes"][self.nodes[body]["mesh"]]["primitives"] if p["mode"] == mode)

    def named(self, body):
        return self.json["meshes"][self.nodes[body]["mesh"]]["extras"]["node_names"]

    def points(self, body, frame, mode=0):
        """World positions in the axes of the model, of the points of a primitive (0: named nodes, 4: triangles)."""
        index = next(k for k, node in enumerate(self.json["nodes"]) if node is self.nodes[body])
        primitive = self.primitive(body, mode)
        points = [list(p) for p in self.numbers(primitive["attributes"]["POSITION"])]
        targets = primitive.get("targets", [])
        weights = self.tracks.get((index, "weights"), [])[frame * len(targets):(frame + 1) * len(targets)]
        for weight, target in zip(weights, targets):
            for p, u in zip(points, self.numbers(target["POSITION"])):
                for c in range(3):
                    p[c] += weight * u[c]
        place = self.tracks[index, "translation"][frame]
        turn = self.tracks[index, "rotation"][frame]
        root = self.json["nodes"][0]
        inverse = [-x for x in root["rotation"][:3]] + [root["rotation"][3]]
        out = []
        for p in points:
            there = [a + b for a, b in zip(rotated(turn, p), place)]
            up = rotated(root["rotation"], there)  # as a viewer shows it, y up
            out.append([a + b for a, b in zip(rotated(inverse, up), root["extras"]["origin_m"])])
        return out


def rotated(q, v):
    """By a quaternion x, y, z, w."""
    x, y, z, w = (component / math.sqrt(sum(c * c for c in q)) for component in q)
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0]]


class Array:
    """Of a .npy file: shape and values in C order."""

    def __init__(self, content):
        assert content[:8] == b"\x93NUMPY\x01\x00"
        size, = struct.unpack_from("<H", content, 8)
        header = ast.literal_eval(content[10:10 + size].decode())
        assert header["fortran_order"] is False
        self.shape = header["shape"]
        kind, body = header["descr"], content[10 + size:]
        if kind.startswith("<U"):
            step = 4 * int(kind[2:])
            self.values = [body[k:k + step].decode("utf-32-le").rstrip("\0") for k in range(0, len(body), step)]
        else:
            self.values = array.array({"<f8": "d", "<i4": "i", "<i8": "q"}[kind])
            self.values.frombytes(body)
        assert len(self.values) == math.prod(self.shape)

    def row(self, *index):
        """The numbers at the first indices."""
        first, size = 0, len(self.values)
        for k, n in zip(index, self.shape):
            size //= n
            first += k * size
        return list(self.values[first:first + size])


def read_npz(path):
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        return {re.sub(r"\.npy$", "", name): Array(archive.read(name)) for name in archive.namelist()}


def read_table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))
