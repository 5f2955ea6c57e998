#!/usr/bin/env python3
"""Run a regression case and compare its result with the expected one: run_case.py --program P --source S FOLDER

FOLDER holds arguments.txt (parameter file below the source folder, then one --set text a line), the name of the result in
its first comment, expected.csv, tolerance.csv (see compare_csv.py) and README.md (what it guards, where the numbers come from).
"""
import argparse
import os
import subprocess
import sys
import tempfile

arguments = argparse.ArgumentParser()
arguments.add_argument('--program', required=True)
arguments.add_argument('--source', required=True)
arguments.add_argument('--update', metavar='REASON', help='write expected.csv anew and note the reason in README.md')
arguments.add_argument('folder')
given = arguments.parse_args()

with open(os.path.join(given.folder, 'arguments.txt')) as lines:
    result_name, parameter_file, *settings = [line.strip() for line in lines if line.strip()]
words = [given.program, os.path.join(given.source, parameter_file), '--quiet']
for setting in settings:
    words += ['--set', setting]
with tempfile.TemporaryDirectory() as output:
    done = subprocess.run(words + ['--output', output], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f'exit code {done.returncode}; a run that does not converge is no reference\n{done.stdout}{done.stderr}')
    result, expected = os.path.join(output, result_name), os.path.join(given.folder, 'expected.csv')
    if given.update:
        with open(result) as new, open(expected, 'w') as old:
            old.write(new.read())
        with open(os.path.join(given.folder, 'README.md'), 'a') as notes:
            notes.write(f'\n- expected.csv written anew: {given.update}\n')
        sys.exit(0)
    compare = os.path.join(given.source, 'tests', 'tools', 'compare_csv.py')
    sys.exit(subprocess.run([sys.executable, compare, expected, result, os.path.join(given.folder, 'tolerance.csv')]).returncode)
