#!/usr/bin/env python3
"""Tests of check_links.py and check_parameters_doc.py."""
import pathlib
import tempfile
import unittest

import check_links
import check_messages
import check_parameters_doc


class Links(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "doc").mkdir()
        (self.root / "doc" / "b.md").write_text("# One `two` (three)\n# Same\n# Same\n```\n# no heading\n```\n")

    def problems(self, text):
        (self.root / "doc" / "a.md").write_text(text)
        return check_links.check(self.root)

    def test_good_links(self):
        text = "# Here\n[x](b.md) [y](b.md#one-two-three) [z](#here) [s](b.md#same-1) [w](https://example.org/none)"
        self.assertEqual(self.problems(text), [])

    def test_missing_file(self):
        self.assertEqual(len(self.problems("[x](c.md) and ![picture](figure.svg)")), 2)

    def test_missing_image_tag(self):
        self.assertEqual(len(self.problems('<img src="figure.png">')), 1)

    def test_missing_heading(self):
        self.assertEqual(len(self.problems("[x](b.md#no-heading) [y](#nowhere) [z](b.md#same-2)")), 3)

    def test_outside_of_the_repository(self):
        self.assertEqual(len(self.problems("[x](../../etc)")), 1)

    def test_code_is_no_link(self):
        self.assertEqual(self.problems("`[x](c.md)`\n```\n[x](c.md)\n```\n"), [])


class Messages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "source" / "film").mkdir(parents=True)
        (self.root / "source" / "film" / "a.cc").write_text(
            'throw InputError(describe_error("The gap is " + f(x, ")") + " um wide.", file, "", "1 um", "Open the gap a little."));\n'
            '// log::warning("Not a message at all.");\nlog::warning("The film did not settle.");')

    def test_texts_are_taken_with_what_is_allowed_and_the_hint(self):
        self.assertEqual(check_messages.messages(self.root), {"The gap is ... um wide.": ("film/a.cc", "", "Open the gap a little."),
                                                              "The film did not settle.": ("film/a.cc", "", "")})

    def test_a_message_without_section_and_a_stale_table_are_found(self):
        page, problems = check_messages.tables(self.root, "text\n")
        self.assertEqual(len(problems), 2)
        page, problems = check_messages.tables(self.root, "text\n<!-- messages: film/* -->\n| old | | |\nend\n")
        self.assertEqual(problems, [])
        self.assertNotIn("old", page)
        self.assertIn("| The film did not settle. |", page)
        self.assertTrue(page.endswith("|\nend\n"))


class Parameters(unittest.TestCase):
    GOOD = f"# Parameters\n{check_parameters_doc.HEADER}\n|---|---|---|---|---|\n| Sq | um | a \\| b | required | Height. |\n"

    def test_good_table(self):
        self.assertEqual(check_parameters_doc.entries_without_meaning(self.GOOD), [])

    def test_entry_without_text(self):
        for meaning in ("", "Default: usual."):
            text = self.GOOD.replace("Height.", meaning)
            self.assertEqual(len(check_parameters_doc.entries_without_meaning(text)), 1)

    def test_no_entries(self):
        self.assertEqual(len(check_parameters_doc.entries_without_meaning("# Parameters\n")), 1)

    def test_difference_is_shown_with_the_remedy(self):
        self.assertEqual(check_parameters_doc.differences(self.GOOD, self.GOOD, "p.md"), [])
        shown = check_parameters_doc.differences(self.GOOD, self.GOOD.replace("um", "mm"), "p.md")
        self.assertTrue(any(line.startswith("+| Sq | um") for line in shown))
        self.assertIn("tribodraw parameters > doc/parameters.md", shown[-1])


if __name__ == "__main__":
    unittest.main()
