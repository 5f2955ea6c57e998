"""The calls that make a message of the program, also through helpers.

A helper is a function or a lambda that throws or logs a message whose text is one of its own parameters, but for what stands
around it: `void fail(const std::string &what) { throw InputError(describe_error("SDF: " + what + ".", file)); }`. What its
callers say are messages then; a text that only puts in a name ("there is no column '" + name + "'.") is one by itself. A
helper may hand on to another one. C++ is read as text here, not compiled: a call belongs to the helper of
its name that takes as many arguments and is a member of the object's class, or stands in the same file, or in one whose
header is included.
"""
import dataclasses
import re

LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')
CALL = re.compile(r"(?<![\w:])(describe_error|InputError|ConvergenceError|log::warning|\w+\.warning)\s*\(")
HEAD = re.compile(r"(?<![\w:])((?:\w+::)*\w+)\s*(=\s*\[[^\]]*\]\s*)?\(")  # of a function or a lambda with a name
TO_BODY = re.compile(r"\)(?:\s|const\b|noexcept\b|override\b|->\s*[\w:]+)*\{")
CLASS = re.compile(r"\b(?:class|struct)\s+(\w+)[^;{}()]*\{")
NAME = re.compile(r"(?<![\w.>:])[A-Za-z_]\w*")
INCLUDE = re.compile(r'#\s*include [<"](?:tribodraw/)?([\w/]+)\.h[>"]')
SHORTEST = 12  # characters of a text that says something
KEYWORDS = ("if", "for", "while", "switch", "catch", "return")


def balanced(text, start, stops):
    """Each character from start on that is one of the stops and stands in no literal and no inner bracket."""
    depth, position = 0, start
    while position < len(text):
        literal = LITERAL.match(text, position)
        if literal:
            position = literal.end()
            continue
        c = text[position]
        if depth == 0 and c in stops:
            yield position
        depth += (c in "([{") - (c in ")]}")
        if depth < 0:
            return
        position += 1


def split_arguments(text, start):
    """The arguments of a call, from after its opening parenthesis, and where it is closed."""
    result, begin = [], start
    for position in balanced(text, start, "),"):
        result.append(text[begin:position].strip())
        begin = position + 1
    return ([] if result == [""] else result), begin - 1


def end_of_block(text, start):
    """Where the block ends that begins after an opening brace."""
    return next(balanced(text, start, "}"), len(text))


def parameters_of(arguments):
    """{name: default or None} of the parameters of a definition."""
    whole, result = [], {}
    for piece in arguments:
        if whole and whole[-1].count("<") > whole[-1].count(">"):
            whole[-1] += "," + piece  # a comma between the arguments of a template
        else:
            whole.append(piece)
    for number, piece in enumerate(whole):
        declared, _, default = piece.partition("=")
        name = re.search(r"(\w+)\s*$", declared)
        result[name.group(1) if name else str(number)] = default.strip() or None
    return result


def merged(expression):
    """The expression with literals that are added to each other as one."""
    literal = LITERAL.pattern
    expression = re.sub(rf"std::string\(\s*({literal})\s*\)", r"\1", expression)
    return re.sub(rf"{literal}(\s*\+\s*{literal})+",
                  lambda run: '"' + "".join(m.group(1) for m in LITERAL.finditer(run.group())) + '"', expression)


def shown(argument):
    """The texts of an argument with `...` for what stands between them; empty if it has none of its own."""
    argument, parts, position, depth = merged(argument), [], 0, 0
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


@dataclasses.dataclass
class Function:
    file: str
    name: str
    owner: str        # its class; empty: none
    is_lambda: bool
    parameters: dict  # {name: default or None}, in their order
    opening: int      # where its parameters begin
    body: tuple       # from and to
    scope: tuple = (0, 1 << 60)  # of a lambda: the body it stands in
    message: tuple = ()          # of a helper: text, allowed and hint, in terms of its parameters

    def takes(self, arguments):
        required = sum(default is None for default in self.parameters.values())
        return required <= len(arguments) <= len(self.parameters)

    def message_of(self, arguments):
        """What a call of this helper says; what is not known at the call becomes `_`."""
        given = {**self.parameters, **dict(zip(self.parameters, arguments))}
        pieces = []
        for expression in self.message:
            code = re.split(r'("(?:[^"\\]|\\.)*")', expression)  # literals are at the odd places
            code[::2] = [NAME.sub(lambda name: given.get(name.group(), "_"), piece) for piece in code[::2]]
            pieces.append(merged("".join(code)))
        return tuple(pieces)


def functions_of(file, text):
    classes = [(c.group(1), c.end(), end_of_block(text, c.end())) for c in CLASS.finditer(text)]
    result = []
    for head in HEAD.finditer(text):
        names = head.group(1).split("::")
        arguments, closing = split_arguments(text, head.end())
        body = TO_BODY.match(text, closing)
        if not body or names[-1] in KEYWORDS:
            continue
        is_lambda, parameters = bool(head.group(2)), parameters_of(arguments)
        if names[1:]:  # the defaults stand in the class
            parameters = {name: default or '""' for name, default in parameters.items()}
        around = [name for name, begin, end in classes if begin <= head.start() < end and not is_lambda]
        result.append(Function(file, names[-1], names[-2] if names[1:] else (around or [""])[-1], is_lambda,
                               parameters, head.end(), (body.end(), end_of_block(text, body.end()))))
    for function in result:
        if function.is_lambda:
            function.scope = max((f.body for f in result if f.body[0] <= function.opening < f.body[1]), default=function.scope)
    return result


class Sources:
    def __init__(self, folder):
        self.texts = {file.relative_to(folder).as_posix(): re.sub(r"^\s*//.*$", "", file.read_text(), flags=re.M)
                      for file in sorted(folder.rglob("*")) if file.suffix in (".cc", ".h")}
        self.includes = {file: {name if "/" in name else f"{file.rpartition('/')[0]}/{name}" for name in INCLUDE.findall(text)}
                         for file, text in self.texts.items()}
        self.functions = {file: functions_of(file, text) for file, text in self.texts.items()}
        self.helpers = {}  # {name: [Function]}
        while any([self.is_new_helper(*call) for file in self.texts for call in self.calls(file)]):
            pass

    def calls(self, file):
        """(file, position, is thrown or logged, (text, allowed, hint)) of all calls that make a message."""
        text, openings = self.texts[file], {function.opening for function in self.functions[file]}
        for call in CALL.finditer(text):
            arguments = split_arguments(text, call.end())[0]
            if arguments and not arguments[0].startswith("describe_error"):
                described = call.group(1) == "describe_error"
                statement = re.split(r"[;{}]", text[:call.start()])[-1]
                allowed, hint = (arguments + [""] * 5)[3:5] if described else ("", "")
                yield file, call.start(), not described or re.search(r"\bthrow\b|warning", statement), (arguments[0], allowed, hint)
        names = "|".join(self.helpers)
        for call in re.finditer(rf"(?:(\w+)\s*(?:\.|->)\s*)?(?<![\w:])({names})\s*\(", text) if names else ():
            arguments = split_arguments(text, call.end())[0]
            helper = call.end() not in openings and self.helper_of(file, call.start(), call.group(1), call.group(2), arguments)
            if helper:
                yield file, call.start(), True, helper.message_of(arguments)

    def helper_of(self, file, position, thing, name, arguments):
        own = [f for f in self.functions[file]
               if f.name == name and f.takes(arguments) and f.scope[0] <= position < f.scope[1]]
        others = [h for h in self.helpers[name] if h.file != file and not h.is_lambda and h.takes(arguments)]
        of_class = [f for f in own + others if thing and f.owner and self.is_declared(file, f.owner, thing)]
        included = [h for h in others if h.file.rpartition(".")[0] in self.includes[file]]
        found = next(iter(of_class + own + included), None)
        return found if found and found.message else None

    def is_declared(self, file, owner, thing):
        """Whether the thing is an object of the class, here or in a header of the same folder that is included."""
        texts = [self.texts[file]] + [self.texts.get(header + ".h", "") for header in self.includes[file]]
        return any(re.search(rf"\b{owner}\b[\s&*]*\b{thing}\b", text) for text in texts)

    def is_new_helper(self, file, position, is_told, message):
        if not is_told:
            return False
        if shown(re.sub(r'^([^"]*)"[^":]*: ', r'\1"', message[0])):
            return False  # it says something itself, and not only of which file it speaks
        names = set(NAME.findall(LITERAL.sub("", message[0])))
        around = [f for f in self.functions[file] if f.body[0] <= position < f.body[1] and names & set(f.parameters)]
        helper = max(around, key=lambda f: f.body, default=None)
        if helper is None or helper.message:
            return False
        helper.message = message
        self.helpers.setdefault(helper.name, []).append(helper)
        return True

    def messages(self):
        """(file, text, allowed, hint) of all messages, in the order of the files."""
        for file in self.texts:
            for _, _, _, message in sorted(self.calls(file), key=lambda call: call[1]):
                yield (file,) + message
