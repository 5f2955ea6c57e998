#!/usr/bin/env python3
"""Tests of check_includes.py and check_house.py on small trees with one fault each, and of the messages that are found."""
import pathlib
import tempfile
import unittest

import check_house
import check_includes
import check_messages

SOUND = {
    "include/tribodraw/base/units.h": "#include <string>\n",
    "include/tribodraw/tools/plane.h": "#include <tribodraw/base/units.h>\n",
    "source/base/CMakeLists.txt": "tribodraw_module(base DEALII SOURCES units.cc)\n",
    "source/base/units.cc": "#include <tribodraw/base/units.h>\n#include <deal.II/base/mpi.h>\n",
    "source/tools/CMakeLists.txt": "tribodraw_module(tools SOURCES\n  motion.cc\n  plane.cc)\n",
    "source/tools/motion.cc": "#include <tribodraw/base/units.h>\n",
    "source/tools/plane.cc": '#include <tribodraw/tools/plane.h>\n'
                             '  TRIBODRAW_REGISTER(ToolGeometry, Plane, "plane", "Flat.", "")\n',
    "source/forming/CMakeLists.txt": "tribodraw_module(forming SOURCES schedule.cc)\n",
    "source/forming/schedule.cc": "#include <tribodraw/tools/plane.h>\n",
}


class Checks(unittest.TestCase):
    maxDiff = None

    def problems(self, check, changes):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {**SOUND, **changes}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return check(root)

    def assert_found(self, check, text, changes):
        problems = self.problems(check, changes)
        self.assertEqual(len(problems), 1, problems)
        self.assertIn(text, problems[0])

    def test_a_sound_tree_passes(self):
        self.assertEqual(self.problems(check_includes.check, {}), [])
        self.assertEqual(self.problems(check_house.check, {}), [])

    def test_include_to_the_right(self):
        self.assert_found(check_includes.check, "source/tools/motion.cc:2: module tools must not know module forming",
                          {"source/tools/motion.cc": "\n#include <tribodraw/forming/schedule.h>\n"})

    def test_include_of_the_same_group(self):
        self.assert_found(check_includes.check, "module tools must not know module material",
                          {"include/tribodraw/tools/plane.h": "#  include <tribodraw/material/x.h>\n"})

    def test_unknown_module(self):
        self.assert_found(check_includes.check, "of no known module",
                          {"source/tools/motion.cc": "#include <tribodraw/misc/x.h>\n"})
        self.assert_found(check_includes.check, "'misc' is not a module", {"source/misc/x.cc": "\n"})

    def test_relative_include(self):
        self.assert_found(check_includes.check, "reaches into another folder",
                          {"source/tools/motion.cc": '#include "../forming/schedule.h"\n'})

    def test_finite_elements_in_a_header(self):
        self.assert_found(check_includes.check, "a header includes 'deal.II/base/mpi.h'",
                          {"include/tribodraw/base/units.h": "#include <deal.II/base/mpi.h>\n"})

    def test_finite_elements_in_a_plain_module(self):
        self.assert_found(check_includes.check, "not marked DEALII",
                          {"source/tools/motion.cc": "#include <deal.II/base/point.h>\n"})

    def test_no_sources(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(len(check_includes.check(folder)), 1)

    def test_source_that_is_not_compiled(self):
        self.assert_found(check_house.check, "dome.cc: not listed", {"source/tools/dome.cc": "\n"})

    def test_listed_source_that_does_not_exist(self):
        self.assert_found(check_house.check, "'missing.cc' does not exist",
                          {"source/forming/CMakeLists.txt": "tribodraw_module(forming SOURCES missing.cc schedule.cc)\n"})

    def test_unsorted_list(self):
        self.assert_found(check_house.check, "not sorted",
                          {"source/tools/CMakeLists.txt": "tribodraw_module(tools SOURCES plane.cc motion.cc)\n"})

    def test_two_laws_in_a_file(self):
        law = '  TRIBODRAW_REGISTER(ToolGeometry, {0}, "{0}", "", "")\n'
        self.assert_found(check_house.check, "registers 2 laws",
                          {"source/tools/plane.cc": law.format("A") + law.format("B")})

    def test_law_named_in_forming(self):
        self.assert_found(check_house.check, "schedule.cc:2: names the law 'plane' of plane.cc",
                          {"source/forming/schedule.cc": '\nif (model == "plane")\n'})

    def test_file_too_long(self):
        self.assert_found(check_house.check, "longer than 800 lines", {"source/tools/motion.cc": "\n" * 801})

    def test_messages(self):
        # The text stands in the call of a helper: a function, a lambda, a member of an object of another file's class, one
        # that hands on to it. What such a function says itself is no further message, and problems of parameters are none.
        self.assertEqual(self.problems(check_messages.messages, MESSAGES), {
            "the header has no end (truncated?).": ("tools/motion.cc", "", "Save it again."),
            "the line ... is not a number.": ("tools/motion.cc", "more than 0 mm", ""),
            "the radius is not positive.": ("tools/motion.cc", "at most as much as ...", "Save it again."),
            "there is no column ' ... '.": ("tools/motion.cc", "", ""),
            "STL: a corner does not exist.": ("tools/plane.cc", "up to 3 corners", ""),
            "STL: a normal is zero.": ("tools/plane.cc", "", ""),
            "STL: the file ends too early.": ("tools/words.h", "", ""),
        })


MESSAGES = {
    "source/tools/motion.cc": """
      [[noreturn]] void
      fail(const std::map<int, int> &known, const std::string &what, const std::string &allowed = "")
      {
        throw InputError(describe_error(what, place(known), "", allowed, "Save it again."));
      }
      void column(const std::string &name) { throw InputError("there is no column '" + name + "'."); }
      void Numbers::read()
      {
        const auto wrong = [&](const int line, const std::string &what) {
          throw InputError(describe_error("the line " + what, "", "", "more than 0 mm"));
        };
        if (truncated)
          fail({}, "the header has no end (truncated?).");
        wrong(1, print(2) + " is not a number.");
        fail(f(1, "(,"), "the radius is " + std::string("not positive."), "at most as much as " + n);
        column("time_in_seconds");
      }
      void complain(const std::string &what) { problems.push_back(describe_error(what, "")); }
      void check() { complain("the value is out of range."); }
""",
    "source/tools/words.h": """
      struct Words
      {
        void refuse(const std::string &what, const std::string &allowed = "") const
        {
          throw InputError(describe_error("STL: " + what + ".", name, "", allowed));
        }
        void next() { refuse("the file ends too early"); }
      };
""",
    "source/tools/plane.cc": """
      #include "words.h"
      void refuse(const int number);
      void read(const Words &words)
      {
        const auto lacks = [&](const std::string &what) { words.refuse(what); };
        words.refuse("a corner does not exist", "up to 3 corners");
        lacks("a normal is zero");
        others.refuse("no such member is known", 1, 2, 3);
      }
""",
}


if __name__ == "__main__":
    unittest.main()
