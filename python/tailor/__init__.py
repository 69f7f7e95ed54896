"""Girths of a body from the photographs of one turn.

`measure` is the one-line door. `Pipeline` changes, plans, runs and sweeps any pipeline. `stage` makes a
function of yours a node of one. Results are looked at as numpy arrays, without copying them.

Lengths are millimetres, pixels have the centre of the top-left one at (0, 0), the world is the turntable's:
origin on the axis at the disk's top, z up.
"""

from typing import TYPE_CHECKING, Any

from ._errors import Error
from ._native import version as __version__
from .artifacts import READERS
from .measuring import measure
from .message import Message
from .pipeline import Pipeline, pipelines, sweep
from .progress import Event
from .runs import Measured, Run
from .sweeps import Sweep

if TYPE_CHECKING:
    from .staging import Stage, stage

__all__ = [
    "Error",
    "Event",
    "Measured",
    "Message",
    "Pipeline",
    "READERS",
    "Run",
    "Stage",
    "Sweep",
    "__version__",
    "measure",
    "pipelines",
    "stage",
    "sweep",
]


def __getattr__(name: str) -> Any:
    # What reads sources is loaded when it is used.
    if name in ("Stage", "stage"):
        from . import staging

        return getattr(staging, name)
    raise AttributeError(f"module 'tailor' has no attribute {name!r}")
