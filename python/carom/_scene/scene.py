"""Scenes: what there is at the start."""

from __future__ import annotations

import json
import os
import subprocess
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import DTypeLike, NDArray

from carom._carom import (
    canonical_toml,
    import_gltf,
    import_particle_file,
    import_unity,
    read_scene,
    read_scene_file,
)
from carom._scene import parts
from carom._scene.above import above
from carom._scene.points import Points
from carom._scene.text import fields_of, toml_of, toml_value
from carom._scene.view import NOTEBOOK_SIZE, SIZE, Quality, Size, View, Viewpoint
from carom.errors import CaromError, OmissionWarning

if TYPE_CHECKING:
    from carom._scene.above import Film, Out, Recorded, Still, Trajectory, Viewer, World

NO_CHANGES: Mapping[str, Any] = MappingProxyType({})

_SEEDS = 2**32
"""Seeds of random fillings and dense fluids are less."""

_RANDOM = (parts.RandomFill, parts.DenseFluid)
"""Generators with a seed."""


@dataclass(frozen=True, kw_only=True, repr=False)
class Scene(parts.Part):
    """Spheres, what acts on them, what they bounce off, and how to look at it.

    A scene is a value: it can be compared, copied and pickled. ``dataclasses.replace`` makes
    another one of it; so does `with_changes`, by the paths of scene files.

    Attributes:
        name: Short name, to find it by.
        title: Name as shown to people; the scene is found by it too.
        description: What there is to see, in a sentence or two.
        origin: Where the scene comes from.
        tries: Up to three things to try, as ``[[try]]`` in scene files.
        simulation: How it is stepped.
        forces: Forces on every sphere; they add up.
        materials: Materials by name, for spheres and colliders.
        material_pairs: Pairs of materials whose contacts have coefficients of their own.
        spheres: Single spheres; many of them as `Points`.
        generators: Places for many spheres or colliders, which come after the single ones.
        springs: Springs and threads, between spheres or from one to a fixed point.
        colliders: Shapes that spheres bounce off.
        emitters: Sources of spheres.
        camera: Where to look from; fitted to the scene where it is missing.
        sun: The light.
        colors: Colours of what has none of its own.

    >>> import carom
    >>> drop = carom.Scene(
    ...     name="drop",
    ...     forces=[carom.Gravity((0, -10, 0))],
    ...     spheres=[carom.Sphere(position=(0, 5.5, 0), radius=0.5)],
    ...     colliders=[carom.Collider(carom.HalfSpace())],
    ... )
    >>> run = drop.run(seconds=2)
    >>> run.impacts["time"].round(12)
    array([1.])
    """

    name: str
    title: str = ""
    description: str = ""
    origin: str = ""
    simulation: parts.Simulation = field(default_factory=parts.Simulation)
    forces: Sequence[parts.Force] = ()
    spheres: Sequence[parts.SizedSphere] = ()
    generators: Sequence[parts.Generator] = ()
    springs: Sequence[parts.Spring] = ()
    colliders: Sequence[parts.Collider] = ()
    emitters: Sequence[parts.Emitter] = ()
    camera: parts.Camera | None = None
    sun: parts.Sun | None = None
    colors: parts.Colors | None = None
    tries: Sequence[parts.Try] = ()
    materials: Mapping[str, parts.Material] = field(default_factory=dict, hash=False)
    material_pairs: Sequence[parts.MaterialPair] = ()

    def __repr__(self) -> str:
        parts = {
            "spheres": self.spheres,
            "generators": self.generators,
            "colliders": self.colliders,
            "forces": self.forces,
            "springs": self.springs,
            "emitters": self.emitters,
        }
        counts = [f"{len(part)} {name}" for name, part in parts.items() if part]
        return f"<carom.Scene {self.name!r}: {', '.join(counts) or 'empty'}>"

    @classmethod
    def from_toml(
        cls, text: str, *, source: str = "scene", changes: Mapping[str, Any] = NO_CHANGES
    ) -> Scene:
        """Reads a scene from the text of a scene file.

        Args:
            text: TOML.
            source: What errors call it.
            changes: Other values, by their paths, like ``{"simulation.rule": "exact"}``; ``None``
                takes a value out.

        Raises:
            SceneError: With the field and line of what is wrong.
        """
        return cls(**fields_of(json.loads(read_scene(text, source, overrides(changes)))))

    @classmethod
    def from_file(
        cls, path: str | os.PathLike[str], *, changes: Mapping[str, Any] = NO_CHANGES
    ) -> Scene:
        """Reads a scene file, and those that it includes.

        Raises:
            OSError: If it cannot be read.
            SceneError: With the field and line of what is wrong.
        """
        with Path(path).open("rb"):
            pass  # An error of the system stays one.
        return cls(**fields_of(json.loads(read_scene_file(path, overrides(changes)))))

    @classmethod
    def from_unity(
        cls,
        path: str | os.PathLike[str],
        *,
        scene: str | None = None,
        mapping: str | os.PathLike[str] | None = None,
    ) -> Scene:
        """Imports a scene of Unity, as ``carom import`` does.

        What has no counterpart is an `OmissionWarning`, one for each line of the report.

        Args:
            path: A scene (.unity, saved as text), or a folder such as ``Assets``.
            scene: Which scene of the folder, by its name or its path there; it may be missing
                where there is one only.
            mapping: A file that says what the fields of scripts mean.

        Raises:
            OSError: If the path cannot be read.
            SceneError: With the file and line of what is wrong.
            CaromError: If the folder has no such scene, or several.
        """
        Path(path).stat()  # An error of the system stays one.
        if mapping is not None:
            Path(mapping).stat()
        return cls._imported(import_unity(path, scene, mapping))

    @classmethod
    def from_gltf(cls, path: str | os.PathLike[str]) -> Scene:
        """Imports a glTF file (.gltf, .glb), as ``carom import`` does.

        What has no counterpart is an `OmissionWarning`, one for each line of the report.

        Raises:
            OSError: If it cannot be read.
            SceneError: With the file and place of what is wrong.
        """
        with Path(path).open("rb"):
            pass  # An error of the system stays one.
        return cls._imported(import_gltf(path))

    @classmethod
    def from_particles(
        cls,
        path: str | os.PathLike[str],
        *,
        frame: int | None = None,
        radius: float | None = None,
    ) -> Scene:
        """Imports a frame of extended XYZ, a dump of LAMMPS or GSD, as ``carom import`` does.

        The scene begins at the time 0 with positions, velocities, rotations, radii, masses and the
        periodic box of the file, to the bit where Carom wrote it. What is left out or replaced is
        an `OmissionWarning`.

        Args:
            path: Of the file (.xyz, .extxyz, .lammpstrj, .dump, .gsd).
            frame: Which frame, from 0; the last whole one unless given.
            radius: Radius of every particle [m], for a file without radii.

        Raises:
            CaromError: If the ending is that of no such format, or an argument is invalid.
            OSError: If it cannot be read.
            SceneError: With the file and line of what is wrong.
        """
        with Path(path).open("rb"):
            pass  # An error of the system stays one.
        if frame is not None and frame < 0:
            raise CaromError(f"frame: must be >= 0, not {frame}", "frame")
        return cls._imported(import_particle_file(path, frame, radius))

    @classmethod
    def _imported(cls, imported: tuple[str, list[str]]) -> Scene:
        scene, omissions = imported
        for line in omissions:
            warnings.warn(line, OmissionWarning, stacklevel=3)
        return cls(**fields_of(json.loads(scene)))

    def to_toml(self) -> str:
        """The text of a scene file, every default written out.

        Raises:
            SceneError: If the scene is invalid.
        """
        return canonical_toml(toml_of(self))

    def with_changes(self, changes: Mapping[str, Any]) -> Scene:
        """The same scene with other values, by their paths.

        >>> import carom
        >>> carom.load("simtest1").with_changes({"simulation.rule": "exact"}).simulation.rule
        'exact'
        """
        if isinstance(self.spheres, Points) and not any(it.startswith("spheres") for it in changes):
            # Without a text of each of them.
            return replace(replace(self, spheres=()).with_changes(changes), spheres=self.spheres)
        return Scene.from_toml(toml_of(self), source=self.name, changes=changes)

    def with_seed(self, seed: int) -> Scene:
        """The same scene with this seed for its first random generator, the next for the second...

        Random are `RandomFill` and `DenseFluid`.

        Raises:
            CaromError: If nothing in the scene is random.
        """
        generators: list[parts.Generator] = []
        next_seed = seed
        for generator in self.generators:
            if isinstance(generator, _RANDOM):
                generator = replace(generator, seed=next_seed)
                next_seed = (next_seed + 1) % _SEEDS
            generators.append(generator)
        if not any(isinstance(generator, _RANDOM) for generator in generators):
            raise CaromError("seed: the scene has no random generator", "seed")
        return replace(self, generators=generators)

    def world(self) -> World:
        """The world at the start of the scene.

        Raises:
            SceneError: If the scene is invalid.
        """
        return above.run.world_of(self)

    def run(
        self,
        seconds: float | None = None,
        *,
        frames: int | None = None,
        dt: float | None = None,
        every: int = 1,
        quantities: Recorded | Sequence[Recorded] | None = None,
        dtype: DTypeLike | None = None,
        out: Out | None = None,
        impacts: bool = True,
    ) -> Trajectory:
        """Runs the scene from its start, and records what happens: see `World.run`."""
        return self.world().run(
            seconds,
            frames=frames,
            dt=dt,
            every=every,
            quantities=quantities,
            dtype=dtype,
            out=out,
            impacts=impacts,
        )

    # Pictures

    @overload
    def picture(
        self,
        path: None = None,
        *,
        seconds: float = 0.0,
        size: Size = SIZE,
        camera: Viewpoint = "scene",
        quality: Quality = "fine",
        stamp: bool = True,
    ) -> NDArray[np.uint8]: ...
    @overload
    def picture(
        self,
        path: str | os.PathLike[str],
        *,
        seconds: float = 0.0,
        size: Size = SIZE,
        camera: Viewpoint = "scene",
        quality: Quality = "fine",
        stamp: bool = True,
    ) -> None: ...
    def picture(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        seconds: float = 0.0,
        size: Size = SIZE,
        camera: Viewpoint = "scene",
        quality: Quality = "fine",
        stamp: bool = True,
    ) -> NDArray[np.uint8] | None:
        """Draws the scene: the picture that ``carom picture`` draws, byte for byte.

        Args:
            path: A PNG file; folders that are missing are made. Without one, the picture comes
                back as an array: red, green and blue (sRGB), shape (height, width, 3).
            seconds: When: the frame nearest to this time [s].
            size: Width and height [pixels].
            camera: Where to look from: see `carom.Viewpoint`.
            quality: How much work goes into it.
            stamp: Whether scene and time stand at the lower left.

        Raises:
            CaromError: For an argument that is invalid.
            GraphicsError: If nothing can be drawn here.
            OSError: If the file cannot be written.

        >>> import carom
        >>> carom.load("simtest1").picture(size=(320, 180), quality="draft").shape
        (180, 320, 3)
        """
        view = View.of(size, camera, quality, stamp)
        return above.pictures.picture_of_scene(self, path, seconds, view)

    def record(
        self,
        path: str | os.PathLike[str],
        *,
        seconds: float | None = None,
        frame_rate: int = 30,
        size: Size = SIZE,
        camera: Viewpoint = "scene",
        quality: Quality = "fine",
        stamp: bool = True,
    ) -> int:
        """Films the scene from its start, as ``carom record`` does; the number of frames.

        Other threads run meanwhile. Ctrl-C stops after the frame at work; what was filmed until
        then is a film.

        Args:
            path: An mp4 file (H.264); folders that are missing are made.
            seconds: How long [s], up to a whole frame; the scene's own duration unless given.
            frame_rate: Frames per second of the film: a divisor of 90,000 up to 240.
            size: Width and height [pixels], both even.
            camera: Where to look from: see `carom.Viewpoint`.
            quality: How much work goes into each picture.
            stamp: Whether scene and time stand at the lower left.

        Raises:
            CaromError: For an argument that is invalid, or a step that cannot be taken.
            GraphicsError: If nothing can be drawn here.
            OSError: If the file cannot be written.
        """
        view = View.of(size, camera, quality, stamp)
        return above.pictures.record(self, path, seconds, frame_rate, view)

    def film(
        self,
        seconds: float | None = None,
        *,
        frame_rate: int = 30,
        size: Size = NOTEBOOK_SIZE,
        camera: Viewpoint = "scene",
        quality: Quality = "good",
        stamp: bool = True,
    ) -> Film:
        """Films the scene from its start, for the output of a notebook: see `carom.Film`.

        Args:
            seconds: How long [s], up to a whole frame; the scene's own duration unless given.
            frame_rate: Frames per second of the film: a divisor of 90,000 up to 240.
            size: Width and height [pixels], both even.
            camera: Where to look from: see `carom.Viewpoint`.
            quality: How much work goes into each picture.
            stamp: Whether scene and time stand at the lower left.

        Raises:
            CaromError: For an argument that is invalid, or a step that cannot be taken.
            GraphicsError: If nothing can be drawn here.
        """
        view = View.of(size, camera, quality, stamp)
        return above.pictures.film(self, seconds, frame_rate, view)

    def show(self, *, height: int = 480) -> Viewer | Still:
        """The viewer of the page, for the output of a notebook: see `carom.notebook.Viewer`.

        It needs the extra `carom[notebook]`; without it, the scene is a picture that says how to
        get it. A window, in a notebook or elsewhere, is what `view` opens.

        Args:
            height: Of the viewer [pixels].

        Raises:
            CaromError: For a height that is invalid, or a scene that is too large.
            SceneError: If the scene is invalid.
        """
        return above.notebook.show(self, height)

    def view(self) -> subprocess.Popen[bytes]:
        """Opens the scene in a window, in a process of its own, and does not wait.

        Its ``wait()`` waits until the window is closed.

        Raises:
            SceneError: If the scene is invalid.
            GraphicsError: If this build has no window, or it cannot be opened here.
        """
        return above.pictures.open_window(self)

    def _repr_png_(self) -> bytes | None:
        """The scene in a notebook."""
        return above.pictures.notebook_picture(self)

    def _drawn(self) -> World:
        """What a picture of it shows."""
        return self.world()


def overrides(changes: Mapping[str, Any]) -> list[str]:
    """Changes as the command line takes them."""
    return [
        f"{path}={'none' if value is None else toml_value(value, path)}"
        for path, value in changes.items()
    ]
