#!/usr/bin/env python3
"""Run the coarse cross die on 1 and on 2 ranks with fixed increments and compare history.csv."""
import argparse
import os
import subprocess
import sys
import tempfile

import coarse

# Newton stops at 1e-9 of the contact forces, which leaves about that much in forces and displacements; the issue of
# the deep drawing solver asks for 1e-6.
RELATIVE = 1e-6
# Below these a column is round-off: forces in N, lengths in mm, pressures in MPa.
ABSOLUTE = {'lubricant_volume_error': 1e-12, 'starved_area_fraction': 1e-9}

arguments = argparse.ArgumentParser()
for name in ('program', 'mpiexec', 'source', 'friction'):
    arguments.add_argument('--' + name, required=True)
given = arguments.parse_args()

with tempfile.TemporaryDirectory() as folder:
    results = []
    for ranks in (1, 2):
        output = os.path.join(folder, f'ranks_{ranks}')
        changes = {'Coupling/Friction': given.friction}
        if given.friction == 'constant':
            changes['Process/Punch travel'] = '10 mm'  # lubricated runs take longer
        words = coarse.command(given.program, given.source, output, changes.items())
        launch = [given.mpiexec, '--allow-run-as-root', '--oversubscribe', '-n', str(ranks)]
        done = subprocess.run(launch + words, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f'{ranks} ranks: exit code {done.returncode}\n{done.stdout}\n{done.stderr}')
        results.append(coarse.rows(os.path.join(output, 'history.csv')))

(header, one), (_, two) = results
wrong = []
if len(one) != len(two) or len(one) < 8:
    wrong.append(f'{len(one)} rows on 1 rank, {len(two)} on 2')
for a, b in zip(one, two):
    for column, x, y in zip(header, a, b):
        if column == 'newton_iterations':
            continue
        scale = max(abs(row[header.index(column)]) for row in one)
        if not abs(x - y) <= RELATIVE * scale + ABSOLUTE.get(column, 0.):
            wrong.append(f'travel {a[1]} mm, {column}: {x!r} on 1 rank, {y!r} on 2')
print('\n'.join(wrong) if wrong else f'{len(one)} rows agree')
sys.exit(1 if wrong else 0)
