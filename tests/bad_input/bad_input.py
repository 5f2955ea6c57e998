"""Spoil a parameter file and check that tribodraw finds it: bad_input.py PROGRAM FILE.prm

Each kind of mistake is made in every entry that takes effect, all in one file, because all problems of a file have to be
reported at once. Exit code 2, each culprit named with its path, nothing written.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = FILE = None
SELECTORS = {"Task", "Model", "Texture", "Friction", "Yield locus", "Hardening", "Viscosity law", "Shape", "Blank holder control",
             "Coefficients"}
# Decides like a selector, but is a list of names: mistakes in it are tested with the tools.
ROLES = {"Without"}
NUMBER = r"[-+]?[0-9]*\.?[0-9]+(?:[eE][-+]?[0-9]+)?"


class Entry:
    """A line `set Name = value` of the file with the path of its section."""

    def __init__(self, line_number, section, name, value, comment):
        self.line_number, self.section, self.name, self.value, self.comment = line_number, section, name, value, comment
        self.path = "/".join(section + [name])
        numbers = re.fullmatch(rf"({NUMBER}(?:\s*,\s*{NUMBER})*)\s*(.*)", value)
        self.numbers = numbers.group(1) if numbers else None
        self.unit = numbers.group(2) if numbers else ""

    def line(self, name=None, value=None):
        return f"set {name or self.name} = {self.value if value is None else value}{self.comment}"


def read_entries(lines):
    section, entries = [], []
    for number, raw in enumerate(lines):
        line, _, comment = raw.partition("#")
        line = line.strip()
        if line.startswith("subsection "):
            section.append(line[len("subsection "):].strip())
        elif line == "end":
            section.pop()
        elif line.startswith("set "):
            name, _, value = line[4:].partition("=")
            entries.append(Entry(number, list(section), name.strip(), value.strip(), " #" + comment if comment else ""))
    return entries


def run(arguments, cwd):
    # A mistake that is not found would start a long run.
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, timeout=60)


class BadInput(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tribodraw-bad-input-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.lines = FILE.read_text().splitlines()
        # Entries of models that are not selected only warn; they are left alone here.
        valid = run([FILE, "--validate"], self.folder)
        self.assertEqual(valid.returncode, 0, valid.stderr)
        idle = re.findall(r"'([^'\n]+)' ha(?:s|ve) no effect", valid.stdout + valid.stderr)
        self.entries = [e for e in read_entries(self.lines)
                        if not any(e.path == i or e.path.startswith(i + "/") for i in idle)]
        self.assertTrue(self.entries)

    def spoil(self, changes, arguments=()):
        """Replace the lines of entries ({entry: new text}), run the file and return what the program says."""
        lines = list(self.lines)
        for entry, text in changes.items():
            lines[entry.line_number] = text
        (self.folder / "bad.prm").write_text("\n".join(lines) + "\n")
        result = run(["bad.prm", "--output", "results", *arguments], self.folder)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertEqual([f.name for f in self.folder.iterdir()], ["bad.prm"], "something was written")
        self.assertNotIn("#0", result.stderr, "no stack trace")
        return result.stderr

    def assert_names_all(self, message, paths):
        for path in paths:
            self.assertIn(path, message)

    def test_typing_errors_are_named_with_the_right_entry(self):
        wrong = {e: e.name + "z" for e in self.entries if e.name not in SELECTORS | ROLES}
        message = self.spoil({e: e.line(name=name) for e, name in wrong.items()})
        self.assert_names_all(message, ["/".join(e.section + [name]) for e, name in wrong.items()])
        for entry in wrong:
            self.assertRegex(message, re.escape(f"'{entry.name}'"))  # did you mean

    def test_typing_errors_in_each_selector(self):
        for entry in self.entries:
            if entry.name in SELECTORS:
                with self.subTest(entry.path):
                    message = self.spoil({entry: entry.line(value=entry.value + "z")})
                    self.assert_names_all(message, [entry.path, entry.value + "z", f"Did you mean '{entry.value}'?"])

    def test_missing_units_are_named(self):
        changed = [e for e in self.entries if e.unit]
        if not changed:
            self.skipTest("no entry has a unit")
        message = self.spoil({e: e.line(value=e.numbers) for e in changed})
        self.assert_names_all(message, [e.path for e in changed])

    def test_wrong_dimensions_are_named(self):
        changed = [e for e in self.entries if e.numbers]
        message = self.spoil({e: e.line(value=e.numbers + " kg") for e in changed})  # no entry is a mass
        self.assert_names_all(message, [e.path for e in changed])

    def test_duplicates_are_named(self):
        message = self.spoil({e: e.line() + "\n" + e.line() for e in self.entries})
        for entry in self.entries:
            self.assertIn(f"{entry.path} is set twice", message)

    def test_values_out_of_range_are_named(self):
        changed = [e for e in self.entries if e.numbers]
        wrong = {e: e.line(value=re.sub(NUMBER, "-1e30", e.numbers) + " " + e.unit) for e in changed}
        message = self.spoil(wrong)
        # A wrong value may hide an entry whose unit depends on it; that one must be found when it is wrong alone.
        hidden = [e for e in changed if e.path not in message]
        self.assertLessEqual(len(hidden), 1)
        for entry in hidden:
            self.assertIn(entry.path, self.spoil({entry: wrong[entry]}))

    def test_values_that_are_not_numbers_are_named(self):
        changed = [e for e in self.entries if e.numbers]
        message = self.spoil({e: e.line(value=v + " " + e.unit)
                              for e, v in zip(changed, ["nan", "inf", "1,5e", "--1", ""] * len(changed))})
        # Nothing is a valid value where the default is an empty list.
        optional = [e.path for e in changed
                    if e.path not in message and "Default: ''" in run(["explain", e.path], self.folder).stdout]
        self.assert_names_all(message, [e.path for e in changed if e.path not in optional])
        self.assertLessEqual(len(optional), (len(changed) + 4) // 5)

    def test_missing_files_are_named(self):
        result = run(["no_such_file.prm", "--output", "results"], self.folder)
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn("no_such_file.prm", result.stderr)
        self.assertEqual(list(self.folder.iterdir()), [])
        if any(e.section[:1] == ["Sheet surface"] for e in self.entries):
            message = self.spoil({}, ["--set", "Sheet surface/Model = file", "--set", "Sheet surface/Processing/Form = plane",
                                      "--set", "Sheet surface/File/Path = no_such_map.gsf"])
            self.assert_names_all(message, ["Sheet surface/File/Path", "no_such_map.gsf"])

    def test_an_output_folder_that_cannot_be_made_is_named(self):
        (self.folder / "in_the_way").write_text("a file\n")  # holds for root too, unlike permissions
        for extra in [], ["--validate"]:
            result = run([FILE, "--output", "in_the_way/results", *extra], self.folder)
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn("in_the_way", result.stderr)
        self.assertEqual((self.folder / "in_the_way").read_text(), "a file\n")

    def test_validation_finds_the_same(self):
        entry = self.entries[-1]
        changed = {entry: entry.line(name=entry.name + "z")}
        self.assertEqual(self.spoil(changed), self.spoil(changed, ["--validate"]))


if __name__ == "__main__":
    PROGRAM, FILE = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
