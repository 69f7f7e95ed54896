"""What came of a run: results by the names of nodes."""

import json
import os
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Optional, Tuple, Union

from . import _native
from ._errors import Error, Missing
from .artifacts import read
from .frames import frame
from .message import Message


class Run(Mapping):
    """Results by node: ``run["body"]``; a mapping. A result is read when it is asked for, and then kept."""

    def __init__(self, native: "_native.Run", keep: Any = None) -> None:
        self._native = native
        self._keep = keep
        self._read: Dict[str, Any] = {}
        self._record: Optional[dict] = None

    def __getitem__(self, node: str) -> Any:
        if node not in self._read:
            try:
                artifact = self._native.artifact(node)
            except Error as why:
                raise Missing(str(why), why.code) from None
            self._read[node] = read(artifact, self)
        return self._read[node]

    def __iter__(self) -> Iterator[str]:
        return iter(self._native.results())

    def __len__(self) -> int:
        return len(self._native.results())

    def __repr__(self) -> str:
        nodes = self.record["nodes"]
        made = sum(n["status"] == "made" for n in nodes)
        found = sum(n["status"] == "found" for n in nodes)
        return f"<{type(self).__name__}: {', '.join(self)}; {made} made, {found} found>"

    @property
    def record(self) -> dict:
        """The run as ``run.json`` has it: every node with key, version, params, time, found or made."""
        if self._record is None:
            self._record = json.loads(self._native.record())
        return self._record

    @property
    def made(self) -> List[str]:
        """The nodes that ran."""
        return [n["node"] for n in self.record["nodes"] if n["status"] == "made"]

    @property
    def found(self) -> List[str]:
        """The nodes whose results were in the cache."""
        return [n["node"] for n in self.record["nodes"] if n["status"] == "found"]

    @property
    def failures(self) -> List[Tuple[str, Message]]:
        """The nodes that failed, each with why; only with ``keep_going``."""
        return [(node, Message.of_json(why)) for node, why in self._native.failures()]

    @property
    def warnings(self) -> List[Message]:
        """What stages warn of: ``node: text``, each with its ``code`` and ``fields``."""
        nodes = self.record["nodes"]
        return [Message(w, f"{n['node']}: ") for n in nodes for w in n["warnings"]]

    @property
    def metrics(self) -> Dict[str, float]:
        """Numbers beside the results: ``hull.volume``."""
        nodes = self.record["nodes"]
        return {f"{n['node']}.{m['name']}": m["value"] for n in nodes for m in n["metrics"]}

    def table(self, kind: Optional[str] = None) -> Any:
        """The nodes: status, seconds, bytes, key.

        Parameters
        ----------
        kind : {'pandas', 'polars', 'dicts'}, optional
            Which table; if none is said, the first that is installed.
        """
        keys = ("node", "stage", "status", "seconds", "bytes", "key")
        return frame([{key: n[key] for key in keys} for n in self.record["nodes"]], kind)

    def formats(self, node: str) -> List[str]:
        """The formats in which a node's result is written, the usual one first."""
        return self._native.formats(node)

    def save(self, node: str, path: Union[str, "os.PathLike[str]"], format: Optional[str] = None) -> Path:
        """Writes a node's result, as ``tailor show NODE --as FORMAT -o PATH``.

        Parameters
        ----------
        node : str
            The node.
        path : path
            The file, or the folder where there are several.
        format : str, optional
            One of `formats`; the usual one if not said.
        """
        files = self._native.files(node, format)
        path = Path(path)
        if len(files) == 1 and not files[0][0]:
            path.write_bytes(files[0][1])
            return path
        path.mkdir(parents=True, exist_ok=True)
        for name, data in files:
            (path / name).write_bytes(data)
        return path


class Measured(Run):
    """What `tailor.measure` gives: results by node, and the folder with its files.

    Attributes
    ----------
    out : pathlib.Path
        The folder with ``girths.json``, ``body.ply``, ``report.html`` and the rest.
    """

    def __init__(self, native: "_native.Run", out: Union[str, Path], seen: List[str], keep: Any = None) -> None:
        super().__init__(native, keep)
        self.out = Path(out)
        self._seen = [Message.of_json(text) for text in seen]

    @property
    def girths(self) -> Any:
        """The girths, by name."""
        return self["girths"]

    @property
    def warnings(self) -> List[Message]:
        """What was seen in the folder, and what stages warn of."""
        return [*self._seen, *super().warnings]
