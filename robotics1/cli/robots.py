"""The command `robotics1 robots`."""

from importlib.util import find_spec

from robotics1.cli.options import AsJson

EXAMPLES = ("robots", "robots --json")
EXTRAS = {  # extra → the packages that it installs, and what for
    "viewer": (("meshcat", "trimesh"), "pages"),
    "plots": (("matplotlib",), "figures"),
    "robots": (("example_robot_data",), "the robots of example-robot-data"),
    "check": (("yourdfpy",), "a second opinion on a robot file"),
    "draco": (("DracoPy",), "meshes compressed by Draco"),
    "toppra": (("toppra",), "time-optimal motions by TOPP-RA"),
}


def robots(json: AsJson = False) -> None:
    """The robots that have a name, with their joints, and the optional packages that are installed."""
    from robotics1.cli.output import PlainConsole, progress_bar, write_json
    from robotics1.robot.sources import example_robots, own_robots

    named = {"robotics1": own_robots(), "example-robot-data": example_robots()}
    known: dict[str, str] = {}
    for origin, files in named.items():
        known |= {name: origin for name in sorted(files) if name not in known}
    with progress_bar("reading", hidden=json) as progress:
        found = []
        for i, name in enumerate(known, 1):
            found.append((name, known[name], *_read(name)))
            progress(i, len(known))
    extras = {extra: _installed(extra, packages) for extra, (packages, _) in EXTRAS.items()}
    if json:
        keys = ("name", "from", "joints", "tool")
        write_json({"robots": [dict(zip(keys, row, strict=True)) for row in found], "extras": extras})
        return
    from robotics1.terminal_tables import table

    out = PlainConsole()
    out.print(table(("name", "from", "joints", "tool"), found, left=("name", "from", "joints", "tool")))
    for extra, (_, purpose) in EXTRAS.items():
        state = "installed" if extras[extra] else f"missing: pip install 'robotics1[{extra}]'"
        out.say(f"{extra}: {purpose}, {state}")


def _read(name: str) -> tuple[str, str]:
    """Return the joints of a robot as letters, as in PRR, and its tool; or why it cannot be read."""
    import warnings

    from robotics1.errors import Robotics1Error, RobotWarning
    from robotics1.robot.description import letters
    from robotics1.robot.loading import load_robot

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RobotWarning)
            robot = load_robot(name)
    except Robotics1Error:
        return "its file has errors, see check", ""
    return letters(robot), robot.tool or "open"


def _installed(extra: str, packages: tuple[str, ...]) -> bool:
    """Whether the packages of an extra are there."""
    if extra == "robots":
        from robotics1.robot.sources import example_robots

        return bool(example_robots())
    return all(find_spec(package) is not None for package in packages)
