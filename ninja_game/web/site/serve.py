"""Looks at a site on this machine, with the headers that a host should send."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from ninja_game.errors import NinjaGameError

TYPES = {
    ".wasm": "application/wasm",
    ".mjs": "text/javascript",
    ".js": "text/javascript",
    ".webmanifest": "application/manifest+json",
    ".gz": "application/gzip",
}
"""What a browser insists on, whatever this system says."""


class _Handler(SimpleHTTPRequestHandler):
    """Files alone, no lists of folders; a browser asks each time whether it has the newest."""

    protocol_version = "HTTP/1.1"
    extensions_map = SimpleHTTPRequestHandler.extensions_map | TYPES

    def end_headers(self) -> None:
        """Add what all answers have in common."""
        self.send_header("Cache-Control", "no-cache")
        self.send_header("X-Content-Type-Options", "nosniff")
        super().end_headers()

    def list_directory(self, path: Any) -> None:  # noqa: ARG002 - the base class names it
        """Say that there is nothing."""
        self.send_error(404)

    def log_message(self, *_: Any) -> None:
        """Say nothing."""


def site_server(folder: Path, port: int) -> ThreadingHTTPServer:
    """A server of a folder for this machine alone; ``port`` 0 takes a free one. Raises NinjaGameError."""
    handler: Callable[..., _Handler] = partial(_Handler, directory=str(folder))
    try:
        return ThreadingHTTPServer(("127.0.0.1", port), handler)
    except OSError as error:
        raise NinjaGameError(f"port {port} cannot be used: {error.strerror}; choose another with --port") from None
