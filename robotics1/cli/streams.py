"""What stdout and stderr can take: a terminal without Unicode, and a reader that goes away."""

import codecs
import os
import signal
import sys
import threading
import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager

SPELLED = {
    "π": "pi", "α": "alpha", "δ": "delta", "Δ": "delta ", "ε": "eps", "η": "eta", "θ": "theta", "λ": "lambda",
    "σ": "sigma", "τ": "tau", "φ": "phi", "ψ": "psi", "ω": "omega",
    "−": "-", "·": "*", "⋅": "*", "×": "x", "√": "sqrt", "≤": "<=", "≥": ">=", "≠": "!=", "°": " deg", "█": "#",
    "\u0307": "'", "˙": "'", "ṗ": "p'", "ṙ": "r'", "ẋ": "x'", "ẏ": "y'", "ż": "z'",
    "…": "...", "–": "-", "─": "-", "│": "|", "╱": "/", "╲": "\\",
    "⎡": "[", "⎢": "[", "⎣": "[", "⎤": "]", "⎥": "]", "⎦": "]",
    "⎛": "(", "⎜": "(", "⎝": "(", "⎞": ")", "⎟": ")", "⎠": ")",
}  # fmt: skip


def spelled_out(error: UnicodeError) -> tuple[str, int]:
    r"""Return what stands for characters that a stream cannot encode: q1' for q̇1, J^T for Jᵀ; else \xe4, \u5de6."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(map(_spelled, error.object[error.start : error.end])), error.end


def _spelled(character: str) -> str:
    if character in SPELLED:
        return SPELLED[character]
    kind, _, plain = unicodedata.decomposition(character).partition(" ")
    if kind in ("<super>", "<sub>"):
        raised = "^" if kind == "<super>" else "_"
        base = chr(int(plain, 16))
        return raised + (base if base.isascii() else _spelled(base))
    return character.encode("unicode_escape").decode("ascii")


def _flush() -> None:
    """Write out what stdout still holds; where the disk is full, drop it, else Python fails on it again at its end."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise


@contextmanager
def streams_ready() -> Iterator[None]:
    """Let characters that stdout or stderr do not know be spelled out, and a closed pipe end the process quietly.

    `robotics1 ... | head -1` then ends by the signal SIGPIPE, as other commands do: 141 in a shell.
    """
    codecs.register_error("robotics1.spelled_out", spelled_out)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="robotics1.spelled_out")
    settable = hasattr(signal, "SIGPIPE") and threading.current_thread() is threading.main_thread()
    before = signal.signal(signal.SIGPIPE, signal.SIG_DFL) if settable else None
    try:
        yield
    finally:
        _flush()
        if settable:
            signal.signal(signal.SIGPIPE, before)
