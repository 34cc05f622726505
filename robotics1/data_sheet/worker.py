"""A process that writes sections, so that one which takes too long, or dies, can be ended and the others go on."""

import contextlib
import os
import pickle
import queue
import subprocess
import sys
import threading
from typing import Any, BinaryIO

from robotics1.data_sheet.asked import Answer, Asked
from robotics1.data_sheet.contents import SECTIONS

STARTING = 60.0  # s until a process is ready: it imports the package and reads the robot


class NoAnswer(Exception):  # noqa: N818 (the page tells it)
    """A section was not written; the message says why."""


class Worker:
    """The process, started when it is first asked, and again after one that was ended.

    What is asked about must be picklable; a task whose function is not is answered here, without limits of time.
    """

    def __init__(self, asked: Asked):
        self._asked = asked
        self._process: subprocess.Popen[bytes] | None = None
        self._answers: queue.Queue[Any] = queue.Queue()
        self._here = False
        try:
            self._message = pickle.dumps(asked)
        except (pickle.PicklingError, TypeError, AttributeError):
            self._here = True

    def __enter__(self) -> "Worker":
        return self

    def __exit__(self, *_: object) -> None:
        self._end()

    def answer(self, name: str, seconds: float) -> Answer:
        """Return what a section says.

        Raises:
            NoAnswer: it failed, its process died, or its time was over.
        """
        if self._process is None and not self._here:
            self._start()
        if self._here:
            return _checked(written(self._asked, name))
        self._tell(pickle.dumps(name))
        return _checked(self._wait(seconds))

    def _start(self) -> None:
        """Start the process and hand it the question; where it cannot read this, it is answered here."""
        program = "from robotics1.data_sheet.worker import serve; serve()"
        path = os.pathsep.join(folder or os.getcwd() for folder in sys.path)
        self._process = subprocess.Popen(
            [sys.executable, "-c", program],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=os.environ | {"PYTHONPATH": path},
        )
        self._answers = queue.Queue()
        threading.Thread(target=_read, args=(self._process.stdout, self._answers), daemon=True).start()
        self._tell(self._message)
        try:
            self._here = self._wait(STARTING) != "ready"
        except NoAnswer:
            self._here = True

    def _tell(self, message: bytes) -> None:
        """Write to the process; one that has died is noticed when it is waited for."""
        stream = None if self._process is None else self._process.stdin
        if stream is not None:
            with contextlib.suppress(OSError):
                stream.write(message)
                stream.flush()

    def _wait(self, seconds: float) -> Any:
        try:
            answer = self._answers.get(timeout=seconds)
        except queue.Empty:
            self._end()
            raise NoAnswer(f"it was not ready after {seconds:.0f} s, and was stopped") from None
        if answer is None:
            self._end()
            raise NoAnswer("its process ended without an answer")
        return answer

    def _end(self) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            for stream in (self._process.stdin, self._process.stdout):
                if stream is not None:
                    with contextlib.suppress(OSError):
                        stream.close()
            self._process = None


def _checked(answer: Any) -> Answer:
    if isinstance(answer, Answer):
        return answer
    raise NoAnswer(str(answer))


def _read(stream: BinaryIO, answers: "queue.Queue[Any]") -> None:
    """Put what the process says into a queue; None when it has ended."""
    with contextlib.suppress(EOFError, OSError, ValueError, pickle.UnpicklingError):
        while True:
            answers.put(pickle.load(stream))
    answers.put(None)


def written(asked: Asked, name: str) -> Answer | str:
    """Return a section, or why there is none."""
    section = next(section for section in SECTIONS if section.name == name)
    try:
        return section.write(asked)
    except Exception as error:  # whatever it is, the page says it, and has the other sections
        return str(error) or type(error).__name__


def serve() -> None:
    """Answer on stdout what is asked on stdin; what the libraries print goes to stderr."""
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    asked: Asked = pickle.load(sys.stdin.buffer)
    _say(out, "ready")
    with contextlib.suppress(EOFError, KeyboardInterrupt):
        while True:
            _say(out, written(asked, pickle.load(sys.stdin.buffer)))


def _say(out: BinaryIO, answer: Any) -> None:
    pickle.dump(answer, out)
    out.flush()
