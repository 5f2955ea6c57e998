"""Build the pages of the documentation and look at them: check_site.py SOURCE_FOLDER

mkdocs runs strictly (a broken link is an error). Every page, picture and formula must be there, and nothing may be loaded from a
network.
"""
import pathlib
import re
import subprocess
import sys
import tempfile


def problems(source, site):
    for page in sorted(source.glob("doc/**/*.md")):
        name = page.relative_to(source / "doc").with_suffix(".html")
        target = site / (name.with_name("index.html") if name.name == "README.html" else name)
        if not target.exists():
            yield f"{page}: there is no {target}"
            continue
        html = target.read_text()
        text = page.read_text()
        formulas = len(re.findall(r"^```math", text, re.M))
        shown = len(re.findall(r'<div class="arithmatex">', html))
        if shown < formulas:
            yield f"{page}: {formulas} formulas, {shown} of them on the page"
        for link in re.findall(r'<(?:link|script|img)[^>]*(?:href|src)="(https?:)?//[^"]*"', html):
            yield f"{target}: loads something from a network: {link}"
    if not (site / "interfaces/index.html").exists():
        yield "the pages of the interfaces are missing"


if __name__ == "__main__":
    source_folder = pathlib.Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([source_folder / "doc/site", folder], check=True)
        found = list(problems(source_folder, pathlib.Path(folder)))
    print("\n".join(found) or "The pages are complete.")
    sys.exit(bool(found))
