#!/usr/bin/env python3
"""What the documents say is there: links, options of the program, keys, whole models, packages."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY", "build/floatframe")).resolve())
DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md")),
             *sorted((ROOT / "examples").glob("*/README.md"))]
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def program(*arguments):
    return subprocess.run([BINARY, *arguments], capture_output=True, text=True, timeout=120)


def anchors(path):
    """Of headings, as GitHub makes them."""
    found = set()
    for line in re.findall(r"^#+ +(.*)$", BLOCK.sub("", path.read_text()), re.MULTILINE):
        found.add(re.sub(r"[^\w\- ]", "", line.strip().lower()).replace(" ", "-"))
    return found


class Documents(unittest.TestCase):
    def test_links_lead_somewhere(self):
        for document in DOCUMENTS:
            for target in re.findall(r"\]\(([^)\s]+)\)", BLOCK.sub("", document.read_text())):
                if re.match(r"[a-z]+:", target):
                    continue
                name, _, anchor = target.partition("#")
                path = (document.parent / name).resolve() if name else document
                with self.subTest(document=document.name, target=target):
                    self.assertTrue(path.exists())
                    if anchor:
                        self.assertIn(anchor, anchors(path))

    def test_options_of_commands_are_known(self):
        commands = re.findall(r"^  (\w+) ", program("--help").stdout.split("Subcommands:")[-1], re.MULTILINE)
        self.assertGreater(len(commands), 8)
        known = {c: program(c, "--help").stdout for c in commands}
        known["bench"] += "".join(program("bench", c, "--help").stdout for c in ("step", "chain", "scaling", "iltis"))
        for document in DOCUMENTS:
            text = document.read_text().replace("\\\n", " ")
            for command, rest in re.findall(r"floatframe (%s)\b([^\n`#;|&]*)" % "|".join(commands), text):
                for option in re.findall(r"(?<!\S)--[a-z][a-z-]+", rest):
                    with self.subTest(document=document.name, command=command, option=option):
                        self.assertIn(option, known[command])

    def test_keys_of_the_advisor_are_keys_of_a_model(self):
        model = "".join((ROOT / "docs" / f"{name}.md").read_text() for name in ("model-file", "parts"))
        section = (ROOT / "docs" / "mode-advisor.md").read_text().partition("*Dropping a mode.*")[2].partition("\n\n")[0]
        keys = re.findall(r"`\{?([a-z_]+)", section)
        self.assertGreaterEqual(len(keys), 3)
        for key in keys:
            self.assertTrue(re.search(rf"\b{key}\b", model), key)

    def test_whole_models_are_valid(self):
        models = [(document.name, text) for document in DOCUMENTS
                  for kind, text in BLOCK.findall(document.read_text()) if text.startswith("floatframe: 1")]
        self.assertGreaterEqual(len(models), 2)
        for name, text in models:
            with self.subTest(document=name), tempfile.TemporaryDirectory() as folder:
                model = pathlib.Path(folder) / "model.yaml"
                model.write_text(text)
                done = program("check", str(model))
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_packages_are_those_that_are_installed(self):
        script = (ROOT / "scripts" / "install_packages.sh").read_text()
        installed = set(re.search(r"packages=\((.*?)\)", script, re.DOTALL)[1].split())
        for document in DOCUMENTS:
            for name in re.findall(r"\blib[a-z0-9-]+-dev\b", document.read_text()):
                self.assertTrue(name in installed, f"{document.name}: {name}")
        # What CMake looks for is named where the installation is described.
        readme = (ROOT / "docs" / "install.md").read_text().lower().replace("-", "").replace(" ", "")
        names = {"Eigen3": "eigen", "GTest": "googletest", "benchmark": "googlebenchmark", "nlohmann_json": "nlohmannjson"}
        for path in (ROOT / "CMakeLists.txt", *ROOT.glob("*/CMakeLists.txt"), *ROOT.glob("cmake/*.cmake")):
            for package in re.findall(r"find_package\((\w[\w-]*)", path.read_text()):
                name = names.get(package, package.lower().replace("-", "").replace("_", ""))
                if name not in {"floatframe", "pkgconfig", "threads", "python3"}:
                    self.assertTrue(name in readme, f"docs/install.md does not name {package}")


if __name__ == "__main__":
    unittest.main()
