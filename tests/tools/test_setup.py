#!/usr/bin/env python3
"""Tests of the scripts in the root and of .ci/set-up, with the system's tools replaced by small stand-ins."""
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
REAL_TOOLS = ["bash", "basename", "dirname", "grep", "tail", "cat", "mkdir", "mktemp", "rm", "mv", "chmod", "tee", "awk",
              "nproc", "env"]
PACKAGES = re.search(r"packages=\((.*?)\)", (ROOT / ".ci/set-up").read_text(), re.DOTALL).group(1).split()


class Scripts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.tools = self.folder / "tools"
        self.tools.mkdir()
        self.calls = self.folder / "calls"
        for tool in REAL_TOOLS:
            (self.tools / tool).symlink_to(shutil.which(tool))
        # A build that is complete: configured with tests, nothing to compile.
        self.build = self.folder / "build"
        (self.build / "bench").mkdir(parents=True)
        (self.build / "build.ninja").write_text("")
        (self.build / "CMakeCache.txt").write_text("TRIBODRAW_TESTS:BOOL=ON\n")
        self.stand_in("ninja", "echo 'ninja: Entering directory'\n"
                               "echo '[0/2 0.01s] Re-checking globbed directories...'\n"
                               "echo 'ninja: no work to do.'")
        self.stand_in("cmake", "")
        self.stand_in("id", "echo 0")
        self.stand_in("apt-get", "")
        self.installed(PACKAGES)
        self.program(self.build / "tribodraw", 'printf "<%s>" "$@"')

    def program(self, path, body):
        path.write_text(f'#!{shutil.which("bash")}\n{body}\n')
        path.chmod(0o755)

    def stand_in(self, name, body):
        """A tool that records its call."""
        self.program(self.tools / name, f'echo "{name} $*" >>"{self.calls}"\n{body}')

    def installed(self, packages):
        lines = "\n".join(f"installed {name}" for name in packages)
        self.program(self.tools / "dpkg-query", f"echo '{lines}'")

    def called(self, name):
        lines = self.calls.read_text().splitlines() if self.calls.exists() else []
        return [line for line in lines if line.startswith(name + " ")]

    def run_script(self, *arguments, **environment):
        variables = {"PATH": str(self.tools), "TRIBODRAW_BUILD": str(self.build), "HOME": str(self.folder), **environment}
        return subprocess.run([str(ROOT / arguments[0]), *arguments[1:]], cwd=self.folder, env=variables, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    # ------------------------------------------------------------------ set-up
    def test_second_start_installs_and_configures_nothing(self):
        result = self.run_script("run", "x.prm")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "<x.prm>", ""))
        self.assertEqual(self.called("apt-get") + self.called("cmake"), [])

    def test_root_installs_only_what_is_missing(self):
        self.installed([p for p in PACKAGES if p not in ("ccache", "libmumps-dev")])
        result = self.run_script("run", "x.prm")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("installing Debian packages: libmumps-dev ccache", result.stderr)
        self.assertEqual(self.called("apt-get"),
                         ["apt-get update",
                          "apt-get install -y --no-install-recommends --no-upgrade libmumps-dev ccache"])

    def test_sudo_is_used_by_others(self):
        self.installed([p for p in PACKAGES if p != "cmake"])
        self.stand_in("id", "echo 1000")
        self.stand_in("sudo", '[[ $1 = -n ]] && exit 0; "$@"')
        result = self.run_script("run", "x.prm")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("sudo apt-get update", self.called("sudo"))
        self.assertEqual(self.called("apt-get")[-1], "apt-get install -y --no-install-recommends --no-upgrade cmake")

    def test_without_rights_the_one_command_is_printed(self):
        self.installed([p for p in PACKAGES if p != "libdeal.ii-dev"])
        self.stand_in("id", "echo 1000")
        for sudo in (False, True):
            if sudo:
                self.stand_in("sudo", "exit 1")  # asks for a password that nobody can type
            result = self.run_script("run", "x.prm")
            self.assertEqual(result.returncode, 2)
            self.assertIn("apt-get update && apt-get install -y --no-install-recommends --no-upgrade libdeal.ii-dev",
                          result.stderr)
            self.assertEqual(self.called("apt-get"), [])

    def test_failed_installation(self):
        self.installed([p for p in PACKAGES if p != "cmake"])
        self.stand_in("apt-get", "exit 100")
        result = self.run_script("test")
        self.assertEqual(result.returncode, 2)
        self.assertIn("Needed are the Debian packages: cmake", result.stderr)

    def test_a_deal_ii_of_the_users_own_is_respected(self):
        self.installed([p for p in PACKAGES if p != "libdeal.ii-dev"])
        result = self.run_script("run", "x.prm", DEAL_II_DIR="/opt/deal.II")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.called("apt-get"), [])

    # ------------------------------------------------------------------ configuring and building
    def test_fresh_clone_is_configured_once(self):
        (self.build / "build.ninja").unlink()
        self.assertEqual(self.run_script("run", "x.prm").returncode, 0)
        self.assertEqual(len(self.called("cmake")), 1)
        self.assertIn("-DCMAKE_BUILD_TYPE=Release", self.called("cmake")[0])

    def test_changed_option_configures_again(self):
        self.assertEqual(self.run_script("run", "x.prm", TRIBODRAW_WERROR="ON").returncode, 0)
        self.assertIn("-DTRIBODRAW_WERROR=ON", self.called("cmake")[0])

    def test_progress_is_shown(self):
        self.stand_in("ninja", "echo '[1/2 3s] Building a.cc'; echo 'a.cc: warning: x'; echo '[2/2 5s] Linking'")
        result = self.run_script("run", "x.prm")
        self.assertEqual(result.stdout, "<x.prm>")  # that of the program alone
        self.assertEqual(result.stderr.splitlines()[1:], ["[1/2 3s] Building a.cc", "a.cc: warning: x", "[2/2 5s] Linking"])

    def test_failing_cmake_and_compiler_stop_with_their_text(self):
        self.stand_in("ninja", "echo 'a.cc: error: oops'; exit 1")
        result = self.run_script("run", "x.prm")
        self.assertEqual(result.returncode, 1)
        self.assertIn("a.cc: error: oops", result.stderr)
        (self.build / "build.ninja").unlink()
        self.stand_in("cmake", "echo 'CMake Error: no compiler'; exit 1")
        result = self.run_script("run", "x.prm")
        self.assertEqual(result.returncode, 1)
        self.assertIn("CMake Error: no compiler", result.stderr)

    # ------------------------------------------------------------------ arguments
    def test_run_without_a_file_takes_the_cross_die(self):
        default = f"<{ROOT}/prm/cross_die.prm>"
        self.assertEqual(self.run_script("run").stdout, default)
        self.assertEqual(self.run_script("run", "--output", "dir", "--validate").stdout,
                         default + "<--output><dir><--validate>")
        self.assertEqual(self.run_script("run", "--set", "A/B = 1 mm").stdout, default + "<--set><A/B = 1 mm>")

    def test_run_passes_files_verbs_and_options_on(self):
        self.assertEqual(self.run_script("run", "--output", "dir", "a b.prm").stdout, "<--output><dir><a b.prm>")
        self.assertEqual(self.run_script("run", "list").stdout, "<list>")
        self.assertEqual(self.run_script("run", "--help").stdout, "<--help>")

    def test_exit_code_of_the_program_is_that_of_run(self):
        self.program(self.build / "tribodraw", "exit 3")
        self.assertEqual(self.run_script("run", "x.prm").returncode, 3)

    def test_test_runs_ctest_with_its_arguments(self):
        self.stand_in("ctest", "exit 8")
        self.assertEqual(self.run_script("test", "-R", "units").returncode, 8)
        self.assertEqual(self.called("ctest"), [f"ctest -j 2 --output-on-failure --output-junit {self.build}/verification/ctest.xml -R units"])

    def test_ci_turns_warnings_into_errors(self):
        self.stand_in("ctest", "")
        self.assertEqual(self.run_script(".ci/run").returncode, 0)
        self.assertIn("-DTRIBODRAW_WERROR=ON", self.called("cmake")[0])

    # ------------------------------------------------------------------ bench
    def test_bench_gathers_the_rows(self):
        self.program(self.build / "bench/bench_micro", "echo micro,666,1,1,50,CHOLMOD,4,4; echo progress >&2")
        self.program(self.build / "bench/bench_cup", "echo cup,square,35,20,300,,,")
        result = self.run_script("bench")
        self.assertEqual(result.returncode, 0, result.stderr)
        header = "bench,case,cpu_s,wall_s,peak_mb,reference,reference_cpu_s,ratio"
        self.assertEqual((self.folder / "bench.csv").read_text(),
                         header + "\nmicro,666,1,1,50,CHOLMOD,4,4\ncup,square,35,20,300,,,\n")
        self.assertIn("benchmark 'film' does not exist yet", result.stderr)
        self.assertEqual(self.run_script("bench", "cup").returncode, 0)
        self.assertEqual((self.folder / "bench.csv").read_text(), header + "\ncup,square,35,20,300,,,\n")

    def test_bench_fails_without_leaving_half_a_file(self):
        self.assertEqual(self.run_script("bench", "table").returncode, 1)  # does not exist
        self.assertEqual(self.run_script("bench", "films").returncode, 2)
        self.program(self.build / "bench/bench_micro", "echo micro,666,1,1,50,,,; exit 1")
        self.assertEqual(self.run_script("bench", "micro").returncode, 1)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir() if p.name.startswith("bench")), [])


if __name__ == "__main__":
    unittest.main()
