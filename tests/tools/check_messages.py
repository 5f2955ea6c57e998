"""Every error and warning of the program stands in doc/messages.md, and no other: check_messages.py SOURCE_FOLDER [--write]

Texts are taken from the calls that make messages: describe_error(what, where, value, allowed, hint), InputError("..."),
ConvergenceError("..."), log::warning(...) and Parameters::warning(...), and from the calls of functions and lambdas that hand
one of their arguments on to these (message_helpers.py). What is put in when the program runs is shown as `...`.
Problems of single parameters are left out: they name the entry and what is allowed, which doc/parameters.md explains.

A section of the page begins with text written by hand (cause and cure of its messages), followed by a comment
`<!-- messages: PATTERN ... -->` and the table of the messages of the files that match, which --write brings up to date.
"""
import fnmatch
import pathlib
import re
import sys

from message_helpers import Sources, shown

MARK = re.compile(r"<!-- messages: (.*?) -->\n")
HEADER = "| Message | Allowed | What to try |\n|---|---|---|\n"


def messages(source):
    """{text: (file, allowed, hint)}"""
    found = {}
    for file, what, allowed, hint in Sources(source / "source").messages():
        text = shown(what)
        if text and text not in found:
            found[text] = (file, shown(allowed), shown(hint))
    return found


def tables(source, page):
    """The page with its tables as the program has them, and the messages that belong to no section."""
    left = messages(source)
    pieces = MARK.split(page)
    text = pieces[0]
    for patterns, rest in zip(pieces[1::2], pieces[2::2]):
        chosen = [what for what, (file, _, _) in left.items() if any(fnmatch.fnmatch(file, p) for p in patterns.split())]
        rows = "".join(f"| {what} | {left[what][1]} | {left[what][2]} |\n" for what in chosen)
        for what in chosen:
            del left[what]
        text += f"<!-- messages: {patterns} -->\n" + HEADER + rows + re.sub(r"^(\|.*\n)*", "", rest)
    return text, [f"source/{file}: no section of doc/messages.md has this message: {what}" for what, (file, _, _) in left.items()]


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    target = root / "doc" / "messages.md"
    before = target.read_text()
    after, problems = tables(root, before)
    if "--write" in sys.argv:
        target.write_text(after)
    elif before != after:
        problems.append("doc/messages.md is not up to date: python3 tests/tools/check_messages.py . --write")
    print("\n".join(problems) or "All messages are explained.")
    sys.exit(bool(problems))
