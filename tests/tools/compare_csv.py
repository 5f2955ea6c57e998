#!/usr/bin/env python3
"""Compare a CSV result with an expected one, with a tolerance for each column.

    compare_csv.py EXPECTED.csv RESULT.csv TOLERANCE.csv

TOLERANCE.csv has the columns column,abs,rel,reason: one row for each column of EXPECTED.csv. A value passes if
|result - expected| <= abs + rel |expected|, abs being in the unit of that column: a film thickness in um needs
another one than a force in N. Columns of text must be equal: abs and rel are then `text`.

Fails (exit code 1) on a missing or additional column, a different number of rows, a value that is not a finite
number, a column without tolerance, a tolerance without column or reason. Exit code 2: a file cannot be read.
"""
import csv
import math
import sys


class Unreadable(Exception):
    pass


def read(path):
    try:
        with open(path, newline="") as stream:
            rows = [row for row in csv.reader(stream) if row]
    except (OSError, UnicodeDecodeError) as error:
        raise Unreadable(f"{path}: {error}")
    if not rows:
        raise Unreadable(f"{path}: the file is empty")
    header, body = rows[0], rows[1:]
    if len(set(header)) != len(header):
        raise Unreadable(f"{path}: a column name appears twice")
    for number, row in enumerate(body, start=2):
        if len(row) != len(header):
            raise Unreadable(f"{path}:{number}: {len(row)} values for {len(header)} columns")
    return header, body


def finite(text):
    """The number, or None if the text is not a finite one."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def read_tolerances(path, problems):
    header, body = read(path)
    if header != ["column", "abs", "rel", "reason"]:
        raise Unreadable(f"{path}: the columns must be column,abs,rel,reason")
    tolerances = {}
    for column, absolute, relative, reason in body:
        if column in tolerances:
            problems.append(f"{path}: column '{column}' has two tolerances")
        if not reason.strip():
            problems.append(f"{path}: the tolerance of '{column}' has no reason")
        if absolute == relative == "text":
            tolerances[column] = "text"
            continue
        pair = (finite(absolute), finite(relative))
        if None in pair or min(pair) < 0:
            problems.append(f"{path}: the tolerance of '{column}' is not two numbers >= 0")
            pair = (0.0, 0.0)
        tolerances[column] = pair
    return tolerances


def compare_column(name, expected, result, tolerance, problems):
    worst = None
    for row, (a, b) in enumerate(zip(expected, result), start=2):
        if tolerance == "text":
            if a != b:
                problems.append(f"column '{name}', line {row}: '{b}' instead of '{a}'")
                return
            continue
        x, y = finite(a), finite(b)
        if x is None or y is None:
            problems.append(f"column '{name}', line {row}: not a finite number ('{a}' expected, '{b}' found)")
            return
        allowed = tolerance[0] + tolerance[1] * abs(x)
        excess = abs(y - x) - allowed
        if excess > 0 and (worst is None or excess > worst[0]):
            worst = (excess, row, x, y, allowed)
    if worst:
        _, row, x, y, allowed = worst
        problems.append(f"column '{name}', line {row}: {y!r} instead of {x!r}; "
                        f"difference {abs(y - x):.6g}, allowed {allowed:.6g}")


def compare(expected_file, result_file, tolerance_file):
    """List of problems, empty if the files agree."""
    problems = []
    tolerances = read_tolerances(tolerance_file, problems)
    expected_header, expected = read(expected_file)
    result_header, result = read(result_file)
    for name in expected_header:
        if name not in result_header:
            problems.append(f"column '{name}' is missing in {result_file}")
        if name not in tolerances:
            problems.append(f"column '{name}' has no tolerance in {tolerance_file}")
    problems += [f"column '{name}' of {result_file} is not expected"
                 for name in result_header if name not in expected_header]
    problems += [f"{tolerance_file} has a tolerance for '{name}', which does not exist"
                 for name in tolerances if name not in expected_header]
    if not expected:
        problems.append(f"{expected_file} has no rows, so that nothing is compared")
    if len(expected) != len(result):
        problems.append(f"{len(result)} rows in {result_file}, {len(expected)} expected")
    for name in expected_header:
        if name in result_header and name in tolerances:
            i, j = expected_header.index(name), result_header.index(name)
            compare_column(name, [row[i] for row in expected], [row[j] for row in result],
                           tolerances[name], problems)
    return problems


def main(arguments):
    if len(arguments) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        problems = compare(*arguments)
    except Unreadable as error:
        print(f"compare_csv: {error}", file=sys.stderr)
        return 2
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
