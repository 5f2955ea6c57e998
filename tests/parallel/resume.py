#!/usr/bin/env python3
"""The same input gives the same bytes; a run that is killed and resumed ends with the same bytes as an uninterrupted one."""
import argparse
import filecmp
import os
import shutil
import subprocess
import sys
import tempfile

import coarse

arguments = argparse.ArgumentParser()
for name in ('program', 'source'):
    arguments.add_argument('--' + name, required=True)
given = arguments.parse_args()
FILES = ('history.csv', 'energy.csv', 'nodes_final.csv', 'elements_final.csv', 'solution.pvd', 'tools.pvd', 'view.py')


def run(output, changes=(), options=()):
    changes = {'Output/Travel between checkpoints': '1 mm', 'Output/Travel between fields': '1 mm', **dict(changes)}
    done = subprocess.run(coarse.command(given.program, given.source, output, changes.items()) + list(options),
                          capture_output=True, text=True)
    if done.returncode:
        sys.exit(f'exit code {done.returncode}\n{done.stdout}\n{done.stderr}')


def compare(a, b, what):
    names = [n for n in sorted(os.listdir(a)) if n in FILES or n.endswith('.vtu')]
    if not any(n.endswith('.vtu') for n in names):
        sys.exit('no VTU files')
    different = [n for n in names if not filecmp.cmp(os.path.join(a, n), os.path.join(b, n), shallow=False)]
    if different:
        sys.exit(f'{what}: different bytes in {", ".join(different)}')
    print(f'{what}: {len(names)} files with the same bytes')


with tempfile.TemporaryDirectory() as folder:
    whole, again, cut = (os.path.join(folder, name) for name in ('whole', 'again', 'cut'))
    run(whole)
    run(again)
    compare(whole, again, 'repeated')
    # stopped after 2 mm of 4, then told to go on to the end
    run(cut, {'Process/Punch travel': '2 mm'})
    # what a shorter run wrote at its end must not survive: go on from the checkpoint before the end
    run(cut, (), ['--resume'])
    compare(whole, cut, 'resumed')
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
