#!/usr/bin/env python3
"""What the lubricant costs: time of the cross die with constant friction, with the film staggered and iterated.

film_cost.py PROGRAM FOLDER [--travel 30] [--increment 1] [--element 5] [ENTRY=VALUE ...]

Time: wall time of shell, contact, linear solver and film in timing.csv (needs a quiet machine), without table and figures. It
differs also because friction changes the number of Newton iterations; `film` is the part of the film over the rest of the
same run.
"""
import argparse
import csv
import pathlib
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent.parent.parent
arguments = argparse.ArgumentParser()
arguments.add_argument('program')
arguments.add_argument('folder')
arguments.add_argument('--travel', type=float, default=30)
arguments.add_argument('--increment', type=float, default=1)
arguments.add_argument('--element', type=float, default=5)
arguments.add_argument('entries', nargs='*')
given = arguments.parse_args()


def run(name, entries, travel):
    output = pathlib.Path(given.folder) / name
    words = [given.program, here / 'prm/cross_die.prm', '--quiet', '--output', output]
    for entry in [f'Process/Punch travel = {travel} mm', f'Solver/Largest increment = {given.increment} mm',
                  f'Blank/Element size = {given.element} mm', 'Output/Travel between fields = 100 mm'] + given.entries + entries:
        words += ['--set', entry]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    with open(output / 'timing.csv') as file:
        wall = {row['section']: float(row['wall_s']) for row in csv.DictReader(file)}
    with open(output / 'history.csv') as file:
        rows = list(csv.DictReader(file))
    mechanics = sum(wall.get(s, 0.) for s in ('shell/assemble', 'contact/assemble', 'forming/linear solver'))
    film = wall.get('forming/friction coupling', 0.)
    return {'time': mechanics + film, 'film': film / mechanics,
            'iterations': sum(int(r['newton_iterations']) for r in rows), 'force': float(rows[-1]['punch_force_n'])}


lubricated = ['Coupling/Friction = lubricated']
run('table', lubricated, 0.1)  # makes the friction table, which the other runs find
results = {'staggered': run('staggered', lubricated, given.travel),
           'iterated': run('iterated', lubricated + ['Coupling/Friction loop = iterated'], given.travel),
           'constant': run('constant', ['Coupling/Friction = constant', 'Coupling/Constant friction coefficient = 0.045'], given.travel)}
print(f'{"friction":10} {"time s":>7} {"ratio":>6} {"film":>7} {"Newton":>7} {"punch force kN":>15}')
for name in ('constant', 'staggered', 'iterated'):
    r = results[name]
    print(f'{name:10} {r["time"]:7.2f} {r["time"] / results["constant"]["time"]:6.3f} {100 * r["film"]:5.1f} % {r["iterations"]:7d} {1e-3 * r["force"]:15.2f}')
