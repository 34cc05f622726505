"""The parameters of a macro, as they are written: `prefix length:=0.5 *origin parent:=^|base`."""

import re

PARAMETER = re.compile(
    r"""\s*(?P<name>[^\s:=]+)\s*:?=\s*(?P<outer>\^\|?)?"""
    r"""(?P<default>\$\{[^}]*\}|\$\([^)]*\)|(?:'[^']*'|"[^"]*"|[^\s'"])*)(?:\s+|$)"""
)
Parameter = tuple[str, tuple[str | None, str | None] | None, str]


def macro_parameter(text: str) -> Parameter:
    """Return the first parameter of a macro: its name, its default, and the rest of the text.

    The default is None if there is none; else the name of a property outside, for `^`, and the text of a default. It
    takes a time that grows with the text alone, which xacro's own pattern does not.
    """
    found = PARAMETER.match(text)
    if found is None:
        name, *rest = text.split(None, 1)
        return name, None, rest[0] if rest else ""
    outer = found["name"] if found["outer"] else None
    return found["name"], (outer, found["default"] or None), text[found.end() :]
