"""What a notebook shows where there are no widgets: a picture, and how to get them."""

from __future__ import annotations

import base64
import html
from typing import Any, NoReturn


class Still:
    """A picture in the place of a viewer that is not there, with the reason why.

    Attributes:
        reason: Why there is no viewer, and how to get it.
        picture: A PNG file; None where nothing can be drawn.
    """

    def __init__(self, picture: bytes | None, reason: str) -> None:
        self.picture, self.reason = picture, reason

    def __repr__(self) -> str:
        return f"<a picture; {self.reason}>"

    def __getattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"a picture has no attribute {name!r}; {self.reason}")

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        data = {"text/plain": repr(self)}
        if self.picture is not None:
            picture = base64.b64encode(self.picture).decode("ascii")
            data["image/png"] = picture
            data["text/html"] = (
                f'<img src="data:image/png;base64,{picture}" alt="">'
                f"<p><em>A picture: {html.escape(self.reason)}</em></p>"
            )
        return data
