"""The shipped cross die, made so small that a run takes seconds."""
import os

SETTINGS = {
    'Blank/Element size': '13 mm',
    'Sheet surface/Generated/Pixels': '96',
    'Tool surface/Generated/Pixels': '96',
    'Friction table/Cut heights': '5',
    'Process/Punch travel': '4 mm',
    # fixed increments and tight tolerances: the path to the solution must not matter
    'Solver/First increment': '0.5 mm',
    'Solver/Largest increment': '0.5 mm',
    'Solver/Residual tolerance': '1e-9',
    'Solver/Displacement tolerance': '1e-8 mm',
}


def command(program, source, output, changes=()):
    settings = dict(SETTINGS, **dict(changes))
    if settings.get('Coupling/Friction') == 'constant':
        settings['Coupling/Constant friction coefficient'] = '0.1'
    words = [program, os.path.join(source, 'prm', 'cross_die.prm'), '--output', output, '--quiet']
    for entry, value in settings.items():
        words += ['--set', f'{entry} = {value}']
    return words


def rows(file):
    with open(file) as lines:
        header = lines.readline().strip().split(',')
        return header, [[float(x) for x in line.strip().split(',')] for line in lines]
