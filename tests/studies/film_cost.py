#!/usr/bin/env python3
"""What the lubricant costs: the cross die with constant friction, with the film staggered and iterated.

film_cost.py PROGRAM FOLDER [--travel 58] [--increments 1 2] [--element 5] [--repeat 2] [ENTRY=VALUE ...]

Time: CPU time (user and system) of the whole program, the least of the repetitions, which take turns so that all see the same
load of the machine. The friction table is made before (it is kept with the surfaces, not with the drawing); figures are left
out. The ratio to constant friction includes what another friction changes of the number of Newton iterations; `film` is the part
of timing.csv that the film itself takes, over the rest of the same run.
"""
import argparse
import csv
import os
import pathlib
import resource
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent.parent.parent
arguments = argparse.ArgumentParser()
arguments.add_argument('program')
arguments.add_argument('folder')
arguments.add_argument('--travel', type=float, default=58)
arguments.add_argument('--increments', type=float, nargs='+', default=[1, 2])
arguments.add_argument('--element', type=float, default=5)
arguments.add_argument('--repeat', type=int, default=2)
arguments.add_argument('entries', nargs='*')
given = arguments.parse_args()

CASES = {'constant': ['Coupling/Friction = constant', 'Coupling/Constant friction coefficient = 0.045'],
         'staggered': ['Coupling/Friction = lubricated', 'Coupling/Friction loop = staggered'],
         'iterated': ['Coupling/Friction = lubricated', 'Coupling/Friction loop = iterated']}


def run(name, increment, travel):
    output = pathlib.Path(given.folder) / f'{name}_{increment:g}'
    words = [given.program, here / 'prm/cross_die.prm', '--quiet', '--output', output]
    for entry in [f'Process/Punch travel = {travel} mm', f'Solver/Largest increment = {increment} mm',
                  f'Blank/Element size = {given.element} mm', 'Output/Travel between fields = 100 mm',
                  'Output/Travel between checkpoints = 0 mm'] + given.entries + CASES[name]:
        words += ['--set', entry]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    # Without gnuplot on the path no figures are drawn.
    done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, 'PATH': '/nonexistent'})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(done.stderr)
    with open(output / 'timing.csv') as file:
        wall = {row['section']: float(row['wall_s']) for row in csv.DictReader(file)}
    with open(output / 'history.csv') as file:
        rows = list(csv.DictReader(file))
    mechanics = sum(wall.get(s, 0.) for s in ('shell/assemble', 'contact/assemble', 'forming/linear solver'))
    points = [(float(r['punch_travel_mm']), float(r['punch_force_n'])) for r in rows]
    work = sum(0.5 * (b - a) * (fa + fb) for (a, fa), (b, fb) in zip(points, points[1:]))
    return {'time': after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            'film': wall.get('forming/friction coupling', 0.) / mechanics,
            'iterations': sum(int(r['newton_iterations']) for r in rows), 'force': work / points[-1][0]}


run('staggered', 1, 0.1)  # makes the friction table, which the other runs find
print(f'{"increment":>9} {"friction":10} {"CPU s":>7} {"ratio":>6} {"film":>7} {"Newton":>7} {"mean punch force kN":>20}')
for increment in given.increments:
    results = {}
    for repetition in range(given.repeat):
        for name in CASES:
            one = run(name, increment, given.travel)
            if name not in results or one['time'] < results[name]['time']:
                results[name] = one
    for name, r in results.items():
        print(f'{increment:6g} mm {name:10} {r["time"]:7.2f} {r["time"] / results["constant"]["time"]:6.3f} {100 * r["film"]:5.1f} % '
              f'{r["iterations"]:7d} {1e-3 * r["force"]:20.2f}', flush=True)
