"""scripts/install_packages.sh: runs nothing when all is there, and says what to install when it cannot."""
import pathlib
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "install_packages.sh"


class InstallPackages(unittest.TestCase):
    """Stands the system's tools in by small scripts on PATH, so that nothing is installed."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.bin = pathlib.Path(self.folder.name)
        self.log = self.bin / "log"
        for tool in ("bash", "env", "cat"):
            path = next(p for p in (pathlib.Path("/bin") / tool, pathlib.Path("/usr/bin") / tool) if p.exists())
            (self.bin / tool).symlink_to(path)
        self.stand_in("node", "true")

    def tearDown(self):
        self.folder.cleanup()

    def stand_in(self, name, body):
        path = self.bin / name
        path.write_text(f"#!/bin/bash\n{body}\n")
        path.chmod(0o755)

    def run_script(self, *arguments):
        environment = {"PATH": str(self.bin), "LOG": str(self.log)}
        result = subprocess.run(["/bin/bash", str(SCRIPT), *arguments], env=environment, stdin=subprocess.DEVNULL,
                                capture_output=True, text=True)
        calls = self.log.read_text().splitlines() if self.log.exists() else []
        return result, calls

    def debian(self, installed_after=False, user=1000):
        """A Debian where only libfmt-dev is missing, until apt-get installs it."""
        marker = self.bin / "installed"
        self.stand_in("dpkg-query", f'[[ "${{@: -1}}" == libfmt-dev && ! -e {marker} ]] && exit 1; echo -n installed')
        install = f"> {marker}" if installed_after else "true"
        self.stand_in("apt-get", f'[[ "$*" == *--simulate* ]] && exit 1; echo "apt-get $*" >> "$LOG"; '
                                 f'[[ "$*" == *libfmt-dev* ]] && {install}; true')
        self.stand_in("id", f"echo {user}")

    def test_nothing_is_run_when_all_packages_are_there(self):
        self.debian()
        self.stand_in("dpkg-query", "echo -n installed")
        result, calls = self.run_script()
        self.assertEqual((result.returncode, result.stdout, result.stderr, calls), (0, "", "", []))

    def test_node_is_installed_only_where_there_is_none(self):
        self.debian(user=0)
        self.stand_in("dpkg-query", "echo -n installed")
        (self.bin / "node").unlink()
        result, calls = self.run_script()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([call.split(" ")[-2:] for call in calls], [["nodejs", "npm"]])

    def test_without_node_the_build_goes_on(self):
        self.debian(user=0)
        self.stand_in("dpkg-query", "echo -n installed")
        self.stand_in("apt-get", "exit 100")
        (self.bin / "node").unlink()
        result, _ = self.run_script()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Note: nodejs and npm could not be installed", result.stdout)

    def test_root_refreshes_the_lists_and_installs_what_is_missing(self):
        self.debian(installed_after=True, user=0)
        result, calls = self.run_script()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Missing packages: libfmt-dev\n", result.stdout)
        self.assertIn("Installing: apt-get install -y --no-install-recommends libfmt-dev\n", result.stdout)
        self.assertEqual([call.split(" ")[-1] for call in calls], ["update", "libfmt-dev"])

    def test_sudo_is_used_when_not_root(self):
        self.debian(installed_after=True)
        self.stand_in("sudo", '[[ "$1" == -n ]] && shift; echo "sudo $*" >> "$LOG"; "$@"')
        self.stand_in("true", "")
        result, calls = self.run_script()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(any(call.startswith("sudo ") and call.endswith("libfmt-dev") for call in calls), calls)

    def test_without_root_and_sudo_it_says_what_to_install(self):
        self.debian()
        result, calls = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertIn("Not root, and there is no sudo.\n", result.stderr)
        self.assertIn("  sudo apt-get update && sudo apt-get install -y --no-install-recommends libfmt-dev\n",
                      result.stderr)
        self.assertEqual(calls, [])

    def test_sudo_that_asks_for_a_password_does_not_hang(self):
        self.debian()
        self.stand_in("sudo", "exit 1")
        result, _ = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertIn("sudo needs a password", result.stderr)

    def test_on_another_system_it_names_the_missing_tools(self):
        self.stand_in("g++", "")
        result, _ = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertIn("these tools are missing: cmake ninja make python3\n", result.stderr)

    def test_the_reference_needs_doxygen(self):
        self.debian(user=0)
        self.stand_in("dpkg-query", '[[ "${@: -1}" == doxygen ]] && exit 1; echo -n installed')
        self.assertEqual(self.run_script("--check")[0].returncode, 0)
        result, calls = self.run_script("--docs")
        self.assertIn("Missing packages: doxygen\n", result.stdout)
        self.assertTrue(calls[-1].endswith(" doxygen"), calls)

    def test_check_only_looks(self):
        self.debian(user=0)
        result, calls = self.run_script("--check")
        self.assertEqual((result.returncode, calls), (1, []))
        self.assertEqual(result.stdout, "Missing packages: libfmt-dev\n")


if __name__ == "__main__":
    unittest.main()
