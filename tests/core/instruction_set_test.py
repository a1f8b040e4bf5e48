"""The dynamic linker loads the AVX2 copy of the library where the processor has AVX2, and the baseline elsewhere."""
import os
import pathlib
import platform
import re
import subprocess
import unittest

BUILD = pathlib.Path(os.environ["FLOATFRAME_BINARY"]).parent
PROGRAM = BUILD / "tests" / "core_tests"
FAST_COPY = BUILD / "lib" / "glibc-hwcaps" / "x86-64-v3" / "libfloatframe.so"
LOADER = pathlib.Path("/lib64/ld-linux-x86-64.so.2")
V3_FLAGS = {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe", "xsave"}


def processor_has_v3():
    match = re.search(r"^flags\s*:(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return match is not None and V3_FLAGS <= set(match.group(1).split())


def loaded_instruction_set(*prefix):
    command = [*map(str, prefix), str(PROGRAM), "--gtest_filter=BuildInfo.PrintsTheInstructionSet"]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return re.search(r"instruction set: (\S+)", output).group(1)


@unittest.skipUnless(platform.machine() == "x86_64" and FAST_COPY.exists(), "built without the x86-64-v3 copy")
class InstructionSet(unittest.TestCase):
    def test_the_copy_that_fits_the_processor_is_loaded(self):
        self.assertEqual(loaded_instruction_set(), "x86-64-v3" if processor_has_v3() else "x86-64")

    def test_without_avx2_the_baseline_is_loaded(self):
        # A mask that names no level makes the loader behave as on a processor without any of them.
        self.assertEqual(loaded_instruction_set(LOADER, "--glibc-hwcaps-mask", "none"), "x86-64")

    def test_the_baseline_has_no_avx_instruction(self):
        # Vector registers of AVX are called ymm, those of AVX-512 zmm; three-operand forms begin with v.
        try:
            listing = subprocess.run(["objdump", "-d", "--no-show-raw-insn", str(BUILD / "lib" / "libfloatframe.so")],
                                     check=True, capture_output=True, text=True).stdout
        except FileNotFoundError:
            self.skipTest("objdump is not installed")
        found = re.search(r"^.*%[yz]mm.*$|^\s+[0-9a-f]+:\s+v(?:add|mul|mov|fmadd)\S*\s.*$", listing, re.MULTILINE)
        self.assertIsNone(found, found and found.group(0))


if __name__ == "__main__":
    unittest.main()
