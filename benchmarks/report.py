"""Markdown of the results: what was measured, on what, and each target of the project beside it."""

import os
import platform
import subprocess
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

RESULTS = Path(__file__).parent / "results"
PACKAGES = (
    "numpy", "scipy", "numba", "pin", "roboticstoolbox-python", "rtb-data", "optik-py", "pytracik", "ssik", "eaik",
    "ik-geo", "jaik", "pin-pink", "quadprog", "example-robot-data", "pytorch-kinematics", "zarr", "distributed",
)  # fmt: skip


@dataclass(frozen=True)
class Target:
    """One number that was to be reached. `measured` is None where nothing could be measured."""

    work: str
    wanted: str
    measured: float | None
    met: bool
    unit: str = ""

    def row(self) -> list[str]:
        """Return the cells of its row."""
        if self.measured is None:
            return [self.work, self.wanted, "–", "**not measured**"]
        told = f"{self.measured:.2f}" if self.unit in {"x", " %"} else f"{self.measured:.3g}"
        return [self.work, self.wanted, told + self.unit, "met" if self.met else "**missed**"]


def at_least(work: str, least: float, measured: float | None, unit: str = "x") -> Target:
    """Return the target measured ≥ least."""
    return Target(work, f"≥ {least:g}{unit}", measured, measured is not None and measured >= least, unit)


def at_most(work: str, most: float, measured: float | None, unit: str) -> Target:
    """Return the target measured ≤ most."""
    return Target(work, f"≤ {most:g}{unit}", measured, measured is not None and measured <= most, unit)


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def target_table(targets: Iterable[Target]) -> str:
    """Return the targets beside what was measured."""
    return table(["work", "target", "measured", "verdict"], [target.row() for target in targets])


def conditions(command: str, seed: int) -> str:
    """Return on what, with what and when busy it was measured."""
    versions = ", ".join(f"{name} {_version(name)}" for name in PACKAGES)
    return (
        f"Written by `{command}` at commit {_commit()}. {_cpu()}, {os.cpu_count()} cores, "
        f"load {os.getloadavg()[0]:.1f} at the end; {platform.system()}, Python {platform.python_version()}, "
        f"{versions}. One thread (TRAC-IK starts two of its own), seed {seed}."
    )


def absence(error: ImportError) -> str:
    """Return in words that something cannot be imported, without the place where it was looked for."""
    return "absent: " + str(error).split(" (")[0]


def write(name: str, *parts: str) -> Path:
    """Write the parts to results/<name>.md, and return its path."""
    path = RESULTS / f"{name}.md"
    path.parent.mkdir(exist_ok=True)
    path.write_text("\n\n".join(parts) + "\n", encoding="utf-8")
    return path


def tell(text: str) -> None:
    """Print at once."""
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "absent"


def _cpu() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def _commit() -> str:
    """Return the commit of the checkout, marked where the package or the benchmarks differ from it."""
    root = Path(__file__).parents[1]
    try:
        commit = _git(root, "rev-parse", "--short", "HEAD")
        changed = _git(root, "status", "--porcelain", "--", "robotics1", "benchmarks", ":!benchmarks/results")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    return f"{commit} with changes" if changed else commit


def _git(root: Path, *words: str) -> str:
    return subprocess.run(["git", *words], cwd=root, check=True, capture_output=True, text=True).stdout.strip()
