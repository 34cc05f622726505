"""xacro → URDF text, with the file's arguments as the robot's named parameters.

The library xacro does the work, in a copy of its own (see private_copy.py). Expressions, files and sizes are ours:
evaluator.py, reading.py, budget.py.
"""

import keyword
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, NoReturn
from xml.dom import minidom

from robotics1.errors import RobotFileError, Robotics1Error, UnknownNameError
from robotics1.robot.markup import parse_xml
from robotics1.robot.xacro.budget import Budget, Located, Refused, check_length, message, shortened, written_length
from robotics1.robot.xacro.evaluator import evaluate
from robotics1.robot.xacro.functions import global_names, tokenize
from robotics1.robot.xacro.private_copy import macro_parameter, private_copy
from robotics1.robot.xacro.reading import Files
from robotics1.robot.xacro.substitutions import Substitutions, argument, is_number

DEEPEST = 120  # macros inside each other: xacro recurses
MAKERS = ("createElementNS", "createTextNode", "createComment", "createCDATASection", "createProcessingInstruction")
MOST_INCLUDES = 40  # files inside each other
PIECE = re.compile(
    r"(?P<escaped>\$\$+[{(])|\$\{(?P<expression>[^}]*)\}|\$\((?P<command>[^)]*)\)|(?P<text>[^$]+|\$[^{($]+|\$$)"
)


class Expanded(NamedTuple):
    """A xacro text, expanded.

    Attributes:
        urdf: the URDF text.
        parameters: the arguments that are numbers, and their values.
        effort: how much of what an expansion may use it took, from 0 to 1.
    """

    urdf: str
    parameters: dict[str, float]
    effort: float


def expand_xacro(
    text: str, path: Path, parameters: Mapping[str, Any], packages: Sequence[Path], *, trusted: bool = False
) -> Expanded:
    """Return the URDF text of a xacro text, with the values of its numeric arguments.

    Args:
        text: the xacro.
        path: where it comes from; files that it includes are looked for beside it.
        parameters: values of its arguments, and of those that the files it includes declare.
        packages: folders of packages.
        trusted: whether it may read every file, and the environment.

    Raises:
        UnknownNameError: a parameter that neither the file nor one that it includes declares.
        InputError: a value is neither a number nor a word, or a word where the default is a number.
        RobotFileError: an argument has neither a value nor a default; an expression, a file or a size is refused; or
            xacro cannot expand it.
    """
    expansion = Expansion(path, parameters, packages, trusted)
    try:
        expanded = expansion.expand(text)
    except Robotics1Error:
        raise
    except Exception as error:  # whatever xacro and the expressions of the file run into
        raise RobotFileError(f"xacro cannot expand it:{expansion.where()} {message(error)}", path=path) from error
    unknown = [name for name in parameters if name not in {*expansion.declared, *expansion.used}]
    if unknown:
        raise UnknownNameError(f"parameter of {path.name} named", unknown[0], expansion.declared)
    return Expanded(expanded, expansion.numbers(), expansion.budget.used)


class Expansion:
    """One expansion of one file.

    Attributes:
        declared: name → default of the arguments met so far, and of all that stand in the file itself.
        used: the arguments that the caller gives and the file uses.
        budget: what is left to it.
    """

    def __init__(self, path: Path, given: Mapping[str, Any], packages: Sequence[Path], trusted: bool):
        self.declared: dict[str, str | None] = {}
        self.used: set[str] = set()
        self._path, self._given = path, given
        self._arguments: dict[str, str] = {}  # name → text, once declared
        self.budget = Budget()
        self._files = Files(path, packages, trusted, self.budget)
        self._substitutions = Substitutions(self._argument, self._files, self.budget)
        self._names = global_names(self._functions())
        self._xacro = private_copy(
            _global_symbols=self._names,
            eval_text=self._value,
            parse=self._parse,
            get_include_files=self._included,
            parse_macro_arg=macro_parameter,
            is_valid_name=lambda name: name.isidentifier() and not keyword.iskeyword(name),
            **dict.fromkeys(("message", "warning", "error", "print_location"), _silent),
            **dict.fromkeys(("safe_eval", "eval_extension", "load_yaml", "abs_filename_spec")),  # nothing calls them
        )
        self._before("check_attrs", self._declare)
        self._before("resolve_macro", self._count_call)
        self._before("replace_node", self._count_moved)

    def expand(self, text: str) -> str:
        """Return the URDF text."""
        root = parse_xml(text, self._path)
        self.declared = {arg.get("name", ""): arg.get("default") for arg in root.iter("xacro:arg")}
        self._xacro.init_stacks(str(self._path))
        document = self._document(text)
        self._xacro.process_doc(document, mappings=self._arguments)
        self.budget.spend("characters", written_length(document))
        return document.toxml()

    def numbers(self) -> dict[str, float]:
        """Return the values of the arguments that are numbers: the named lengths."""
        found = {}
        for name, default in self.declared.items():
            if name in self._given:
                number = argument(name, self._given[name], default)[1]
            else:
                number = float(default) if default is not None and is_number(default) else None
            if number is not None:
                found[name] = number
        return found

    def where(self) -> str:
        """Return which included file is being read, or nothing."""
        files = self._xacro.filestack or [str(self._path)]
        return "" if files[-1] == str(self._path) else f" {Path(files[-1]).name}:"

    # --- expressions

    def _value(self, text: str, symbols: Mapping[str, Any]) -> Any:
        """Return a text with the values of its ${...} and $(...); of a single one the value itself."""
        self.budget.spend("steps")
        self.budget.spend("characters", len(text))
        if "$" not in text:
            return text
        values, end = [], 0
        while end < len(text):
            piece = PIECE.match(text, end)
            if piece is None:
                raise Refused(f"invalid expression {text[end : end + 60]!r}: a brace is open")
            values.append(self._piece(piece, symbols))
            end = piece.end()
        if len(values) == 1:
            return values[0]
        joined = [str(value) for value in values]
        check_length(sum(map(len, joined)))
        return "".join(joined)

    def _piece(self, piece: re.Match[str], symbols: Mapping[str, Any]) -> Any:
        self.budget.spend("steps")
        source = piece["expression"] or piece["command"]
        if source is None:
            return piece[0].removeprefix("$") if piece["escaped"] else piece[0]
        inner = str(self._value(source, symbols))
        try:
            if piece["expression"]:
                return evaluate(inner, symbols, self.budget)
            return self._substitutions.value(inner)
        except (Located, Robotics1Error):
            raise
        except Exception as error:  # whatever Python raises for such an expression
            raise Located(f"{message(error)}, when evaluating expression {shortened(source)!r}") from error

    def _functions(self) -> dict[str, Any]:
        """Return what stands behind `xacro.` in an expression."""
        return {
            "arg": self._argument,
            "load_yaml": lambda name: self._files.yaml_values(name, self._file(), self._constant),
            "abs_filename": lambda name: str(self._files.place(name, self._file())),
            "dotify": lambda mapping: mapping,  # a dot leads into every dictionary
            "tokenize": tokenize,
            "fatal": _fatal,
            **dict.fromkeys(("message", "warning", "error", "print_location"), _silent),
        }

    def _constant(self, expression: str) -> Any:
        return evaluate(expression, self._names, self.budget)

    # --- arguments

    def _argument(self, name: str) -> str:
        """Return the text of an argument: its value, or its default."""
        if name in self._arguments:
            return self._arguments[name]
        default = self.declared.get(name)
        if name in self._given:
            self.used.add(name)
            return argument(name, self._given[name], default)[0]
        if default is None:
            raise KeyError(name)
        return str(self._value(default, self._names))  # used above its declaration, as in <robot name="$(arg name)">

    def _declare(self, tag: minidom.Element, *_: object) -> None:
        """Give an argument its value where xacro comes to its `xacro:arg`; xacro itself evaluates its default."""
        name = tag.getAttribute("name")
        if tag.tagName != "xacro:arg":
            return
        default = tag.getAttribute("default") if tag.hasAttribute("default") else None
        if name not in self._arguments:
            self.declared[name] = default
            if name in self._given:
                self._arguments[name] = argument(name, self._given[name], default)[0]
            elif default is None:
                raise RobotFileError(
                    f"parameter {name!r} has no default: give it a value", path=self._path, element=name
                )
        if default is None:
            tag.setAttribute("default", "")  # xacro wants one

    # --- files

    def _file(self) -> Path:
        return Path(self._xacro.filestack[-1])

    def _included(self, name: str, symbols: Mapping[str, Any]) -> list[str]:
        if len(self._xacro.filestack) > MOST_INCLUDES:
            raise Refused(f"it is too large: files include each other more than {MOST_INCLUDES} deep")
        return [str(file) for file in self._files.named(str(self._value(name, symbols)), self._file())]

    def _parse(self, _: None, name: str) -> minidom.Document:
        try:
            text = self._files.text(Path(name), name)
        except FileNotFoundError as error:
            self._xacro.filestack.pop()
            raise self._xacro.XacroException(exc=error) from error  # which xacro expects of an optional file
        parse_xml(text, Path(name))
        return self._document(text)

    # --- sizes

    def _document(self, text: str) -> minidom.Document:
        """Return a document that counts what is made of it."""
        self.budget.spend("pieces of XML", text.count("<"))
        document = minidom.parseString(text.lstrip("\ufeff"))
        for make in MAKERS:
            setattr(document, make, self._counted(getattr(document, make)))
        for element in document.getElementsByTagName("*"):
            if element.attributes.length > 4:
                element.setUserData("attributes", element.attributes.length, self)
        return document

    def _counted(self, make: Callable[..., Any]) -> Callable[..., Any]:
        def counted(*arguments: Any) -> Any:
            self.budget.spend("pieces of XML")
            self.budget.spend("characters", len(arguments[-1]))
            return make(*arguments)

        return counted

    def handle(self, _: int, key: str, number: int, __: minidom.Node, copy: minidom.Node) -> None:
        """Take away what it costs to copy an element of many attributes; minidom calls this."""
        self.budget.spend("pieces of XML", number // 4)
        copy.setUserData(key, number, self)

    def _count_call(self, name: str, *_: object) -> None:
        """Take away what a call of a macro costs beside its body."""
        self.budget.spend("pieces of XML", 4)
        if len(self._xacro.macrostack) >= DEEPEST:
            raise Refused(f"it is too large: macro {name!r} is called {DEEPEST} macros deep; is it a recursion?")

    def _count_moved(self, node: minidom.Node, by: Any, content_only: bool = False) -> None:
        """Take away what it costs to put something in a node's place: a search among its siblings for each part."""
        new = by if isinstance(by, list) else [by]
        moved = sum(len(part.childNodes) for part in new if part is not None) if content_only else len(new)
        siblings = len(node.parentNode.childNodes) if node.parentNode is not None else 0
        self.budget.spend("steps", (1 + moved) * siblings // 100)

    def _before(self, name: str, check: Callable[..., None]) -> None:
        """Let a check precede a function of xacro."""
        function = getattr(self._xacro, name)

        def checked(*arguments: Any, **named: Any) -> Any:
            check(*arguments, **named)
            return function(*arguments, **named)

        setattr(self._xacro, name, checked)


def _silent(*_: object, **__: object) -> str:
    return ""


def _fatal(*words: object) -> NoReturn:
    raise Refused(" ".join(map(str, words)))
