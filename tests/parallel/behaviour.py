#!/usr/bin/env python3
"""What a drawing says and leaves behind: without convergence, resumed with other parameters, on a terminal and elsewhere."""
import argparse
import os
import pathlib
import pty
import re
import subprocess
import tempfile
import unittest

import coarse

GIVEN = None


class Behaviour(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.output = pathlib.Path(folder.name) / "run"

    def run_program(self, changes=(), code=0, options=(), **keywords):
        changes = {"Coupling/Friction": "constant", "Process/Punch travel": "2 mm", **dict(changes)}
        words = [w for w in coarse.command(GIVEN.program, GIVEN.source, str(self.output), changes.items()) if w != "--quiet"]
        done = subprocess.run(words + list(options), stdout=keywords.get("stdout", subprocess.PIPE), stderr=subprocess.PIPE, text=True,
                              env={**os.environ, "PATH": "/nonexistent"})  # no figures
        self.assertEqual(done.returncode, code, f"{done.stdout}\n{done.stderr}")
        return done

    # Too few iterations and too little room for smaller increments: no physics needed to provoke it.
    def test_without_convergence_state_residual_and_diagnosis_are_left(self):
        hopeless = {"Solver/Maximal iterations": "6", "Solver/Smallest increment": "0.4 mm"}
        text = self.run_program(hopeless, code=3).stderr
        self.assertIn("does not converge", text)
        nodes = re.findall(r"node \d+ at \(\S+, \S+, \S+\) mm, \S+ N, touching (.*)", text)
        self.assertEqual(len(nodes), 5)
        self.assertLessEqual(set(nodes), {"Die", "Punch", "Blank holder", "no tool"})
        self.assertIn("'Solver/Maximal iterations'", text)
        vtu = (self.output / "not_converged.vtu").read_text()
        self.assertIn('Name="unbalanced_force', vtu)
        self.assertIn('Name="contact_pressure_die', vtu)
        self.assertIn("converged,0", (self.output / "results.csv").read_text())
        self.assertIn("touching", (self.output / "log.txt").read_text())
        self.assertTrue((self.output / "report.html").exists())

    def test_resuming_with_other_parameters(self):
        between = {"Output/Travel between checkpoints": "0.5 mm"}
        self.run_program(between)
        # all that differ by their names, and what may differ
        text = self.run_program({**between, "Process/Blank holder force": "120 kN", "Blank/Element size": "12 mm"}, 2, ["--resume"]).stderr
        for piece in "Process/Blank holder force: '120 kN' now, '", "Blank/Element size: '12 mm' now, '13 mm' in the checkpoint", \
                     "'Process/Punch travel' and the entries of 'Solver' and 'Output'":
            self.assertIn(piece, text)
        self.assertNotIn("Blank/Thickness", text)
        text = self.run_program({**between, "Process/Punch travel": "1 mm"}, 2, ["--resume"]).stderr
        self.assertIn("more than 1.5 mm", text)
        longer = self.run_program({"Output/Travel between checkpoints": "1 mm", "Process/Punch travel": "2.5 mm", "Solver/Maximal iterations": "40"},
                                  options=["--resume"])
        self.assertRegex(longer.stdout, r"Resumed from .*checkpoint_[12]\.bin at punch travel 1\.5 mm")
        self.assertIn("history.csv is cut back", longer.stdout)

    def test_a_checkpoint_of_another_run_in_the_folder_is_not_used(self):
        between = {"Output/Travel between checkpoints": "0.5 mm"}
        self.run_program(between)
        self.assertTrue(list(self.output.glob("checkpoint_*.bin")))
        self.run_program({"Output/Travel between checkpoints": "0 mm"})
        self.assertFalse(list(self.output.glob("checkpoint_*.bin")))

    # A line a step on a terminal and in log.txt; elsewhere on request.
    def test_steps_are_shown_on_a_terminal(self):
        step = r"\d+\.\d\d mm +\d+\.\d %  step \S+  its +\d+  residual \S+  force \S+ kN .*contact die \d+ punch \d+ nodes  mu die \S+ punch \S+ .* elapsed, .* to go"
        self.assertIsNone(re.search(step, self.run_program().stdout))
        self.assertEqual(len(re.findall(step, (self.output / "log.txt").read_text())), 4)
        self.assertEqual(len(re.findall(step, self.run_program(options=["--verbose"]).stdout)), 4)
        quiet = self.run_program(options=["--quiet"])
        self.assertNotIn("Drawing", quiet.stdout)
        reader, terminal = pty.openpty()
        self.run_program(stdout=terminal)
        os.close(terminal)
        shown = b""
        try:
            while True:
                shown += os.read(reader, 65536)
        except OSError:  # all read
            pass
        os.close(reader)
        self.assertEqual(len(re.findall(step, shown.decode())), 4)


if __name__ == "__main__":
    arguments = argparse.ArgumentParser()
    for name in ("program", "source"):
        arguments.add_argument("--" + name, required=True)
    GIVEN, rest = arguments.parse_known_args()
    unittest.main(argv=["behaviour", *rest])
