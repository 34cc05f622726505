"""xacro that is left in a plain URDF: definitions that nothing uses are no harm, as every other reader has it."""

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from typing import cast

from robotics1.robot.markup import Element

DEFINITIONS = ("xacro:property", "xacro:arg", "xacro:macro")
READ = ("link", "joint", "material")  # what a URDF's robot is made of; the rest is for other programs


def unprocessed(root: Element) -> Element | None:
    """Return the first element that means something only when xacro has expanded it, or None.

    These are calls and conditions, and `${...}` and `$(...)` where the robot is described; in a file without links
    also definitions.
    """
    if root.tag.startswith("xacro:") or _refers(root):
        return root
    parts = [cast("Element", part) for part in root]
    for part in parts:
        if part.tag in READ or (part.tag.startswith("xacro:") and part.tag not in DEFINITIONS):
            for element in _outside_definitions(part):
                if element.tag.startswith("xacro:") or _refers(element):
                    return element
    if not any(part.tag == "link" for part in parts):
        return next((part for part in parts if part.tag.startswith("xacro:")), None)
    return None


def drop_definitions(root: ET.Element) -> None:
    """Take the definitions out of a tree that needs none of them."""
    for element in list(root.iter()):
        for part in [part for part in element if part.tag in DEFINITIONS]:
            element.remove(part)


def _outside_definitions(element: Element) -> Iterator[Element]:
    if element.tag not in DEFINITIONS:
        yield element
        for part in element:
            yield from _outside_definitions(cast("Element", part))


def _refers(element: Element) -> bool:
    return any("${" in value or "$(" in value for value in element.attrib.values())
