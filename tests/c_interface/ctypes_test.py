"""The C interface from Python's ctypes: names, versions of symbols, steps and saved states, also in another process."""
import ctypes
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BINARY = pathlib.Path(os.environ["FLOATFRAME_BINARY"])
FOLDER = ROOT / "src" / "floatframe" / "c_interface"
HEADER = (FOLDER / "floatframe.h").read_text()
MODEL = ROOT / "examples" / "flexible_pendulum" / "flexible_pendulum.yaml"
CALL = r"FLOATFRAME_API ([^;(]+?)(\w+)\(([^)]*)\)\s+FLOATFRAME_NOEXCEPT;"
TYPES = {"int32_t": ctypes.c_int32, "int64_t": ctypes.c_int64, "double": ctypes.c_double, "size_t": ctypes.c_size_t,
         "floatframe_status": ctypes.c_int, "void": None}
OK, WARNING, INVALID, WRONG_ORDER = range(4)
MACHINE = """floatframe: 1
name: dropped
parameters: {stiff: 900, push: 3}
inputs:
  force: {unit: N, min: -5, max: 5}
  target: {unit: m, initial: 0.1, min: 0, max: 0.2, clamp: true}
bodies: {stone: {rigid: {mass: 2, centre_of_mass: [0, 0, 0], inertia: [1, 1, 1]}}}
joints: {guide: {type: prismatic, child: stone, at: [0, 0, 0], axis: z, position: 0.1}}
forces:
  spring: {type: joint_spring, joint: guide, spring: "${stiff}", target: {input: target}}
  push: {type: force, body: stone, at: [0, 0, 0], direction: z, magnitude: {input: force}}
outputs: {z: {joint_position: guide}, spring: {force: spring}}
simulation: {step: 0.01, duration: 0.5}
"""


def library_of_the_program():
    """The copy that the program runs with: results of the two differ in the last digits."""
    version = subprocess.run([BINARY, "--version"], capture_output=True, text=True, check=True).stdout
    copy = BINARY.parent / "lib" / "glibc-hwcaps" / "x86-64-v3" / "libfloatframe.so"
    return copy if "x86-64-v3" in version else BINARY.parent / "lib" / "libfloatframe.so"


def declared():
    """{function: (result, arguments)} in the words of the header."""
    return {name: (result.strip(), arguments) for result, name, arguments in re.findall(CALL, HEADER)}


def ctypes_type(words):
    words = words.replace("const ", "").strip()
    if "*" not in words:
        return TYPES[words.split()[0]]
    kind = words.split("*")[0].strip()
    return {"char": ctypes.c_char_p, "double": ctypes.POINTER(ctypes.c_double), "int32_t": ctypes.POINTER(ctypes.c_int32),
            "size_t": ctypes.POINTER(ctypes.c_size_t)}.get(kind, ctypes.c_void_p)


def loaded():
    lib = ctypes.CDLL(str(library_of_the_program()))
    for name, (result, arguments) in declared().items():
        call = getattr(lib, name)
        call.restype = ctypes_type(result)
        call.argtypes = [] if arguments == "void" else [ctypes_type(a) for a in arguments.split(",")]
    return lib


class Handle:
    def __init__(self, path):
        self.lib = loaded()
        text = ctypes.create_string_buffer(1000)
        self.s = self.lib.floatframe_open(str(path).encode(), text, len(text))
        if not self.s:
            raise ValueError(text.value.decode())

    def __getattr__(self, name):
        return lambda *arguments: getattr(self.lib, "floatframe_" + name)(self.s, *arguments)

    def outputs_now(self):
        return self.outputs()[:self.output_count()]

    def saved_bytes(self):
        count = ctypes.c_size_t()
        assert self.save(ctypes.byref(count)) == OK, self.message()
        return ctypes.string_at(self.saved(), count.value)


def steps(handle, first, last):
    """Bits of the outputs of steps, driven by their number."""
    out = []
    for k in range(first, last):
        assert handle.set_input(0, 0.25 * (k % 7)) == OK
        assert handle.step() == OK, handle.message()
        out += handle.outputs_now()
    return struct.pack(f"{len(out)}d", *out).hex()


@unittest.skipIf(os.environ.get("FLOATFRAME_SANITIZE"), "the library needs the sanitizer in the program that loads it")
class CTypes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name) / "dropped.yaml"
        self.path.write_text(MACHINE)

    def test_all_functions_are_exported_with_a_version(self):
        names = set(declared())
        self.assertGreater(len(names), 40)
        self.assertEqual(HEADER.count("FLOATFRAME_API "), len(names) + len(re.findall(r"#define FLOATFRAME_API ", HEADER)))
        try:
            listing = subprocess.run(["nm", "-D", "--defined-only", library_of_the_program()], check=True, capture_output=True,
                                     text=True).stdout
        except FileNotFoundError:
            self.skipTest("nm is not installed")
        self.assertEqual(set(re.findall(r" T (floatframe_\w+)@@FLOATFRAME_1$", listing, re.MULTILINE)), names)
        self.assertEqual(set(re.findall(r" [A-Z] (floatframe_\w+)", listing)), names)
        self.assertRegex(listing, r" T _ZN10floatframe\w*\n", "C++ symbols are not hidden, and have no version")

    def test_the_table_has_all_but_open(self):
        table = (FOLDER / "function_table.hpp").read_text().partition("#define FLOATFRAME_FUNCTIONS(F)")[2].partition("// clang-format on")[0]
        self.assertEqual({"floatframe_" + name for name in re.findall(r"F\((\w+)\)", table)}, set(declared()) - {"floatframe_open"})

    def test_the_document_names_all_functions(self):
        text = (ROOT / "docs" / "c-interface.md").read_text().partition("## Functions")[2].partition("| status |")[0]
        self.assertEqual(set(re.findall(r"`([a-z_]+)(?:\(|`)", text)) - {"floatframe_", "s", "k", "simulation"},
                         {name.removeprefix("floatframe_") for name in declared()})

    def test_errors(self):
        with self.assertRaisesRegex(ValueError, "no/such.yaml"):
            Handle("no/such.yaml")
        s = Handle(self.path)
        self.assertEqual(s.step(), WRONG_ORDER)
        self.assertIn(b"before the start", s.message())
        self.assertEqual(s.set_option(b"step", b"5e-3"), OK)
        self.assertEqual(s.start(), OK)
        self.assertEqual(s.set_input(0, float("nan")), INVALID)
        self.assertEqual(s.set_input(1, 5.0), WARNING)
        self.assertEqual(s.input(1), 0.2)
        self.assertEqual(s.step(), OK)
        self.assertEqual(s.time(), 5e-3)
        s.close()

    def test_steps_are_those_of_a_run(self):
        subprocess.run([BINARY, "run", MODEL, "--quiet", "--no-report", "--record", "none", "--duration", "0.2", "--out", self.folder.name + "/out"],
                       check=True)
        rows = (pathlib.Path(self.folder.name) / "out" / "results.csv").read_text().splitlines()[1:]
        s = Handle(MODEL)
        self.assertEqual(s.start(), OK)
        for k, row in enumerate(rows):
            if k:
                self.assertEqual(s.step(), OK)
            self.assertEqual([s.time(), *s.outputs_now()], [float(x) for x in row.split(",")], f"row {k}")
        self.assertEqual(len(rows), 201)
        s.close()

    def test_a_packed_model_with_parameters(self):
        packed = pathlib.Path(self.folder.name) / "dropped.ffm"
        subprocess.run([BINARY, "pack", self.path, "-o", packed], check=True, capture_output=True)
        s, plain = Handle(packed), Handle(self.path)
        self.assertRegex(s.fingerprint().decode(), "^[0-9a-f]{16}$")
        for h in (s, plain):
            self.assertEqual(h.start(), OK)
        self.assertEqual(steps(s, 0, 10), steps(plain, 0, 10))
        k = s.find_parameter(b"stiff")
        self.assertEqual(s.parameter(k), 900.0)
        self.assertEqual(s.set_parameter(k, 100.0), OK, s.message())
        self.assertNotEqual(steps(s, 10, 20), steps(plain, 10, 20))

    def test_goes_on_in_another_process(self):
        s = Handle(self.path)
        self.assertEqual(s.start(), OK)
        steps(s, 0, 20)
        state = pathlib.Path(self.folder.name) / "state"
        state.write_bytes(s.saved_bytes())
        expected = steps(s, 20, 40)
        done = subprocess.run([sys.executable, "-B", __file__, "--go-on", self.path, state], capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), expected)
        self.assertEqual(s.restore(state.read_bytes(), state.stat().st_size), OK)
        self.assertEqual(steps(s, 20, 40), expected)


def go_on(path, state):
    s = Handle(path)
    content = pathlib.Path(state).read_bytes()
    assert s.restore(content, len(content)) == OK, s.message()
    print(steps(s, 20, 40))


if __name__ == "__main__":
    if sys.argv[1:2] == ["--go-on"]:
        go_on(*sys.argv[2:])
    else:
        unittest.main()
