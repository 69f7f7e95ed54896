"""How a run goes on: to a function of yours, a bar of tqdm's, or nobody."""

import sys
from typing import Any, Callable, NamedTuple, Optional, Union


class Event(NamedTuple):
    """Something that happened in a run.

    Attributes
    ----------
    what : str
        ``started``, ``progress``, ``waits``; ``found``, ``made``, ``failed``, ``skipped``, ``cancelled`` of a node
        that is done; ``outlook``, ``point``, ``point failed`` of a sweep.
    node : str
        The node, or the point.
    label : str
        What is counted, or said.
    done, of : int
        So much of how much.
    seconds : float
        How long it took.
    """

    what: str
    node: str
    label: str
    done: int
    of: int
    seconds: float


#: Who hears: a function of an `Event`, ``True`` for a bar, ``False`` for nobody, ``None`` for a bar where one is seen.
Progress = Union[None, bool, Callable[[Event], Any]]

ENDS = ("found", "made", "failed", "skipped", "cancelled")


def _notebook() -> bool:
    return "ipykernel" in sys.modules


class _Bar:
    """A bar of tqdm's, of nodes or of points."""

    def __init__(self, total: Optional[int], unit: str) -> None:
        from tqdm import tqdm

        if _notebook():
            try:
                import ipywidgets  # noqa: F401
                from tqdm.notebook import tqdm  # type: ignore[no-redef]
            except ImportError:
                pass
        self.bar = tqdm(total=total, unit=unit, leave=True)
        self.points = unit == "point"
        self.running: dict = {}

    def __call__(self, event: Event) -> None:
        if event.what == "outlook":
            self.bar.total = event.of
        elif event.what.startswith("point"):
            self.bar.update(1)
        elif event.what in ENDS:
            self.running.pop(event.node, None)
            if not self.points:
                self.bar.update(1)
        else:
            part = f" {event.label} {event.done}/{event.of}" if event.what == "progress" else ""
            self.running[event.node] = event.node + part
        self.bar.set_postfix_str(", ".join(self.running.values()), refresh=event.what != "progress")

    def close(self) -> None:
        self.bar.close()


class Hearing:
    """Makes a function that the engine calls out of what a user says; closes the bar behind it."""

    def __init__(self, progress: Progress, total: Optional[Callable[[], int]] = None, unit: str = "node") -> None:
        self.bar: Optional[_Bar] = None
        self.call: Optional[Callable[..., Any]] = None
        if callable(progress):
            self.call = lambda *event: progress(Event(*event))
            return
        wanted = progress is True or (progress is None and (sys.stderr.isatty() or _notebook()))
        if wanted:
            try:
                bar = self.bar = _Bar(total() if total else None, unit)
            except ImportError:
                if progress is True:
                    raise
            else:
                self.call = lambda *event: bar(Event(*event))

    def __enter__(self) -> Optional[Callable[..., Any]]:
        return self.call

    def __exit__(self, *_: object) -> None:
        if self.bar:
            self.bar.close()
