"""scripts/check_names.py finds names that two sources of a room have in common."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_names.py"


def unnamed(text):
    return "namespace floatframe {\nnamespace {\n" + text + "\n}  // namespace\n}  // namespace floatframe\n"


class CheckNames(unittest.TestCase):
    def check(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            result = subprocess.run([sys.executable, "-B", str(SCRIPT), str(root)], capture_output=True, text=True)
            return result.returncode, result.stderr

    def names(self, a, b, room="src/floatframe/model"):
        """Which names two sources of a room are told of."""
        code, text = self.check({f"{room}/a.cpp": a, f"{room}/b.cpp": b})
        self.assertEqual(code, 1 if text else 0)
        return [line.split("'")[1] for line in text.splitlines()]

    def test_the_sentence(self):
        code, text = self.check({"tests/model/a.cpp": unnamed("int f() { return 1; }"),
                                 "tests/model/b.cpp": "\n" + unnamed("double f(double x) { return x; }")})
        self.assertEqual((code, text), (1, "tests/model/b.cpp:4: 'f' is also in tests/model/a.cpp:3; expected a name of its own, "
                                           "since sources of a room are compiled as one\n"))

    def test_all_kinds_of_names(self):
        for one, other in (("int x = 1;", "constexpr double x[] = {1, 2};"),
                           ("int a, x;", "const int b = f(1, 2), x{3};"),
                           ("struct x { int y; };", "enum class x { y };"),
                           ("template <class T, int n = (1 > 0)>\nT x(T t) { return t; }", "std::map<int, std::set<int>> x;"),
                           ("using x = int;", "using x = double;"),
                           ("void x(int) noexcept { if (true) { f(); } }", "[[maybe_unused]] inline auto x = [] { return 1; };"),
                           ("std::function<void(int)> x;", "class x final : public Base<int> {};"),
                           ("class x;", "const char* const x = R\"(\n} namespace {\n)\";")):
            self.assertEqual(self.names(unnamed(one), unnamed(other)), ["x"], (one, other))
        self.assertEqual(self.names("static int x = 1;\n", unnamed("static int x() { return 2; }").replace("floatframe", "")), ["x"])
        self.assertEqual(self.names(unnamed("int a() { return '{'; }\nint x;"), unnamed("#define F { \\\n {\nint x;")), ["x"])

    def test_what_is_no_name_of_a_source(self):
        for one, other in (("int x; namespace {}", "int x; namespace {}"),  # the linker's matter
                           (unnamed("int a(int x) { int y = x; return y; }"), unnamed("int b(int x) { int y = x; return y; }")),
                           (unnamed("struct A { int x() { return 1; } };"), unnamed("struct B { int x; };")),
                           (unnamed("int A::x() { return 1; }"), unnamed("int B::x() { return 1; }")),
                           (unnamed("using Json = a::Json;"), unnamed("using Json = a::Json;")),
                           (unnamed("template <>\nvoid f<1>() {}"), unnamed("template <>\nvoid f<2>() {}")),
                           (unnamed("TEST(Suite, One) { int x; }"), unnamed("TEST(Suite, Two) { int x; }")),
                           (unnamed("// int x;\n/* int y; */"), unnamed("int x, y;")),
                           ("namespace a { namespace { int x; } }", "namespace b { namespace { int x; } }")):
            self.assertEqual(self.names(one, other), [], (one, other))

    def test_overloads_within_a_source_and_equal_names_of_two_rooms(self):
        f = unnamed("int f(int) { return 1; }\nint f(double) { return 2; }")
        self.assertEqual(self.check({"src/floatframe/fe/a.cpp": f, "src/floatframe/body/a.cpp": f, "tests/fe/a.cpp": f}), (0, ""))

    def test_rooms_within_a_room_are_compiled_with_it(self):
        code, text = self.check({f"src/floatframe/formats/{room}/a.cpp": unnamed("int f;") for room in ("sid", "gmsh")})
        self.assertEqual(code, 1)
        self.assertIn("src/floatframe/formats/sid/a.cpp:3: 'f' is also in src/floatframe/formats/gmsh/a.cpp:3", text)

    def test_elements_are_compiled_one_by_one(self):
        self.assertEqual(self.names(unnamed("int f;"), unnamed("int f;"), "src/floatframe/fe/elements"), [])

    def test_a_source_that_is_not_understood(self):
        code, text = self.check({"tests/fe/a.cpp": unnamed("int f;") + "}\nint g;\n"})
        self.assertEqual(code, 1)
        self.assertIn("tests/fe/a.cpp:6: found a '}' that closes nothing", text)


if __name__ == "__main__":
    unittest.main()
