"""Pipelines: changed, planned, run, swept."""

import copy
import json
import os
import re
import sys
import tempfile
from pathlib import Path as _Path
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from . import _native
from ._errors import Error
from .files import write
from .frames import frame
from .graphs import beside
from .measuring import Path, default_cache
from .progress import Hearing, Progress
from .runs import Run
from .sweeps import Sweep
from .values import toml

if TYPE_CHECKING:
    from .staging import Stage

_NAME = re.compile(r"[A-Za-z0-9_-]+\Z")


class Pipeline:
    """A pipeline: a built-in one by its name, or a file. Each change gives another pipeline; none is changed itself.

    Parameters
    ----------
    pipeline : str or path
        The name of a built-in pipeline (see `pipelines`), or a TOML file.
    variant : str, optional
        A variant; several separated by commas.
    cache : path, optional
        Where results are kept: ``TAILOR_CACHE``, else ``cache``, as the command has it.
    threads : int, optional
        How many threads work; one a core if not said.

    Examples
    --------
    >>> body = tailor.Pipeline("body").input("photos", "samples/mannequin")  # doctest: +SKIP
    >>> run = body.set("hull.voxel_mm", 4).run("hull")  # doctest: +SKIP
    >>> run["hull"].vertices.shape  # doctest: +SKIP
    """

    def __init__(
        self,
        pipeline: Path = "body",
        *,
        variant: Optional[str] = None,
        cache: Optional[Path] = None,
        threads: Optional[int] = None,
    ) -> None:
        self._base = os.fspath(pipeline)
        self._variant = variant
        self._cache = os.fspath(cache if cache is not None else default_cache())
        self._threads = threads
        self._sets: List[str] = []
        self._inputs: Dict[str, str] = {}
        self._allow = False
        # What is put in or added here: tables of a pipeline that extends the base, and the folder that it lies in.
        self._tables: Dict[str, str] = {}
        self._goal: List[str] = []
        self._folders: List[tempfile.TemporaryDirectory] = []
        self._opened: Optional[_native.Graph] = None

    def _changed(self) -> "Pipeline":
        other = copy.copy(self)
        other._sets = list(self._sets)
        other._inputs = dict(self._inputs)
        other._tables = dict(self._tables)
        other._folders = list(self._folders)
        other._opened = None
        return other

    def set(self, *said: Any, **params: Any) -> "Pipeline":
        """With another value for params.

        Parameters
        ----------
        *said
            ``"node.param", value``, or a dict of such pairs. ``"params.name"`` is a shared param.
        **params
            ``node={"param": value}``.

        Returns
        -------
        Pipeline
            Another pipeline. Whether it can be is told when it is used.
        """
        if len(said) == 2:
            pairs = {said[0]: said[1]}
        elif len(said) == 1 and isinstance(said[0], Mapping):
            pairs = dict(said[0])
        elif not said:
            pairs = {}
        else:
            raise Error('say set("node.param", value), or set({"node.param": value})')
        for node, values in params.items():
            if not isinstance(values, Mapping):
                raise Error(f'say set({node}={{"param": value}}), or set("{node}.param", value)')
            pairs.update({f"{node}.{param}": value for param, value in values.items()})
        other = self._changed()
        for place, value in pairs.items():
            if not isinstance(place, str) or "." not in place or "=" in place:
                raise Error(f"`{place}` is no param: say NODE.PARAM, such as hull.voxel_mm")
            other._sets.append(f"{place}={toml(value, place)}")
        return other

    def variant(self, name: Optional[str]) -> "Pipeline":
        """As a variant; several separated by commas; None is the pipeline as it is."""
        other = self._changed()
        other._variant = name
        return other

    def input(self, name: str, folder: Path) -> "Pipeline":
        """With a folder for an input."""
        other = self._changed()
        other._inputs[name] = os.fspath(folder)
        return other

    def allow_exec(self) -> "Pipeline":
        """Lets the programs of the pipeline run; remembered for you until one changes."""
        other = self._changed()
        other._allow = True
        return other

    def put(self, node: str, value: Any, **params: Any) -> "Pipeline":
        """With something of your own in place of a node's result. It is checked as any input.

        Parameters
        ----------
        node : str
            The node; its kind must be one that can be taken from elsewhere: masks, a mesh, cameras, photos, a document.
        value
            Masks: a (h, w) array of uint8 or bool a photo, in turning order or by the photo's place or name; 255 is body, less its border.
            A mesh: a pair of vertices [mm] and faces, a ``trimesh.Trimesh``, a result. Cameras: ``cameras.json`` as a
            dict, a ``pycolmap.Reconstruction``, a result. Photos: arrays by name, in turning order. A document: a name
            with its ending, and a text or bytes. Or a folder with files of the kind.
        **params
            Params of the stage that takes it, such as ``unit="m"`` of a mesh.

        Returns
        -------
        Pipeline
            Another pipeline.
        """
        all_ = self.nodes
        nodes = {n["node"]: n for n in all_}
        if node not in nodes:
            raise Error(f"there is no node `{node}`; known: {', '.join(nodes)}")
        kind = nodes[node]["kind"]
        importers = {i["kind"]: i for i in json.loads(_native.importers())}
        if kind not in importers:
            raise Error(f"`{node}` makes {kind}, which cannot be put in; known: {', '.join(importers)}")
        importer = importers[kind]
        other = self._changed()
        if isinstance(value, (str, os.PathLike)) and kind != "document":
            folder = os.fspath(value)
        else:
            held = tempfile.TemporaryDirectory(prefix="tailor-put-")
            other._folders.append(held)
            folder = held.name
            write(kind, value, _Path(folder), lambda: self._names(node))
        name = f"put_{node}"
        sources = []
        for port in importer["ports"]:
            # What is put in depends on nothing of its own kind.
            source = beside(all_, node, port["kind"]) if port["kind"] != kind else None
            if port["kind"] == "files":
                sources.append(f'{port["name"]} = "@{name}"')
            elif source:
                sources.append(f"{port['name']} = {toml(source)}")
        with_ = "".join(f"{toml(k)} = {toml(v, k)}, " for k, v in params.items())
        other._tables[f"input.{name}"] = f'about = "Put in from Python."\nfiles = {toml(importer["files"])}\n'
        other._tables[f"node.{node}"] = (
            f'stage = "{importer["stage"]}"\nfrom = {{ {", ".join(sources)} }}\n'
            + (f"with = {{ {with_[:-2]} }}\n" if with_ else "")
        )
        other._sets = [s for s in other._sets if not s.startswith(f"{node}.")]
        other._inputs[name] = folder
        return other

    def add(self, node: str, stage: "Stage", **said: Any) -> "Pipeline":
        """With a stage of yours as a node: a new one, or in place of one.

        Parameters
        ----------
        node : str
            What the node is called.
        stage : Stage
            A function that `tailor.stage` made one.
        **said
            By the names of the function's arguments: of a port the node that it reads, of a param its value. A port is
            called like the node that it reads if nothing is said.

        Returns
        -------
        Pipeline
            Another pipeline, whose programs are allowed to run: they are your own.
        """
        if not _NAME.match(node):
            raise Error(f"`{node}` is no name: use letters, digits, `_` and `-`")
        kinds = {n["node"]: n["kind"] for n in self.nodes}
        new = node not in kinds
        kinds.update({"@" + i["name"]: "files" for i in self.inputs})
        other = self._changed()
        held = tempfile.TemporaryDirectory(prefix="tailor-stage-")
        other._folders.append(held)
        table, file, source = stage.node(self.nodes, kinds, said)
        if new:
            other._goal = [*(self._goal or self.goal), node]
        other._sets = [s for s in other._sets if not s.startswith(f"{node}.")]
        other._tables[f"node.{node}"] = table
        other._tables[f"file {file}"] = source
        other._allow = True
        return other

    def _names(self, masks: str) -> List[str]:
        """The names of the photos that masks belong to, in turning order."""
        photos = beside(self.nodes, masks, "photos")
        if photos is None:
            raise Error("this pipeline has no photos that masks could belong to")
        return self.run(photos, progress=False)[photos].names

    def _file(self) -> str:
        """The pipeline's file: its own, or one that extends it."""
        if not self._tables:
            return self._base
        held = tempfile.TemporaryDirectory(prefix="tailor-pipeline-")
        self._folders.append(held)
        return str(self._written(_Path(held.name)))

    def save(self, folder: Path) -> _Path:
        """Writes what was added here as ``pipeline.toml`` with the files of its stages, for ``tailor run``.

        Params that were set, and folders that were handed over, are not in it: say ``--set`` and ``--input``.
        """
        path = _Path(folder)
        path.mkdir(parents=True, exist_ok=True)
        return self._written(path)

    def _written(self, folder: _Path) -> _Path:
        path = _Path(self._base)
        base = str(path.resolve()) if path.is_file() else self._base
        text = f"extends = {toml(base)}\n" + (f"goal = {toml(self._goal)}\n" if self._goal else "")
        for name, body in self._tables.items():
            if name.startswith("file "):
                (folder / name[5:]).write_text(body)
            else:
                text += f"\n[{name}]\n{body}"
        (folder / "pipeline.toml").write_text(text)
        return folder / "pipeline.toml"

    def _graph(self) -> "_native.Graph":
        if self._opened is None:
            # Beside this Python, whether PATH names its folder or not; with what it imports.
            imported = [os.path.dirname(os.path.dirname(os.path.abspath(__file__)))]
            imported += filter(os.path.isabs, os.environ.get("PYTHONPATH", "").split(os.pathsep))
            script = os.path.join(os.path.dirname(sys.executable), "tailor-stage")
            _native.bring("tailor-stage", script, [folder for folder in imported if os.path.exists(folder)])
            self._opened = _native.Graph(
                self._file(), self._variant, self._sets, self._cache, self._threads, self._allow
            )
        return self._opened

    def _said(self) -> List[Tuple[str, str]]:
        return list(self._inputs.items())

    @property
    def about(self) -> str:
        """What the pipeline is for."""
        return json.loads(self._graph().about())["about"]

    @property
    def nodes(self) -> List[dict]:
        """The nodes, each after all that it reads: node, stage, kind, from, params."""
        return json.loads(self._graph().about())["nodes"]

    @property
    def inputs(self) -> List[dict]:
        """The inputs: name, what it is, patterns of its files."""
        return json.loads(self._graph().about())["inputs"]

    @property
    def goal(self) -> List[str]:
        """The nodes that are wanted when nobody says otherwise."""
        return json.loads(self._graph().about())["goal"]

    def __repr__(self) -> str:
        changed = [*([f"variant={self._variant}"] if self._variant else []), *self._sets]
        return f"<Pipeline {' '.join([self._base, *changed])}>"

    def plan(self, *nodes: str, kind: Optional[str] = None) -> Any:
        """What a run would do: nothing is run.

        Parameters
        ----------
        *nodes : str
            The nodes that are wanted; the pipeline's goal if none is said.
        kind : {'pandas', 'polars', 'dicts'}, optional
            Which table; if none is said, the first that is installed.

        Returns
        -------
        table
            A row a node: ``state`` is ``cached``, ``will run`` or ``may run`` (if something that it reads comes out
            otherwise than before), ``seconds`` what it took the last time, ``why`` what changed.
        """
        return frame(json.loads(self._graph().plan(self._said(), list(nodes))), kind)

    def run(self, *nodes: str, progress: Progress = None, keep_going: bool = False) -> Run:
        """Runs it, and finds what was made before.

        Parameters
        ----------
        *nodes : str
            The nodes that are wanted; the pipeline's goal if none is said. Results of others on the way are there, too.
        progress : callable, bool or None
            Who hears how it goes on: a function of a `tailor.Event`, True for a bar, False for nobody.
        keep_going : bool
            Go on with what does not depend on a failed node; `Run.failures` has the failed ones.

        Returns
        -------
        Run
            The results by node.

        Raises
        ------
        Error
            The pipeline or an input is wrong, or a stage failed.
        KeyboardInterrupt
            Ctrl-C. What is done is kept: the same call goes on.
        """
        with Hearing(progress, lambda: len(self.plan(*nodes, kind="dicts"))) as hear:
            native = self._graph().run(self._said(), list(nodes), keep_going, hear)
        return Run(native, list(self._folders))

    def sweep(
        self,
        name: Optional[str] = None,
        *,
        over: Optional[Mapping[str, Union[str, Sequence[Any]]]] = None,
        tell: Sequence[str] = (),
        nodes: Sequence[str] = (),
        truth: Optional[Path] = None,
        yes: bool = False,
        kind: Optional[str] = None,
        progress: Progress = None,
        replicate: Optional[int] = None,
    ) -> Any:
        """Runs every point of a sweep; what points share is made once. `tailor.sweep` gives more than the table.

        Parameters
        ----------
        name : str, optional
            A sweep that the pipeline declares.
        over : dict, optional
            Params and their values, crossed with what it declares: ``{"hull.voxel_mm": [2, 3, 4]}``, or as the command has
            it: ``{"hull.voxel_mm": "2..8/4"}``.
        tell : sequence of str
            Metrics to report: ``hull.volume``; none is what the sweep declares, else all that the wanted nodes tell.
        nodes : sequence of str
            Nodes that are wanted instead of the sweep's or the pipeline's goal.
        truth : path, optional
            A folder of ground truth: errors are reported beside.
        yes : bool
            Run even if there are more than a thousand points.
        kind : {'pandas', 'polars', 'dicts'}, optional
            Which table; if none is said, the first that is installed.
        progress : callable, bool or None
            Who hears how it goes on.
        replicate : int, optional
            How often each point is repeated, each time with other seeds of what is by chance.

        Returns
        -------
        table
            A row a point: its variant and params, metrics, ``made``, ``found``, ``seconds``, and ``trouble`` where it failed.
        """
        swept = self._swept(name, over, tell, nodes, truth, yes, progress, replicate)
        return swept.frame(kind)

    def _swept(
        self,
        name: Optional[str],
        over: Optional[Mapping[str, Union[str, Sequence[Any]]]],
        tell: Sequence[str],
        nodes: Sequence[str],
        truth: Optional[Path],
        yes: bool,
        progress: Progress,
        replicate: Optional[int],
    ) -> Sweep:
        words = [self._file(), *([name] if name else [])]
        words += [f"--set={s}" for s in self._sets]
        words += [f"--input={k}={v}" for k, v in self._said()]
        words += [f"--variant={self._variant}"] if self._variant else []
        for param, values in (over or {}).items():
            said = values if isinstance(values, str) else ",".join(toml(v, param) for v in values)
            words.append(f"--sweep={param}={said}")
        words += [f"--tell={t}" for t in tell]
        words += [f"--nodes={','.join(nodes)}"] if nodes else []
        words += [f"--truth={os.fspath(truth)}"] if truth is not None else []
        words += ["--yes"] if yes else []
        words += [f"--replicate={replicate}"] if replicate is not None else []
        with Hearing(progress, unit="point") as hear:
            text, _ = _native.sweep(words, self._cache, self._threads, self._allow, hear)
        return Sweep(json.loads(text))


def sweep(pipeline: Union[Pipeline, Path], name: Optional[str] = None, **said: Any) -> Sweep:
    """Runs every point of a sweep of a pipeline.

    Parameters
    ----------
    pipeline : Pipeline, path or name
        The pipeline; a file or the name of a built-in one is opened as `tailor.Pipeline` does.
    name : str, optional
        A sweep that it declares.
    **said
        ``over``, ``tell``, ``nodes``, ``truth``, ``yes``, ``replicate``, ``progress``, as `Pipeline.sweep` takes them.

    Returns
    -------
    Sweep
        Its points, replicates and comparisons as tables.
    """
    if not isinstance(pipeline, Pipeline):
        pipeline = Pipeline(pipeline)
    words = dict(over=None, tell=(), nodes=(), truth=None, yes=False, progress=None, replicate=None)
    unknown = set(said) - set(words)
    if unknown:
        raise TypeError(f"sweep takes no {', '.join(sorted(unknown))}; it takes {', '.join(words)}")
    return pipeline._swept(name, **{**words, **said})


def pipelines() -> List[str]:
    """The names of the built-in pipelines."""
    return _native.pipelines()
