"""The viewer of the page in the output of a notebook."""

from __future__ import annotations

import base64
import zlib
from pathlib import Path
from typing import Any
from urllib.parse import quote

import traitlets

from carom._pictures.picture import notebook_picture
from carom._run.methods import scene_of
from carom._run.world import World
from carom._scene import parts
from carom._scene.scene import Scene
from carom._scene.text import toml_value
from carom.errors import CaromError
from carom.notebook._built import built_interface
from carom.notebook._widget import Widget, checked_height

_LARGEST = 16 * 2**20
"""Text of a scene that a link holds at most [bytes]: `MAX_UNPACKED` of the engine."""

_SPHERE_FIELDS = (
    "position",
    "velocity",
    "radius",
    "mass",
    "restitution",
    "angular_velocity",
)
"""What `Viewer.set_sphere` changes."""


class Viewer(Widget):
    """The viewer of the page, in the output of a cell: `Scene.show` and `World.show` make it.

    What happens in it and what Python sets are the same: ``viewer.time = 2.5`` goes there, and
    ``viewer.time`` is where a person has gone. Traits are observed as those of other widgets:
    ``viewer.observe(function, "picked")``. While a cell runs, nothing arrives from the browser;
    what Python sets gets there at once.

    Attributes:
        time: Where it is [s].
        playing: Whether time goes on.
        picked: The id of the sphere that is followed, or None.
        link: The part after ``#`` of a link to what is shown, with all edits: the page opens it,
            and so does ``carom run --link``. Up to date to a second; of scenes of more than
            100,000 characters it stays what it was at the beginning.
        height: Of the viewer [pixels], when it is displayed.

    >>> import carom
    >>> viewer = carom.load("simtest1").show()  # doctest: +SKIP
    >>> viewer.play()  # doctest: +SKIP
    """

    _esm = Path(__file__).with_name("viewer.js")
    _css = Path(__file__).with_name("viewer.css")

    picked = traitlets.Int(None, allow_none=True).tag(sync=True)
    link = traitlets.Unicode("").tag(sync=True)
    _version = traitlets.Unicode("").tag(sync=True)
    # Whether the interface is there, and takes messages.
    _ready = traitlets.Bool(False).tag(sync=True)
    # What the browser shows, and the scene file of it when it last stood still or was edited. Each
    # has the number of the last command that it follows: what was on its way when Python set
    # something else does not undo that. For scenes only the commands count that may change one.
    _shown = traitlets.Dict().tag(sync=True)
    _scene_shown = traitlets.Dict().tag(sync=True)

    def __init__(self, scene: Scene | World, *, height: int = 480) -> None:
        """A viewer of a scene, or of a world as it is now.

        Raises:
            CaromError: For a height that is invalid, and a scene that is too large.
            SceneError: If the scene is invalid.
            GraphicsError: If this build of carom has no viewer for notebooks.
        """
        self._interface = built_interface()
        self._given = scene_of(scene)
        # In the order in which they were made, until there is an interface that takes them.
        self._waiting: list[dict[str, Any]] = []
        self._last_command = 0
        self._last_scene_command = 0
        self._is_reporting = False
        # How many spheres the scene that was given has, once that was asked.
        self._spheres: int | None = None
        # None while the scene is the one that was given.
        self._scene_text: str | None = None
        super().__init__(
            link=_link(self._given),
            height=checked_height(height),
            _version=self._interface.version,
            _picture=notebook_picture(scene) or b"",
        )
        self.on_msg(self._hear)

    def __repr__(self) -> str:
        going_on = "playing" if self.playing else "paused"
        return f"<carom.notebook.Viewer of {self._given.name!r} at {self.time:.6g} s, {going_on}>"

    @property
    def scene(self) -> Scene:
        """The scene as it was when it stood still last, or was edited last: time begins at 0 there.

        Assigned to, the viewer shows another one.

        Raises:
            CaromError: If it is too large to come back from the browser.
        """
        if self._scene_text is None:
            return self._given
        if not self._scene_text:
            raise CaromError("scene: it is too large to come back from the browser", "scene")
        return Scene.from_toml(self._scene_text)

    @scene.setter
    def scene(self, scene: Scene | World) -> None:
        self._given = scene_of(scene)
        link = _link(self._given)
        self._scene_text, self._spheres, self.link = None, None, link
        # Opened first: its time and what is picked are set in the scene that is shown then.
        self._tell("open", link)
        self.picked, self.time = None, 0.0

    def world(self) -> World:
        """The world of `scene`: what is shown goes on in Python from here."""
        return self.scene.world()

    def pick(self, id: int | None) -> None:
        """Follows the sphere with this id, or none."""
        self.picked = id

    @traitlets.validate("picked")
    def _check_picked(self, proposal: dict[str, Any]) -> int | None:
        picked: int | None = proposal["value"]
        if picked is not None and not 0 <= picked < 2**32:
            raise CaromError(f"picked: must be an id of a sphere, not {picked}", "picked")
        return picked

    # Edits, at the time of now; the viewer says where one is refused.

    def set_sphere(self, id: int, **changes: Any) -> None:
        """Changes some quantities of a sphere, at once.

        Args:
            id: Of the sphere.
            **changes: ``position`` [m], ``velocity`` [m/s], ``radius`` [m], ``mass`` [kg],
                ``restitution``, ``angular_velocity`` [rad/s].

        Raises:
            CaromError: For an id that no sphere has.
            TypeError: For another name.
        """
        self._check_id(id)
        for name in changes:
            if name not in _SPHERE_FIELDS:
                raise TypeError(f"{name}: must be one of {', '.join(_SPHERE_FIELDS)}")
        given = {name: _floats(value) for name, value in changes.items()}
        self._edit({"sphere": {"sphere": id, "changes": given}})

    def remove_sphere(self, id: int) -> None:
        """Takes a sphere out, at once.

        Raises:
            CaromError: For an id that no sphere has.
        """
        self._check_id(id)
        self._edit({"remove-sphere": id})

    def _check_id(self, id: int) -> None:
        """Refuses an id that no sphere has, as far as that is known here.

        Emitters and people in the browser add spheres, which the viewer alone knows.
        """
        is_known = self._scene_text is None and not self._given.emitters
        if is_known and self._spheres is None:
            self._spheres = len(self._given.world().ids)
        ids = self._spheres if is_known and self._spheres is not None else 2**32
        if not 0 <= id < ids:
            raise CaromError(f"id: no sphere has the id {id}", "id")

    def set_restitution(self, restitution: float, collider: int | None = None) -> None:
        """Sets the coefficient of restitution of a collider, or of all, at once."""
        value = _floats(restitution)
        if collider is None:
            self._edit({"all-collider-restitutions": value})
        else:
            self._edit({"collider-restitution": {"collider": collider, "restitution": value}})

    def add_force(self, force: parts.Force) -> None:
        """Adds a force, at once."""
        self._edit({"add-force": force})

    def set_force(self, id: int, force: parts.Force) -> None:
        """Puts another force in the place of one, at once."""
        self._edit({"force": {"force": id, "is": force}})

    def remove_force(self, id: int) -> None:
        """Takes a force out, at once."""
        self._edit({"remove-force": id})

    def _edit(self, change: dict[str, Any]) -> None:
        self._tell("edit", f"change = {toml_value(change, 'change')}")

    @traitlets.observe("time", "playing", "picked")
    def _command(self, change: dict[str, Any]) -> None:
        """Sends what Python set to the browser, but not what the browser reported itself."""
        # Where there is no interface yet, it begins with the traits as they are then.
        if self._ready and not self._is_reporting:
            self._tell("set", {change["name"]: change["new"]})

    def _tell(self, kind: str, content: Any) -> None:
        self._last_command += 1
        if kind != "set" or "time" in content:
            self._last_scene_command = self._last_command
        message = {"kind": kind, "content": content, "number": self._last_command}
        if self._ready:
            self.send(message)
        else:
            self._waiting.append(message)

    @traitlets.observe("_ready")
    def _catch_up(self, change: dict[str, Any]) -> None:
        if change["new"]:
            waiting, self._waiting = self._waiting, []
            for message in waiting:
                self.send(message)
            names = ("time", "playing", "picked")
            self._tell("set", {name: getattr(self, name) for name in names})

    @traitlets.observe("_shown")
    def _follow_report(self, change: dict[str, Any]) -> None:
        report = dict(change["new"])
        if report.pop("number", None) != self._last_command:
            return
        self._is_reporting = True
        try:
            for name, value in report.items():
                setattr(self, name, value)
        finally:
            self._is_reporting = False

    @traitlets.observe("_scene_shown")
    def _follow_scene(self, change: dict[str, Any]) -> None:
        if change["new"].get("number", -1) >= self._last_scene_command:
            self._scene_text = change["new"]["text"]

    def _hear(self, _: Any, message: dict[str, Any], buffers: list[bytes]) -> None:
        """Hands the interface to a document that has none yet."""
        if message.get("kind") == "interface":
            parts = [self._interface.script, self._interface.module]
            self.send({"kind": "interface"}, buffers=parts)


def _floats(value: Any) -> Any:
    """Numbers as the engine reads them: whole ones, too, with a point."""
    try:
        return [float(part) for part in value]
    except TypeError:
        return float(value)


def _link(scene: Scene) -> str:
    """The part after ``#`` of a link to the beginning of a scene."""
    text = scene.to_toml().encode()
    if len(text) > _LARGEST:
        raise CaromError(f"scene: {scene.name} is too large for a viewer in a notebook", "scene")
    packed = base64.urlsafe_b64encode(zlib.compress(text, 9)).decode("ascii").rstrip("=")
    # With a time, mazes are watched, too.
    return f"file={packed}&name={quote(scene.name, safe='')}&t=0"
