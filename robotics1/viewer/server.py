"""A page shown by a server of this computer, for browsers that open no files."""

import signal
import threading
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from types import FrameType
from typing import Any

HOST = "127.0.0.1"


def serve(html: str, port: int = 0, started: Callable[[str], None] = lambda _: None) -> None:
    """Show a page at http://127.0.0.1:port/ until Ctrl-C or SIGTERM.

    Only this computer reaches it, and only under its own name: a request that was sent to another host, as a page from
    elsewhere could send, is refused.

    Args:
        html: the page.
        port: 0 takes a free one.
        started: is called with the address when the server answers.

    Raises:
        OSError: the port is taken.
    """
    with ThreadingHTTPServer((HOST, port), _handler(html.encode("utf-8"))) as server:
        server.daemon_threads = True
        address = f"{HOST}:{server.server_address[1]}"
        before = _stop_on_sigterm()
        try:
            started(f"http://{address}/")
            server.serve_forever(poll_interval=0.2)
        except KeyboardInterrupt:
            pass
        finally:
            if before is not None:
                signal.signal(signal.SIGTERM, before)


def _handler(page: bytes) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        """It answers with the page at /, and with nothing else."""

        timeout = 10  # s without a request

        def do_GET(self) -> None:
            """Send the page."""
            address = f"{self.server.server_address[1]}"  # type: ignore[index]
            if self.headers.get("Host") not in (f"{HOST}:{address}", f"localhost:{address}"):
                self.send_error(421, "another host is meant")
            elif self.path != "/":
                self.send_error(404)
            else:
                self.send_response(200)
                self.send_header("Content-Type", "text/html; charset=utf-8")
                self.send_header("Content-Length", str(len(page)))
                self.end_headers()
                self.wfile.write(page)

        def log_message(self, format: str, *args: object) -> None:
            """Print nothing."""

    return Handler


def _stop_on_sigterm() -> Any:
    """Let SIGTERM end the server as Ctrl-C does; return what it did before, None where signals belong to others."""
    if threading.current_thread() is not threading.main_thread():
        return None

    def stop(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    return signal.signal(signal.SIGTERM, stop)
