"""A process that is watched while it reads hostile files.

    python tests/hostile_child.py FOLDER

prints name → what came of it as JSON, with everything that the process did meanwhile beside reading the robot's files.
"""

import json
import os
import re
import resource
import signal
import socket
import subprocess
import sys
from pathlib import Path
from time import process_time

from hostile import CANARY, CODE, Case, cases, prop, text

PATIENCE = 20  # seconds of computing for a case
MEMORY = 1_500_000_000  # bytes more than after the start
WATCHED = (
    *("os.listdir", "os.scandir", "glob.", "os.remove", "os.rename", "os.mkdir", "os.putenv", "shutil.", "ctypes."),
    *("subprocess.", "os.system", "os.exec", "os.posix_spawn", "os.fork", "os.spawn", "pty.", "webbrowser."),
    *("socket.", "urllib.", "ftplib."),
)
WITHIN = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">{}</robot>'
BOMB = "\n".join(
    ["a: &a [0, 0]", *(f"{b}: &{b} [{', '.join([f'*{a}'] * 10)}]" for a, b in zip("abcdefgh", "bcdefghi", strict=True))]
)
ENTITY = '<!DOCTYPE robot [<!ENTITY e SYSTEM "file:///etc/passwd">]><robot>&e;</robot>'


def lay_out(folder: Path) -> Path:
    """Write the files around the robot, deep in a folder; return the robot's folder."""
    robot = folder / "a" / "b" / "c" / "robot"
    (robot / "sub").mkdir(parents=True)
    for outside in (robot.parent, folder / "outside"):
        outside.mkdir(exist_ok=True)
        (outside / "secret.xacro").write_text(WITHIN.format(prop("secret", "42")))
        (outside / "secret.yaml").write_text("secret: 42\n")
    texts = {
        "part.xacro": WITHIN.format(""),
        "code.xacro": WITHIN.format("<gazebo>${open(1)}</gazebo>"),
        "self.xacro": WITHIN.format('<xacro:include filename="self.xacro"/>'),
        "twice.xacro": WITHIN.format('<xacro:include filename="twice.xacro"/>' * 2),
        "entity.xacro": ENTITY,
        "unit.yaml": f"a: !degrees {CODE}\n",
        "object.yaml": f"a: !!python/object/apply:os.system ['touch {CANARY}']\n",
        "bomb.yaml": BOMB,
        "deep.yaml": "[" * 20_000,
        "large.yaml": "- 1\n" * 300_000,
        "list.yaml": "[1]\n",
    }
    for name, content in texts.items():
        (robot / name).write_text(content, encoding="utf-8")
    (robot / "link.xacro").symlink_to("../secret.xacro")
    (robot / "link.yaml").symlink_to("../secret.yaml")
    (robot / "linked").symlink_to(folder / "outside")
    (robot / "round.xacro").symlink_to("round.xacro")
    os.mkfifo(robot / "pipe")
    return robot


# --- the child


class Watch:
    """What the process does: files opened outside of a folder, processes, sockets, foreign code."""

    def __init__(self, folder: Path):
        self.seen: list[str] = []
        self.on = False
        self._folder = str(folder)
        sys.addaudithook(self._hook)

    def _hook(self, event: str, arguments: tuple) -> None:
        if not self.on:
            return
        if event == "open":
            if not isinstance(arguments[0], str) or arguments[0].startswith(self._folder):
                return
            if arguments[0].endswith((".py", ".pyc", ".so")):
                return  # a module
        elif event == "exec":
            code = arguments[0]
            caller = sys._getframe(1).f_code.co_filename
            if caller.endswith(("private_copy.py", "collections/__init__.py")) or "importlib" in caller:
                return  # the copy of xacro, a named tuple in it, and modules
            arguments = (code.co_filename, caller)
        elif not event.startswith(WATCHED) or str(*arguments[:1]).startswith(self._folder):
            return
        self.seen.append(f"{event} {arguments!r}"[:300])


def outcome(path: Path) -> str | None:
    """The message with which a file is refused, None when it loads, or what else is raised."""
    from robotics1 import RobotFileError, load_robot

    def too_long(*_: object) -> None:
        raise TimeoutError(f"it computes longer than {PATIENCE} s")

    signal.signal(signal.SIGPROF, too_long)
    signal.setitimer(signal.ITIMER_PROF, PATIENCE)
    try:
        load_robot(path)
    except RobotFileError as error:
        return str(error)
    except BaseException as error:
        return f"STRAY {type(error).__name__}: {error}"
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    return None


def misbehave() -> None:
    """Do what no file may do, to see that it is seen."""
    Path("/etc/passwd").read_text()
    subprocess.run(["true"], check=False)
    socket.socket().close()
    exec("1")


def main(folder: Path) -> None:
    robot = lay_out(folder)
    os.chdir(folder)
    (robot / "warm.yaml").write_text("a: 1\n")
    warm = Case("warm", None, '<xacro:include filename="part.xacro"/>', "${load_yaml('warm.yaml').a}")
    (robot / "warm.xacro").write_text(text(warm), encoding="utf-8")
    if (said := outcome(robot / "warm.xacro")) is not None:
        raise SystemExit(said)
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, used + MEMORY))
    watch = Watch(folder)
    results = {}
    for number, case in enumerate(cases()):
        path = robot / f"case{number}.xacro"
        path.write_text(text(case), encoding="utf-8", errors="surrogatepass")
        watch.seen.clear()
        watch.on, begin = True, process_time()
        said = outcome(path)
        watch.on = False
        results[case.name] = [said, list(watch.seen), process_time() - begin]
    watch.seen.clear()
    watch.on = True
    misbehave()
    watch.on = False
    peak = int(re.search(r"VmHWM:\s+(\d+) kB", Path("/proc/self/status").read_text())[1])
    json.dump(
        {"results": results, "canaries": [str(p) for p in folder.rglob(CANARY)], "peak": peak, "control": watch.seen},
        sys.stdout,
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
