"""A law in a project of its own: extension.py BUILD SOURCE CMAKE COMPILER

Installs the build into an empty folder, configures tests/extension/project against the installed package and nothing
else, and runs prm/sheet_material.prm with the law of that project.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

BUILD = SOURCE = CMAKE = COMPILER = None
LAW = ["Sheet material/Hardening = linear", "Sheet material/Linear/Yield stress = 150 MPa",
       "Sheet material/Linear/Hardening modulus = 400 MPa"]


def run(*command, cwd=None):
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True, timeout=280)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


class Extension(unittest.TestCase):
    def test_law_of_another_project(self):
        with tempfile.TemporaryDirectory(prefix="tribodraw-extension-") as folder:
            folder = pathlib.Path(folder)
            run(CMAKE, "--install", BUILD, "--prefix", folder / "prefix")
            # Ninja is there wherever the program was built; make need not be.
            run(CMAKE, "-G", "Ninja", "-S", SOURCE / "tests/extension/project", "-B", folder / "build",
                f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}", f"-DCMAKE_CXX_COMPILER={COMPILER}")
            run(CMAKE, "--build", folder / "build")
            program = folder / "build/my_tribodraw"
            self.assertIn("linear: Linear hardening.", run(program, "list"))
            sets = [part for entry in LAW for part in ("--set", entry)]
            run(program, SOURCE / "prm/sheet_material.prm", "--output", folder / "out", *sets, cwd=folder)
            with open(folder / "out/results.csv") as file:
                results = {row["quantity"]: row["value"] for row in csv.DictReader(file)}
            # Tension along the rolling direction: the Vegter locus is scaled with it, so that the stress is the flow curve
            # s0 + H eps itself at the plastic strain reached. The shipped file reports both.
            stress, strain = float(results["uniaxial_0_stress"]), float(results["uniaxial_0_eps_p"])
            self.assertGreater(strain, 0.05)
            self.assertAlmostEqual(stress, 150 + 400 * strain, delta=1e-6 * stress)
            # The installed program does not know the law.
            known = run(folder / "prefix/bin/tribodraw", "list")
            self.assertIn("Swift", known)
            self.assertNotIn("Linear hardening.", known)


if __name__ == "__main__":
    BUILD, SOURCE = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    CMAKE, COMPILER = sys.argv[3], sys.argv[4]
    unittest.main(argv=sys.argv[:1])
