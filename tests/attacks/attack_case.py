"""What attacks share: a command with limits, what counts as a failure, and which files may remain in its folder.

FLOATFRAME_ATTACKS is the number of attacks of each kind, FLOATFRAME_SEED the first seed; a failure prints its own seed,
and its files are kept in the folder FLOATFRAME_KEEP, if that is set.
"""
import hashlib
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import unittest

BINARY = str(pathlib.Path(os.environ.get("FLOATFRAME_BINARY") or "build/floatframe").resolve())
ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "tests" / "data"
EXAMPLES = ROOT / "examples"
ATTACKS = int(os.environ.get("FLOATFRAME_ATTACKS", "25"))
SEED = int(os.environ.get("FLOATFRAME_SEED", "1"))
SECONDS = 60  # of processor time, and six times as much of the wall's on a busy machine
MEMORY = 4 << 30
# Sanitizers reserve terabytes of addresses.
LIMIT_MEMORY = not os.environ.get("FLOATFRAME_SANITIZE")
TEMPORARY = re.compile(r"\.part-\d+-\d+$")  # a file that is being written (core/atomic_file.cpp)
CODES = (0, 1, 2)


def files_of(folder):
    return {path: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.rglob("*")
            if path.is_file() and not path.is_symlink()}


class AttackCase(unittest.TestCase):
    def attacks(self, kind, one):
        """Calls one(random, folder) for each attack, with random numbers and an empty folder of its own."""
        for k in range(ATTACKS):
            seed = f"{kind} {SEED + k}"
            folder = pathlib.Path(tempfile.mkdtemp(prefix="floatframe_attack_"))
            try:
                with self.subTest(seed=seed):
                    try:
                        one(random.Random(seed), folder)
                    except BaseException:
                        self.keep(folder, seed)
                        raise
            finally:
                shutil.rmtree(folder, ignore_errors=True)

    @staticmethod
    def keep(folder, seed):
        if place := os.environ.get("FLOATFRAME_KEEP"):
            shutil.copytree(folder, pathlib.Path(place) / seed.replace(" ", "_"), dirs_exist_ok=True)

    def attack(self, folder, *arguments, limits=(), signals=(), own=()):
        """Runs the program in the folder. `limits`: (resource, size); `signals`: (seconds, signal) from outside;
        `own`: names in the folder that the command may change. Returns its code and what it printed."""
        before = files_of(folder)

        def set_limits():
            resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            if LIMIT_MEMORY:
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            for which, size in limits:
                resource.setrlimit(which, (size, size))

        process = subprocess.Popen([BINARY, *arguments], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, preexec_fn=set_limits, start_new_session=True)
        sent = []
        try:
            for seconds, number in signals:
                try:
                    out, err = process.communicate(timeout=seconds)
                    break
                except subprocess.TimeoutExpired:
                    process.send_signal(number)
                    sent.append(number)
            out, err = process.communicate(timeout=6 * SECONDS)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            self.fail(f"no end: {arguments}")
        words = err.decode(errors="replace")
        said = f"{arguments}\n{words[-2000:]}"
        ends = set(CODES) | {-n for n in sent} | {128 + n for n in sent}
        self.assertIn(process.returncode, ends, said)
        for bad in ("terminate called", "runtime error", "AddressSanitizer", "Assertion", "std::"):
            self.assertNotIn(bad, words, said)
        if process.returncode in (1, 2):
            self.assertNotEqual(words.strip(), "", said)
        self.check_folder(folder, before, own, said)
        return process.returncode, out.decode(errors="replace"), words

    def check_folder(self, folder, before, own, said):
        """Nothing half-written, and nothing changed that is not the command's own."""
        after = files_of(folder)
        for path, content in before.items():
            if not any(str(path.relative_to(folder)).startswith(name) for name in own):
                self.assertEqual(after.get(path), content, f"{path.name}: {said}")
        for path in after:
            self.assertIsNone(TEMPORARY.search(path.name), f"{path.name}: {said}")
