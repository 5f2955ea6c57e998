#!/usr/bin/env python3
"""Open reports in a real browser without a screen: no message on the console, every figure drawn, nothing wider than a
phone, light and dark readable, a print of few pages. Runs small cases of the program first.

browser.py --program tribodraw --source FOLDER [--browser chromium] [report.html ...]
"""
import argparse, html, json, os, pathlib, re, subprocess, sys, tempfile

PROBE = """
<script>
window.errors = [];
window.addEventListener('error', e => window.errors.push(String(e.message || e.target.src || e.type)), true);
function luminance(text) {
  const c = text.match(/[0-9.]+/g).map(Number).slice(0, 3).map(v => { v /= 255; return v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4; });
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}
window.addEventListener('load', () => {
  const root = document.documentElement, style = getComputedStyle(document.body);
  const wide = [...document.querySelectorAll('body *')].filter(e => {
    for (let p = e.parentElement; p; p = p.parentElement) if (['auto', 'scroll'].includes(getComputedStyle(p).overflowX)) return false;
    return e.getBoundingClientRect().right > innerWidth + 1;
  }).map(e => e.tagName);
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), range = document.createRange();
  const scrolled = e => { for (; e; e = e.parentElement) if (['auto', 'scroll'].includes(getComputedStyle(e).overflowX)) return true; return false; };
  for (let n = walker.nextNode(); n; n = walker.nextNode()) {
    range.selectNodeContents(n);
    if (range.getBoundingClientRect().right > innerWidth + 1 && !scrolled(n.parentElement)) wide.push(n.parentElement.tagName + ': ' + n.data.slice(0, 80));
  }
  const a = luminance(style.color), b = luminance(style.backgroundColor);
  const figures = [...document.querySelectorAll('figure')].map(f => {
    const drawing = f.querySelector('svg, img'), box = drawing ? drawing.getBoundingClientRect() : {width: 0, height: 0};
    return { caption: (f.querySelector('figcaption') || {}).textContent || '', width: box.width, height: box.height,
             loaded: drawing && (drawing.tagName !== 'IMG' || drawing.naturalWidth > 0),
             images: [...f.querySelectorAll('image')].every(i => (i.getAttribute('href') || i.getAttribute('xlink:href') || '').startsWith('data:')),
             marks: drawing ? drawing.querySelectorAll('path, polyline, line, image, rect, circle, polygon').length : 0 };
  });
  const letters = [...document.querySelectorAll('figure svg')].map(s => 14 * s.getBoundingClientRect().width / s.viewBox.baseVal.width); // 14 points in the drawing
  const small = [...document.querySelectorAll('p, td, th, li, figcaption, h1, h2')].filter(e => parseFloat(getComputedStyle(e).fontSize) < 12).length;
  parent.postMessage(JSON.stringify({ width: innerWidth, scroll: root.scrollWidth, wide: [...new Set(wide)], contrast: (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05),
    figures: figures, letters: Math.min(...letters), small: small, errors: window.errors, outside: performance.getEntriesByType('resource').map(r => r.name) }), '*');
});
</script>
"""

CASES = {
    'drawing': ['prm/cross_die.prm', '--set', 'Coupling/Friction = constant', '--set', 'Coupling/Constant friction coefficient = 0.1',
                '--set', 'Blank/Element size = 13 mm', '--set', 'Process/Punch travel = 10 mm'],
    'lubricated': ['prm/cross_die.prm', '--set', 'Blank/Element size = 13 mm', '--set', 'Process/Punch travel = 4 mm',
                   *(word for entry in ('Sheet surface', 'Tool surface') for word in ('--set', entry + '/Generated/Pixels = 96')),
                   '--set', 'Friction table/Interpolation error = 1', '--set', 'Friction table/Pressures = 1, 10, 100 MPa',
                   '--set', 'Friction table/Strains = 0, 0.1, 0.5'],
    'sheet': ['prm/shell_limit_load.prm'],
}

# Headings and figures without which the page would not be whole.
WANTED = {
    'drawing': ['force_travel', 'draw_in', 'outline', 'fld', 'thinning_cuts', 'contact_pressure_die_blank', 'conservation-and-accuracy', 'parameters-in-effect', 'how-to-cite'],
    'lubricated': ['compare_punch_force', 'measured-and-computed', 'surfaces', 'sheet_surface_map', 'tool_surface_map', 'table_phi_p', 'table_contact_fraction',
                   'friction_coefficient_die_blank', 'friction_coefficient_punch_blank', 'lubricant_pressure_die_blank', 'lubricant_pressure_punch_blank',
                   'lubrication_regime_die_blank', 'lubrication_regime_punch_blank', 'mean_friction', 'warnings', 'versions-and-provenance'],
    'sheet': ['load_displacement', 'key-figures'],
}

# Punch travel and force as a press would record them; the values do not matter here.
MEASURED = 'punch_travel_mm,punch_force_kn\n0.5,0.4\n1,0.9\n2,2\n3,3.5\n'


def browse(browser, page, *options):
    command = [browser, '--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--allow-file-access-from-files',
               '--virtual-time-budget=20000', '--enable-logging=stderr', '--user-data-dir=' + str(page.parent / 'profile'), *options, page.as_uri()]
    return subprocess.run(command, capture_output=True, text=True, timeout=180)


def inspect(browser, report, folder, width, dark):
    """What the page says of itself in a frame of the given width."""
    copy = folder / 'copy.html'
    text = report.read_text()
    if dark:
        # The frame has no setting of its own: take the rules for dark out of their condition.
        text = re.sub(r'@media\(prefers-color-scheme:dark\)\{(:root\{[^}]*\})\}', r'\1', text)
    copy.write_text(text.replace('<head>', '<head>' + PROBE, 1))
    frame = folder / 'frame.html'
    frame.write_text('<!DOCTYPE html><body style="margin:0"><iframe src="copy.html" style="border:0;width:%dpx;height:900px"></iframe><pre id="answer"></pre>'
                     '<script>addEventListener("message", e => { document.getElementById("answer").textContent = e.data; });</script></body>' % width)
    run = browse(browser, frame, '--window-size=1400,1000', '--dump-dom')
    answer = re.search(r'<pre id="answer">(.*?)</pre>', run.stdout, re.S)
    if not answer or not answer.group(1):
        sys.exit('no answer from the browser for %s:\n%s' % (report, run.stderr[-2000:]))
    result = json.loads(html.unescape(answer.group(1)))
    result['console'] = [line for line in run.stderr.splitlines() if ':CONSOLE' in line]
    return result


def check(name, report, browser, folder):
    problems = []
    listed = len(re.findall(r'<figure', report.read_text()))
    for width in (390, 1280):
        for dark in (False, True):
            r = inspect(browser, report, folder, width, dark)
            where = '%s at %d pixels, %s' % (name, width, 'dark' if dark else 'light')
            if r['console'] or r['errors']:
                problems.append('%s: console: %s' % (where, r['console'] + r['errors']))
            if r['scroll'] > r['width']:
                problems.append('%s: the page is %d pixels wide because of %s' % (where, r['scroll'], r['wide']))
            if r['contrast'] < 7:
                problems.append('%s: contrast of text %.1f' % (where, r['contrast']))
            if r['small']:
                problems.append('%s: %d texts are smaller than 12 pixels' % (where, r['small']))
            if r['letters'] < 9:
                problems.append('%s: letters of %.1f pixels in a figure' % (where, r['letters']))
            if r['outside']:
                problems.append('%s: loaded from outside: %s' % (where, r['outside']))
            if len(r['figures']) != listed or not listed:
                problems.append('%s: %d figures of %d' % (where, len(r['figures']), listed))
            for f in r['figures']:
                if not (f['loaded'] and f['images'] and f['width'] > 0.6 * min(width, 480) and f['height'] > 100 and f['marks'] > 3):
                    problems.append('%s: figure not drawn: %s' % (where, f))
    page = folder / 'report.pdf'
    browse(browser, report, '--print-to-pdf=' + str(page))
    data = page.read_bytes() if page.exists() else b''
    pages = len(re.findall(rb'/Type\s*/Page\b', data))
    if not data.startswith(b'%PDF') or not 1 <= pages <= 30:
        problems.append('%s: print has %d pages' % (name, pages))
    print('%s: %d figures, %d pages in print' % (name, listed, pages))
    return problems


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--program', required=True)
    parser.add_argument('--source', required=True)
    parser.add_argument('--browser', default='chromium')
    parser.add_argument('reports', nargs='*', help='reports that exist already, instead of the small cases')
    arguments = parser.parse_args()
    problems = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        reports = {r: pathlib.Path(r).resolve() for r in arguments.reports}
        if not reports:
            # A long path stands in messages and must not widen the page.
            source = folder / ('a_folder_with_a_long_name_' * 4)
            source.symlink_to(os.path.abspath(arguments.source))
            for case, words in CASES.items():
                output = folder / case
                run = subprocess.run([arguments.program, str(source / words[0]), '--quiet', '--output', str(output), *words[1:]],
                                     capture_output=True, text=True)
                if run.returncode != 0:
                    sys.exit('%s ended with %d:\n%s' % (case, run.returncode, run.stderr))
                reports[case] = output / 'report.html'
            (folder / 'measured.csv').write_text(MEASURED)
            run = subprocess.run([arguments.program, 'compare', str(folder / 'measured.csv'), str(folder / 'lubricated')], capture_output=True, text=True)
            if run.returncode != 0:
                sys.exit('compare ended with %d:\n%s' % (run.returncode, run.stderr))
            for case, names in WANTED.items():
                page = reports[case].read_text()
                problems += ['%s: %s is missing' % (case, name) for name in names if 'id="%s"' % name not in page]
        for case, report in reports.items():
            problems += check(case, report, arguments.browser, folder)
    print('\n'.join(problems) or 'nothing to complain about')
    sys.exit(1 if problems else 0)


main()
