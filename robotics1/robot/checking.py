"""A URDF checked before Pinocchio sees it.

Pinocchio takes in silence a zero axis, a link with two parents, limits the wrong way round and a negative mass; it
gives no reason for what it refuses, and a very long chain crashes it. So all of that is found here, with the line.
"""

from collections.abc import Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from typing import cast

from robotics1.errors import nearest_names
from robotics1.robot.checking_parts import check_joint, check_link
from robotics1.robot.findings import LARGEST, Findings
from robotics1.robot.markup import Element, child, children, linked
from robotics1.robot.overlooked import check_overlooked

MOST_LINKS = 1000  # Pinocchio's parser recurses: 5000 links in a row crash it
MOST_DEGREES = 128  # its memory grows with the cube: 200 degrees of freedom take 513 MB
DEFINITIONS = ("xacro:property", "xacro:arg", "xacro:macro")  # without use, they are no harm
READ = ("link", "joint", "material")  # what a URDF's robot is made of; the rest is for other programs
RESERVED = {"universe": "Pinocchio's name for the world"}
OTHER_FORMATS = {
    "sdf": "is SDF, which is not read; export the robot as URDF, or hand in the pin.Model that Pinocchio makes of it",
    "mujoco": "is MJCF, which load_robot(..., trusted=True) reads",
}
FREEDOM = {"fixed": 0, "revolute": 1, "continuous": 1, "prismatic": 1, "planar": 3, "floating": 6}


def check_urdf(root: Element) -> Findings:
    """Return everything that is wrong with a URDF: its structure first, then joints and links in order."""
    findings = Findings()
    if not _is_a_robot(findings, root):
        return findings
    links, joints = children(root, "link"), children(root, "joint")
    _check_size(findings, root, links, joints)
    if findings.errors:
        return findings
    _check_names(findings, links)
    _check_names(findings, joints)
    check_overlooked(findings, root)
    _check_tree(findings, links, joints)
    types = {joint.get("name"): joint.get("type") for joint in joints}
    for joint in joints:
        check_joint(findings, joint, types)
    _check_mimic_loops(findings, joints)
    for link in links:
        check_link(findings, link)
    _warn_of_missing_inertia(findings, root, links, joints)
    return findings


def _is_a_robot(findings: Findings, root: Element) -> bool:
    found = _unprocessed(root)
    if found is not None:
        findings.error(found, "is unprocessed xacro; expand the file, or give its name the suffix .xacro")
        return False
    if root.tag in OTHER_FORMATS:
        findings.error(root, OTHER_FORMATS[root.tag])
        return False
    if root.tag != "robot":
        findings.error(root, "is not the root of a URDF, which is <robot name='...'>")
        return False
    if not (root.get("name") or "").strip():
        findings.error(root, "has no name; write <robot name='...'>")
    return True


def _unprocessed(root: Element) -> Element | None:
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


def _outside_definitions(element: Element) -> Iterator[Element]:
    if element.tag not in DEFINITIONS:
        yield element
        for part in element:
            yield from _outside_definitions(cast("Element", part))


def _refers(element: Element) -> bool:
    return any("${" in value or "$(" in value for value in element.attrib.values())


def _check_size(findings: Findings, root: Element, links: list[Element], joints: list[Element]) -> None:
    if not links:
        findings.error(root, "has no <link>")
    if max(len(links), len(joints)) > MOST_LINKS:
        count = max(len(links), len(joints))
        findings.error(root, f"has {count} links or joints; at most {MOST_LINKS} can be read")
    freedom = sum(FREEDOM.get(joint.get("type", ""), 0) for joint in joints if joint.find("mimic") is None)
    if freedom > MOST_DEGREES:
        findings.error(root, f"has {freedom} degrees of freedom; at most {MOST_DEGREES} can be computed with")


def _check_names(findings: Findings, elements: list[Element]) -> None:
    seen: set[str] = set()
    for element in elements:
        name = element.get("name") or ""
        if not name.strip():
            findings.error(element, "has no name")
        elif name in seen:
            findings.error(element, f"is there twice; names among {element.tag}s must differ")
        elif name in RESERVED:
            findings.error(element, f"has a reserved name: {RESERVED[name]}")
        seen.add(name)


def _check_tree(findings: Findings, links: list[Element], joints: list[Element]) -> None:
    """One root, no second parent, no cycle, and links that exist."""
    before = len(findings.errors)
    parent_of: dict[str, str] = {}
    names = {link.get("name") for link in links}
    for joint in joints:
        _check_ends(findings, joint, names)
        parent, child = str(linked(joint, "parent")), str(linked(joint, "child"))
        if child in parent_of:
            findings.error(joint, f"is a second parent of link {child!r}; a link hangs on one joint")
        parent_of[child] = parent
    if len(findings.errors) > before:
        return  # what follows would only repeat it in other words
    roots = [link for link in links if link.get("name") not in parent_of]
    if len(roots) > 1:
        listed = ", ".join(repr(link.get("name")) for link in roots[:5])
        findings.error(roots[1], f"hangs on nothing, so there are {len(roots)} roots: {listed}; a robot has one")
    looped = _in_a_loop(parent_of)
    for joint in [joint for joint in joints if linked(joint, "child") in looped][:1]:
        findings.error(joint, "closes a loop of links; a URDF is a tree")


def _check_ends(findings: Findings, joint: Element, names: set[str | None]) -> None:
    for end in ("parent", "child"):
        name = linked(joint, end)
        at = child(joint, end)
        if name is None:
            findings.error(joint, f"has no <{end} link='...'/>", at)
        elif name not in names:
            meant = nearest_names(name, filter(None, names))
            hint = f"; is {meant[0]!r} meant?" if meant else ""
            findings.error(joint, f"has the {end} {name!r}, and there is no such link{hint}", at)


def _in_a_loop(above: Mapping[str, str]) -> set[str]:
    """Return the members of a loop, if there is one, by going from each to the one above it."""
    try:
        TopologicalSorter({name: (next_one,) for name, next_one in above.items()}).prepare()
    except CycleError as error:
        return set(error.args[1])
    return set()


def _check_mimic_loops(findings: Findings, joints: list[Element]) -> None:
    mimics = {joint.get("name", ""): joint.find("mimic") for joint in joints}
    leader = {name: mimic.get("joint", "") for name, mimic in mimics.items() if mimic is not None}
    looped = _in_a_loop(leader)
    for joint in [joint for joint in joints if joint.get("name") in looped][:1]:
        findings.error(joint, "mimics itself, through a loop of <mimic> elements")
    if not findings.errors:
        _check_products(findings, joints)


def _check_products(findings: Findings, joints: list[Element]) -> None:
    """Along a chain of followers the factors multiply: q = a₁ (a₂ q₂ + b₂) + b₁."""
    following = {joint.get("name", ""): joint for joint in joints if joint.get("type") != "fixed"}
    mimics = {name: mimic for name, joint in following.items() for mimic in joint.findall("mimic")[:1]}
    products: dict[str, tuple[float, float]] = {}
    for start in mimics:
        chain, name = [], start
        while name in mimics and name not in products:
            chain.append(name)
            name = mimics[name].get("joint", "")
        for name in reversed(chain):
            a, b = (float(mimics[name].get(key, default)) for key, default in (("multiplier", 1.0), ("offset", 0.0)))
            factor, offset = products.get(mimics[name].get("joint", ""), (1.0, 0.0))
            products[name] = factor, offset = a * factor, a * offset + b
            if not max(abs(factor), abs(offset)) <= LARGEST:
                findings.error(following[name], f"follows through others by a factor or offset beyond {LARGEST:g}")
                return


def _warn_of_missing_inertia(findings: Findings, root: Element, links: list[Element], joints: list[Element]) -> None:
    """One sentence for all links that move and have no mass."""
    moved = {linked(joint, "child") for joint in joints if joint.get("type") != "fixed"}
    light = [str(link.get("name")) for link in links if link.get("name") in moved and link.find("inertial") is None]
    if light:
        listed = ", ".join(light[:5]) + (f" and {len(light) - 5} more" if len(light) > 5 else "")
        findings.warn(root, f"has links without inertia, which kinematics does not need: {listed}")
