"""What goes wrong."""

import json
from typing import List, Tuple

from .message import Message


class Error(Exception):
    """Something is wrong with what was handed over, or a stage failed: what, where, what to do.

    Attributes
    ----------
    code : int
        As the command's exit code: 1 a stage failed, 2 the input or the pipeline is wrong.
    failures : list of (str, Message)
        The nodes that failed, each with why.
    details : dict
        What the command tells with ``--json``.
    """

    def __init__(self, text: str, code: int = 2, details: str = "{}") -> None:
        super().__init__(text)
        self.code = code
        self.details = json.loads(details)

    @property
    def failures(self) -> List[Tuple[str, Message]]:
        return [(f["node"], Message(f["why"])) for f in self.details.get("failures", [])]

    def __reduce__(self):
        return (Error, (str(self), self.code, json.dumps(self.details)))


class Missing(Error, KeyError):
    """Something that is not there: a `tailor.Error`, and what a mapping raises."""

    __str__ = Exception.__str__
