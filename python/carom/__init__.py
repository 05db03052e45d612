"""Carom moves spheres exactly: event-driven hard spheres, for NumPy.

>>> import carom
>>> run = carom.load("simtest1").run(seconds=10)
>>> run.positions.shape
(501, 15, 3)

Right-handed frame, y up, SI units, float64. The same input gives the same bits on every machine.
"""

import importlib.metadata as _metadata
from typing import TYPE_CHECKING

from carom import _gymnasium, _show, analysis
from carom._carom import Snapshot
from carom._pictures.film import Film
from carom._pictures.picture import Renderer
from carom._run.batch import Batch
from carom._run.derivatives import Gradient, Margin, Tangents, Tape
from carom._run.gradients import RunEnd, value_and_grad
from carom._run.impact_chunks import impact_chunks
from carom._run.packing import Packing, pack
from carom._run.queries import PredictedPath, QueryFilter
from carom._run.reports import ContactAccount, EnergyAccount, StageCounts, ZoneAccount
from carom._run.stress import Stress, StressMeter
from carom._run.tables import (
    CONTACT,
    HIT,
    IMPACT,
    LEDGER,
    LEG,
    NEAR,
    OVERLAP,
    OVERLAPPING,
    SENSOR_EVENT,
    TRIGGER,
    WELL_EVENT,
)
from carom._run.trajectory import Trajectory
from carom._run.world import World
from carom._scene.above import above
from carom._scene.library import Listed, load, scene, scenes
from carom._scene.parts import (
    Andersen,
    Ball,
    Bend,
    Bisect,
    Bowl,
    Box,
    Buoyancy,
    Camera,
    Capsule,
    ClosePacking,
    Collider,
    Colors,
    Cone,
    ConstantForce,
    Contact,
    Container,
    Curve,
    Cutoff,
    Cylinder,
    DenseFluid,
    DensityColor,
    Disc,
    Discrete,
    Emitter,
    End,
    Exact,
    Finish,
    Force,
    Funnel,
    Gap,
    Generator,
    Gravity,
    HalfSpace,
    HeightField,
    Keyframes,
    Lattice,
    Material,
    MaterialPair,
    Mesh,
    Motion,
    MutualGravity,
    Oscillate,
    PairPotential,
    Periodic,
    Piece,
    Pipe,
    PointAttractor,
    PowerLaw,
    QuadraticDrag,
    RandomFill,
    Rectangle,
    Rescale,
    RestitutionLaw,
    Ring,
    Row,
    Shape,
    Side,
    Simulation,
    Sphere,
    Spring,
    SquareWell,
    StaggeredRows,
    Steady,
    Straight,
    Strike,
    Sun,
    Swing,
    Thermostat,
    Torus,
    Track,
    Try,
    Turn,
    Viscoelastic,
    ViscousDrag,
    Vortex,
    WhiteNoise,
    Wind,
)
from carom._scene.points import Points
from carom._scene.scene import Scene
from carom._scene.view import Viewpoint
from carom._sweep import Failure, Runs, sweep
from carom.errors import (
    CaromError,
    GraphicsError,
    OmissionWarning,
    RunError,
    SceneError,
    StepError,
    UnknownError,
)

__all__ = [
    "CONTACT",
    "HIT",
    "IMPACT",
    "LEDGER",
    "LEG",
    "NEAR",
    "OVERLAP",
    "OVERLAPPING",
    "SENSOR_EVENT",
    "TRIGGER",
    "WELL_EVENT",
    "Andersen",
    "Ball",
    "Batch",
    "Bend",
    "Bisect",
    "Bowl",
    "Box",
    "Buoyancy",
    "Camera",
    "Capsule",
    "CaromError",
    "ClosePacking",
    "Collider",
    "Colors",
    "Cone",
    "ConstantForce",
    "Contact",
    "ContactAccount",
    "Container",
    "Curve",
    "Cutoff",
    "Cylinder",
    "DenseFluid",
    "DensityColor",
    "Disc",
    "Discrete",
    "Emitter",
    "End",
    "EnergyAccount",
    "Exact",
    "Failure",
    "Film",
    "Finish",
    "Force",
    "Funnel",
    "Gap",
    "Generator",
    "Gradient",
    "GraphicsError",
    "Gravity",
    "HalfSpace",
    "HeightField",
    "Keyframes",
    "Lattice",
    "Listed",
    "Margin",
    "Material",
    "MaterialPair",
    "Mesh",
    "Motion",
    "MutualGravity",
    "OmissionWarning",
    "Oscillate",
    "Packing",
    "PairPotential",
    "Periodic",
    "Piece",
    "Pipe",
    "PointAttractor",
    "Points",
    "PowerLaw",
    "PredictedPath",
    "QuadraticDrag",
    "QueryFilter",
    "RandomFill",
    "Rectangle",
    "Renderer",
    "Rescale",
    "RestitutionLaw",
    "Ring",
    "Row",
    "RunEnd",
    "RunError",
    "Runs",
    "Scene",
    "SceneError",
    "Shape",
    "Side",
    "Simulation",
    "Snapshot",
    "Sphere",
    "Spring",
    "SquareWell",
    "StageCounts",
    "StaggeredRows",
    "Steady",
    "StepError",
    "Straight",
    "Stress",
    "StressMeter",
    "Strike",
    "Sun",
    "Swing",
    "Tangents",
    "Tape",
    "Thermostat",
    "Torus",
    "Track",
    "Trajectory",
    "Try",
    "Turn",
    "UnknownError",
    "Viewpoint",
    "Viscoelastic",
    "ViscousDrag",
    "Vortex",
    "WhiteNoise",
    "Wind",
    "World",
    "ZoneAccount",
    "__version__",
    "analysis",
    "impact_chunks",
    "load",
    "pack",
    "scene",
    "scenes",
    "sweep",
    "value_and_grad",
]

above.notebook = _show
_gymnasium.register_with_gymnasium()

if TYPE_CHECKING:
    __version__: str
else:

    def __getattr__(name):
        """The version, when it is first read: to look for it takes a few milliseconds."""
        if name != "__version__":
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        globals()[name] = _metadata.version("carom")
        return globals()[name]
