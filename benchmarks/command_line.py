"""What commands cost as processes, beside `python -c "import pinocchio"`; first answers with nothing compiled.

Processor time is measured, in user and system, since other work on the machine does not add to it much; on an idle
machine a command of one thread takes as long. Each round runs every command once; the least of the rounds counts.
"""

import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

from benchmarks.report import RESULTS, Target, at_most, conditions, table, target_table

ROUNDS = 5
FIRST_ROUNDS = 2
RESULT = RESULTS / "command_line.md"
SCRIPT = "from robotics1.cli import main\nmain()\n"
PINOCCHIO = "import pinocchio"
COMMANDS = {
    "--help": ["--help"],
    "fk --help": ["fk", "--help"],
    "fk prr": ["fk", "prr", "--q", "0.5,pi/2,0.3pi"],
    "jacobian ur5": ["jacobian", "ur5", "--q", "0,-1,1,0.3,0.4,0"],
    "ik ur5, all solutions": ["ik", "ur5", "--target", "0.4,0.2,0.3,pi,0,0"],
}
FIRST = {
    "ik cylindrical --method solve": ["ik", "cylindrical", "--target", "1,-1,3", "--method", "solve"],
    "ik ur5 --method solve": ["ik", "ur5", "--target", "0.4,0.2,0.3,pi,0,0", "--method", "solve"],
    "scan prr --samples 1e5": ["scan", "prr", "--samples", "1e5"],
}


def seconds(command: list[str], **environment: str) -> float:
    """Return the processor time of a process that ends well."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True, env=os.environ | environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main() -> None:
    """Time all commands, and write the table."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "robotics1"  # its name tells that the process is the command's own
        script.write_text(SCRIPT, encoding="utf-8")
        calls = {"python -c 'import pinocchio'": [sys.executable, "-c", PINOCCHIO]}
        calls |= {name: [sys.executable, str(script), *words] for name, words in COMMANDS.items()}
        for call in calls.values():
            seconds(call)  # bytecode and the disk's cache
        rounds = [{name: seconds(call) for name, call in calls.items()} for _ in range(ROUNDS)]
        least = {name: min(one[name] for one in rounds) for name in calls}
        for name, words in FIRST.items():
            times = []
            for i in range(FIRST_ROUNDS):
                code = str(Path(folder) / f"code-{i}-{len(least)}")
                times.append(seconds([sys.executable, str(script), *words], NUMBA_CACHE_DIR=code))
            least[f"{name}, nothing compiled"] = min(times)
    _write(least)


def _write(least: dict[str, float]) -> None:
    unit = least["python -c 'import pinocchio'"]
    rows = [[f"`{name}`", f"{value:.2f}", f"{value / unit:.1f}"] for name, value in least.items()]
    targets: list[Target] = [
        at_most("`--help`", 0.25, least["--help"], " s"),
        at_most("`fk prr`", 0.6, least["fk prr"], " s"),
        at_most("first `ik ... --method solve`", 2.0, least["ik ur5 --method solve, nothing compiled"], " s"),
        at_most("first scan", 6.0, least["scan prr --samples 1e5, nothing compiled"], " s"),
    ]
    lines = [
        "# Commands as whole processes",
        conditions("python -m benchmarks.command_line", 0),
        f"Processor time, the least of {ROUNDS} rounds, and of {FIRST_ROUNDS} with an empty cache of compiled code.",
        table(["command", "[s]", "times `import pinocchio`"], rows),
        target_table(targets),
    ]
    RESULT.write_text("\n\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
