"""The viewer in a notebook: one page that holds what it shows, and needs no server."""

from __future__ import annotations

import base64
import gzip
import html
import json
from functools import cache
from pathlib import Path

from starl._errors import StarlError

_FOLDER = Path(__file__).parent / "_viewer"


class Viewer:
    """The viewer with a run in it. A notebook shows it; `save` writes it as a page for any browser."""

    def __init__(self, title: str, trace: bytes, *, live: bool, height: int) -> None:
        self._title = title
        self._trace = trace
        self._live = live
        self._height = height

    def page(self) -> str:
        """The whole page, as HTML."""
        run = json.dumps({"name": self._title, "live": self._live}).encode()
        page = _file("viewer.html").decode()
        page = page.replace("{{RUN}}", _packed(run), 1)
        page = page.replace("{{TRACE}}", _packed(self._trace), 1)
        module = base64.b64encode(_file("starl.wasm.gz")).decode() if self._live else ""
        return page.replace("{{MODULE}}", module, 1)

    def save(self, path: str | Path) -> None:
        """Writes the page into a file."""
        Path(path).write_text(self.page(), encoding="utf-8")

    def _repr_html_(self) -> str:
        # Without letters that a page of another encoding would take for others.
        page = html.escape(self.page(), quote=True).encode("ascii", "xmlcharrefreplace").decode()
        style = f"width: 100%; height: {self._height}px; border: 1px solid #8884; border-radius: 4px"
        return f'<iframe srcdoc="{page}" style="{style}" title="{html.escape(self._title, quote=True)}"></iframe>'

    def __repr__(self) -> str:
        return f"<starl.Viewer of {self._title!r}; a notebook shows it, .save(path) writes it as a page>"


def _packed(content: bytes) -> str:
    return base64.b64encode(gzip.compress(content, mtime=0)).decode()


@cache
def _file(name: str) -> bytes:
    try:
        return (_FOLDER / name).read_bytes()
    except FileNotFoundError:
        raise StarlError("this wheel was built without the viewer; build it with `make wheel`") from None
