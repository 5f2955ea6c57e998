#!/usr/bin/env python3
"""Open results in ParaView without a screen: view.py of small cases is run by pvpython, in a folder that was moved.

paraview.py --program tribodraw --source FOLDER [--pvpython pvpython] [--pictures FOLDER]

Every view must colour its field by a finite range over all steps, have a colour bar with a title and, in a drawing, the tools
transparent; nothing may be complained about.
"""
import argparse, atexit, json, os, pathlib, shutil, struct, subprocess, sys, tempfile

CASES = {
    'drawing': (['prm/cross_die.prm', '--set', 'Coupling/Friction = constant', '--set', 'Coupling/Constant friction coefficient = 0.1',
                 '--set', 'Blank/Element size = 13 mm', '--set', 'Process/Punch travel = 4 mm', '--set', 'Output/Travel between fields = 2 mm'],
                6, ['thinning', 'friction_coefficient_die', 'contact_pressure_punch']),
    'unloaded': (['prm/cross_die.prm', '--set', 'Coupling/Friction = constant', '--set', 'Coupling/Constant friction coefficient = 0.1',
                  '--set', 'Blank/Element size = 13 mm', '--set', 'Process/Punch travel = 2 mm', '--set', 'Process/Unloading = tools removed'],
                 6, ['thinning', 'friction_coefficient_punch']),
    'film': (['prm/squeeze_film.prm', '--set', 'Gap/Elements along = 20'], 3, ['lubricant_pressure', 'film_thickness']),
    'sheet': (['prm/shell_limit_load.prm'], 3, ['displacement', 'largest_plastic_strain']),
}

# Appended to view.py: what ParaView has made of it.
QUESTIONS = """
import json
answer = []
for view in GetRenderViews():
    one = {'camera': list(view.CameraPosition), 'shown': []}
    for shown in view.Representations:
        if not getattr(shown, 'Visibility', 0) or not hasattr(shown, 'Opacity'):
            continue
        array = shown.ColorArrayName
        entry = {'opacity': shown.Opacity, 'field': array[1] if len(array) > 1 else '', 'points': shown.Input.GetDataInformation().GetNumberOfPoints()}
        if entry['field']:
            table = GetColorTransferFunction(entry['field'])
            entry['range'] = [table.RGBPoints[0], table.RGBPoints[-4]]
            entry['bar'] = GetScalarBar(table, view).Title
        one['shown'].append(entry)
    answer.append(one)
print('ANSWER', json.dumps({'steps': len(solution.TimestepValues), 'views': answer}))
"""


def open_result(command, folder, picture):
    script = folder / 'view_and_questions.py'
    script.write_text((folder / 'view.py').read_text() + QUESTIONS)
    run = subprocess.run([*command, '--force-offscreen-rendering', str(script), str(picture)], capture_output=True, text=True, timeout=300, cwd='/')
    lines = [line for line in run.stdout.splitlines() if line.startswith('ANSWER')]
    complaints = [line for line in (run.stdout + run.stderr).splitlines() if not line.startswith('ANSWER') and line.strip()]
    if run.returncode or complaints or not lines:
        return None, ['ParaView ended with %d: %s' % (run.returncode, complaints[-8:])]
    return json.loads(lines[0][7:]), []


def check(name, command, folder, picture, n_views, fields):
    answer, problems = open_result(command, folder, picture)
    if problems:
        return ['%s: %s' % (name, p) for p in problems]
    views = answer['views']
    if len(views) != n_views:
        problems.append('%d views, expected %d' % (len(views), n_views))
    coloured = [shown for view in views for shown in view['shown'] if shown['field']]
    if len(coloured) != n_views or not set(fields) <= {shown['field'] for shown in coloured}:
        problems.append('fields shown: %s' % [shown['field'] for shown in coloured])
    for shown in coloured:
        low, high = shown['range']
        if not (-1e9 < low <= high < 1e9) or not shown['bar'] or not shown['points']:
            problems.append('field without range, title or points: %s' % shown)
    if name == 'drawing':
        if answer['steps'] < 3:
            problems.append('%d steps' % answer['steps'])
        for view in views:
            tools = [shown for shown in view['shown'] if not shown['field']]
            if [t['opacity'] for t in tools] != [0.15] or not tools[0]['points']:
                problems.append('tools: %s' % tools)
    data = picture.read_bytes() if picture.exists() else b''
    width, height = struct.unpack('>II', data[16:24]) if data.startswith(b'\x89PNG') else (0, 0)
    if width < 1000 or height < 500 or len(data) < 20000:
        problems.append('picture of %d x %d pixels, %d bytes' % (width, height, len(data)))
    print('%s: %d views, %d steps' % (name, len(views), answer['steps']))
    return ['%s: %s' % (name, p) for p in problems]


def start_screen():
    """A screen in memory, ready when this returns: Debian's ParaView draws through X. Xvfb chooses a free number itself."""
    if not shutil.which('Xvfb'):
        print('skipped: there is neither a screen nor Xvfb')
        sys.exit(77)
    ready, tell = os.pipe()
    server = subprocess.Popen(['Xvfb', '-displayfd', str(tell), '-screen', '0', '1600x1000x24', '-nolisten', 'tcp'], pass_fds=[tell],
                              stderr=subprocess.DEVNULL)
    atexit.register(lambda: (server.terminate(), server.wait()))
    os.close(tell)
    with os.fdopen(ready) as answer:
        number = answer.readline().strip()
    if not number:
        print('skipped: Xvfb does not start here')
        sys.exit(77)
    os.environ['DISPLAY'] = ':' + number


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--program', required=True)
    parser.add_argument('--source', required=True)
    parser.add_argument('--pvpython', default='pvpython')
    parser.add_argument('--pictures', help='folder in which the pictures are kept')
    arguments = parser.parse_args()
    if not os.environ.get('DISPLAY'):
        start_screen()
    problems = []
    with tempfile.TemporaryDirectory() as name:
        for case, (words, n_views, fields) in CASES.items():
            written, folder = pathlib.Path(name) / 'first' / case, pathlib.Path(name) / 'moved' / case
            run = subprocess.run([arguments.program, str(pathlib.Path(arguments.source) / words[0]), '--quiet', '--output', str(written), *words[1:]],
                                 capture_output=True, text=True)
            if run.returncode != 0:
                sys.exit('%s ended with %d:\n%s' % (case, run.returncode, run.stderr))
            folder.parent.mkdir(exist_ok=True)
            written.rename(folder)
            picture = pathlib.Path(arguments.pictures or name) / (case + '.png')
            problems += check(case, [arguments.pvpython], folder, picture, n_views, fields)
    print('\n'.join(problems) or 'nothing to complain about')
    sys.exit(1 if problems else 0)


main()
