#!/usr/bin/env python3
"""Check that doc/parameters.md is what the program says about its parameters.

    check_parameters_doc.py PROGRAM DOCUMENT

Every entry must have a meaning beyond the reason of its default. Prints what is wrong; exit code 1 if anything is.
"""
import difflib
import pathlib
import re
import subprocess
import sys

COLUMNS = 5  # entry, unit, allowed, default, meaning
HEADER = "| Entry | Unit | Allowed | Default | Meaning |"


def rows(text):
    """Section and cells of every entry."""
    section = ""
    for line in text.splitlines():
        if line.startswith("#"):
            section = line.strip("# ")
        elif line.startswith("| ") and line != HEADER:
            yield section, [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]


def entries_without_meaning(text):
    problems = []
    n = 0
    for section, cells in rows(text):
        n += 1
        if len(cells) != COLUMNS:
            problems.append(f"{section}: {len(cells)} columns instead of {COLUMNS}: {cells}")
        elif not cells[4].split("Default:")[0].strip():
            problems.append(f"{section}/{cells[0]}: no text says what the entry means")
    if n == 0:
        problems.append("no parameter found")
    return problems


def differences(program_text, document_text, document):
    if program_text == document_text:
        return []
    lines = list(difflib.unified_diff(document_text.splitlines(), program_text.splitlines(), str(document),
                                      "tribodraw parameters", lineterm="", n=0))
    shown = [line[:160] for line in lines[:20]]
    if len(lines) > len(shown):
        shown.append(f"... and {len(lines) - len(shown)} more lines")
    return shown + [f"{document} is out of date. Write it again: tribodraw parameters > doc/parameters.md"]


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    document = pathlib.Path(arguments[1])
    text = subprocess.run([arguments[0], "parameters"], check=True, capture_output=True, encoding="utf-8",
                          timeout=60).stdout
    written = document.read_text(encoding="utf-8") if document.exists() else ""
    problems = entries_without_meaning(text) + differences(text, written, document)
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
