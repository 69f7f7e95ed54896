"""`tailor.measure`: the one-line door."""

import os
import tempfile
import warnings
from typing import Any, List, Optional, Union

from . import _native
from .message import Message
from .progress import Hearing, Progress
from .runs import Measured

Path = Union[str, "os.PathLike[str]"]


def words(facts: dict) -> List[str]:
    """Facts as flags of the command: ``mat_tag=60`` is ``--mat-tag 60``; a list is said again and again."""
    said: List[str] = []
    for name, value in facts.items():
        flag = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            said.append(flag)
            continue
        if isinstance(value, dict):
            value = [f"{key}={one}" for key, one in value.items()]
        for one in value if isinstance(value, (list, tuple)) else [value]:
            said.append(f"{flag}={os.fspath(one) if isinstance(one, os.PathLike) else one}")
    return said


def measure(
    folder: Path,
    *,
    out: Optional[Path] = None,
    cache: Optional[Path] = None,
    threads: Optional[int] = None,
    private: bool = False,
    progress: Progress = None,
    **facts: Any,
) -> Measured:
    """Measures the photos of one turn, as ``tailor measure`` does.

    Parameters
    ----------
    folder : path
        The folder with the photos or the video of one turn, or a video.
    out : path, optional
        Where results are written; the folder's name with ``-out`` if not said.
    cache : path, optional
        Where results are kept: ``TAILOR_CACHE``, else ``cache``, as the command has it.
    threads : int, optional
        How many threads work; one a core if not said.
    private : bool
        Keep nothing in a cache: what is made goes with the result.
    progress : callable, bool or None
        Who hears how it goes on; see `tailor.Event`.
    **facts
        The flags of ``tailor measure``, with ``_`` for ``-``: ``stature=178``, ``mat="mat.pdf"``, ``step=20``,
        ``variant="rigid"``, ``set={"hull.voxel_mm": 4}``, ``no_photos=True``.

    Returns
    -------
    Measured
        The results by node, the girths, and the folder they were written to.

    Raises
    ------
    Error
        A fact that there is not, photos that cannot be measured, a stage that failed.
    KeyboardInterrupt
        Ctrl-C. What is done is kept: the same call goes on.
    """
    held = tempfile.TemporaryDirectory(prefix="tailor-private-") if private else None
    place = held.name if held else os.fspath(cache or default_cache())
    said = [os.fspath(folder)] + ([f"--out={os.fspath(out)}"] if out is not None else [])
    with Hearing(progress) as hear:
        run, where, seen = _native.measure(said + words(facts), place, threads, hear)
    for warning in seen:
        warnings.warn(Message.of_json(warning), stacklevel=2)
    return Measured(run, where, seen, held)


def default_cache() -> str:
    """Where results are kept if nobody says: as the command has it."""
    return os.environ.get("TAILOR_CACHE") or "cache"
