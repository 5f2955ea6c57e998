#!/usr/bin/env python3
"""Tests of compare_csv.py: above all, that it fails where it must."""
import contextlib
import io
import pathlib
import tempfile
import unittest

import compare_csv

# A film of half a micrometre and a punch force, both realistic: a tolerance that fits one is blind or deaf for the other.
EXPECTED = "travel_mm,film_mm,force_n,zone\n1,5.0e-4,52000,die\n2,4.0e-4,61000,punch\n"
TOLERANCE = ("column,abs,rel,reason\n"
             "travel_mm,0,1e-12,prescribed\n"
             "film_mm,1e-9,1e-3,solver tolerance\n"
             "force_n,1,1e-3,Newton tolerance\n"
             "zone,text,text,a name\n")


class CompareCsv(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = pathlib.Path(self.folder.name) / name
        path.write_text(text)
        return str(path)

    def run_on(self, result, expected=EXPECTED, tolerance=TOLERANCE):
        """Exit code and text of the program."""
        output = io.StringIO()
        arguments = [self.write("expected.csv", expected), self.write("result.csv", result),
                     self.write("tolerance.csv", tolerance)]
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(output):
            code = compare_csv.main(arguments)
        return code, output.getvalue()

    def assert_fails(self, text, *arguments, **keywords):
        code, output = self.run_on(*arguments, **keywords)
        self.assertEqual(code, 1, output)
        self.assertIn(text, output)

    def test_equal_files_agree(self):
        self.assertEqual(self.run_on(EXPECTED), (0, ""))

    def test_differences_within_the_tolerance_pass(self):
        # film: 1e-9 + 1e-3 * 5e-4 = 5.01e-7 is allowed
        self.assertEqual(self.run_on(EXPECTED.replace("5.0e-4", "5.005e-4")), (0, ""))

    def test_halved_film_thickness_fails(self):
        self.assert_fails("column 'film_mm', line 2: 0.00025 instead of 0.0005", EXPECTED.replace("5.0e-4", "2.5e-4"))

    def test_force_outside_its_tolerance_fails(self):
        self.assert_fails("'force_n', line 3", EXPECTED.replace("61000", "61063"))  # 1 + 61 = 62 N are allowed

    def test_the_order_of_columns_does_not_matter(self):
        swapped = "film_mm,travel_mm,force_n,zone\n5.0e-4,1,52000,die\n4.0e-4,2,61000,punch\n"
        self.assertEqual(self.run_on(swapped), (0, ""))

    def test_missing_column_fails(self):
        self.assert_fails("column 'force_n' is missing", "travel_mm,film_mm,zone\n1,5e-4,die\n2,4e-4,punch\n")

    def test_additional_column_fails(self):
        lines = EXPECTED.splitlines()
        self.assert_fails("column 'new' of", "\n".join([lines[0] + ",new"] + [line + ",1" for line in lines[1:]]))

    def test_missing_row_fails(self):
        self.assert_fails("1 rows in", "\n".join(EXPECTED.splitlines()[:2]))

    def test_additional_row_fails(self):
        self.assert_fails("3 rows in", EXPECTED + "3,4.0e-4,61000,die\n")

    def test_not_a_number_fails_on_both_sides(self):
        for word in ("nan", "inf", "", "oops"):
            self.assert_fails("not a finite number", EXPECTED.replace("52000", word))
        nan = EXPECTED.replace("52000", "nan")
        self.assert_fails("not a finite number", nan, expected=nan)

    def test_text_must_be_equal(self):
        self.assert_fails("'punch' instead of 'die'", EXPECTED.replace("die", "punch"))

    def test_column_without_tolerance_fails(self):
        self.assert_fails("'force_n' has no tolerance", EXPECTED,
                          tolerance=TOLERANCE.replace("force_n,1,1e-3,Newton tolerance\n", ""))

    def test_tolerance_without_reason_fails(self):
        self.assert_fails("no reason", EXPECTED, tolerance=TOLERANCE.replace("Newton tolerance", ""))

    def test_tolerance_for_no_column_fails(self):
        self.assert_fails("does not exist", EXPECTED, tolerance=TOLERANCE + "other,0,0,x\n")

    def test_wrong_tolerance_fails(self):
        for word in ("-1", "nan", "x"):
            self.assert_fails("not two numbers", EXPECTED, tolerance=TOLERANCE.replace("force_n,1,", f"force_n,{word},"))

    def test_expectation_without_rows_fails(self):
        header = EXPECTED.splitlines()[0] + "\n"
        self.assert_fails("nothing is compared", header, expected=header)

    def test_unreadable_files_are_told_from_differences(self):
        self.assertEqual(self.run_on("")[0], 2)
        self.assertEqual(self.run_on(EXPECTED + "3,4.0e-4\n")[0], 2)
        self.assertEqual(self.run_on(EXPECTED, tolerance="a,b\n1,2\n")[0], 2)
        with contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(compare_csv.main(["none.csv", "none.csv", "none.csv"]), 2)


if __name__ == "__main__":
    unittest.main()
