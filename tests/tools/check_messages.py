"""Every error and warning of the program stands in doc/messages.md, and no other: check_messages.py SOURCE_FOLDER [--write]

Texts are taken from the calls that make messages: describe_error(what, where, value, allowed, hint), InputError("..."),
ConvergenceError("..."), log::warning(...) and Parameters::warning(...). What is put in when the program runs is shown as `...`.
Problems of single parameters are left out: they name the entry and what is allowed, which doc/parameters.md explains.

A section of the page begins with text written by hand (cause and cure of its messages), followed by a comment
`<!-- messages: PATTERN ... -->` and the table of the messages of the files that match, which --write brings up to date.
"""
import fnmatch
import pathlib
import re
import sys

CALL = re.compile(r"(?<![\w:])(describe_error|InputError|ConvergenceError|log::warning|\w+\.warning)\s*\(")
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
MARK = re.compile(r"<!-- messages: (.*?) -->\n")
HEADER = "| Message | Allowed | What to try |\n|---|---|---|\n"
SHORTEST = 12  # characters of a text that says something


def split_arguments(text, start):
    """The arguments of a call, from after its opening parenthesis."""
    depth, position, begin, result = 0, start, start, []
    while position < len(text):
        literal = LITERAL.match(text, position)
        if literal:
            position = literal.end()
            continue
        c = text[position]
        if depth == 0 and c in "),":
            result.append(text[begin:position])
            begin = position + 1
            if c == ")":
                break
        depth += (c in "([{") - (c in ")]}")
        position += 1
    return result


def shown(argument):
    """The texts of an argument with `...` for what stands between them; empty if it has none of its own."""
    parts, position, depth = [], 0, 0
    while position < len(argument):
        literal = LITERAL.match(argument, position)
        c = argument[position]
        if literal and depth == 0:
            parts.append(literal.group(1).replace('\\"', '"').replace("\\n", " ").strip())
        elif not c.isspace():
            parts.append("...")
        depth += (c in "([{") - (c in ")]}")
        position = literal.end() if literal else position + 1
    text = re.sub(r"(\.\.\. ?)+", "... ", re.sub(r"\s+", " ", " ".join(parts))).strip().replace("`", "'").replace("|", "/")
    return text if len(text.replace("...", "").strip()) >= SHORTEST else ""


def messages(source):
    """{text: (file, allowed, hint)}"""
    found = {}
    for file in sorted((source / "source").rglob("*.cc")):
        text = re.sub(r"^\s*//.*$", "", file.read_text(), flags=re.M)
        for call in CALL.finditer(text):
            arguments = split_arguments(text, call.end())
            if not arguments or arguments[0].strip().startswith("describe_error"):
                continue
            what = shown(arguments[0])
            described = call.group(1) == "describe_error"
            allowed, hint = (shown(a) if described else "" for a in (arguments + [""] * 5)[3:5])
            if what and what not in found:
                found[what] = (file.relative_to(source / "source").as_posix(), allowed, hint)
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
