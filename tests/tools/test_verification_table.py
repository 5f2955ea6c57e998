#!/usr/bin/env python3
"""Tests of doc/verification_table: everything the tests wrote stands on the page, failures first."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

RESULTS = """<?xml version="1.0" encoding="UTF-8"?>
<testsuites tests="2" failures="1" timestamp="2026-01-02T03:04:05" name="AllTests"><testsuite name="Film" tests="2">
<testcase name="Slider" status="run" classname="Film"><properties>
<property name="claim_0" value="slider, load&#x9;closed form&#x9;0.1588&#x9;0.15888 ± 3e-05&#x9;holds"/>
<property name="other" value="not a claim"/></properties></testcase>
<testcase name="Step" status="run" classname="Film"><failure message="wrong" type=""/><properties>
<property name="claim_1" value="step | load&#x9;closed form&#x9;0.2&#x9;0.16667 ± 1e-06&#x9;fails"/></properties></testcase>
</testsuite></testsuites>
"""

CTEST = """<?xml version="1.0" encoding="UTF-8"?>
<testsuite name="x" tests="3"><testcase name="check_house" status="run" time="1.5"/><testcase name="extension" status="fail" time="2"/>
<testcase name="results_in_paraview" status="notrun" time="0"/></testsuite>
"""


class VerificationTable(unittest.TestCase):
    def make(self, folder):
        return subprocess.run([sys.executable, "-B", str(ROOT / "doc/verification_table"), folder], capture_output=True, text=True)

    def test_failures_stand_first_and_nothing_is_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            results = pathlib.Path(folder) / "verification"
            results.mkdir()
            (results / "test_lubrication.xml").write_text(RESULTS)
            (results / "test_output.xml").write_text('<testsuites tests="0"/>')
            (results / "ctest.xml").write_text(CTEST)
            done = self.make(folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            page = (results / "measured.md").read_text()
        self.assertIn("2 claims, 1 fail. 2 unit tests, 1 fail. 3 entries of ctest, 1 fail, 1 were not run.", page)
        self.assertIn("2026-01-02", page)
        failing, rest = page.split("## lubrication")
        for text in "| test_lubrication | claim: step \\| load |", "| test_lubrication | Film.Step |", "| ctest | extension |":
            self.assertIn(text, failing)
        self.assertIn("| slider, load | 0.1588 | 0.15888 ± 3e-05 | closed form | ✓ |", rest)
        self.assertIn("| step \\| load | 0.2 | 0.16667 ± 1e-06 | closed form | **fails** |", rest)
        self.assertIn("| results_in_paraview | not run | 0 |", rest)

    def test_without_results_there_is_no_page(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.make(folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn("run ./test first", done.stderr)

    def test_every_module_makes_claims(self):
        total = 0
        for module in (ROOT / "tests/unit").iterdir():
            claims = sum(file.read_text().count("claims::agrees(") + file.read_text().count("claims::below(") + file.read_text().count("claims::at_least(")
                         for file in module.glob("*.[ch]*"))
            total += claims
            if module.name != "application":  # not in C++
                self.assertGreater(claims, 0, module.name)
        self.assertGreater(total, 40)


if __name__ == "__main__":
    unittest.main()
