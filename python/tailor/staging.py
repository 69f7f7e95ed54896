"""`tailor.stage`: a function of yours as a stage."""

import ast
import builtins
import dis
import inspect
import sys
import textwrap
import types
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple

from ._errors import Error
from .graphs import beside
from .values import toml

#: The kinds that a stage of yours can make.
MADE = ("masks", "mesh", "cameras", "photos", "document")
#: The kinds that it can read, and the format in which it gets them where that is not the usual one.
READ = {
    "photos": "", "masks": "", "mesh": "", "cameras": "", "document": "", "files": "", "girths": "", "landmarks": "",
    "tags": "", "warps": "", "textured": ":ply",
}  # fmt: skip


class Stage:
    """A function as a stage: call it as ever, or make it a node with `Pipeline.add`.

    Attributes
    ----------
    out : str
        The kind that it makes.
    source : str
        All that its result depends on beside its arguments: its text, that of the functions and the plain values of its
        module that it uses, and the versions of Python (3.12) and of the modules that it imports. It is in the key.
    """

    def __init__(
        self,
        function: Callable[..., Any],
        out: str,
        timeout_s: Optional[float] = None,
        memory_mb: Optional[float] = None,
        network: bool = False,
        reads: Sequence[str] = (),
    ) -> None:
        if out not in MADE:
            raise Error(f"a stage in Python makes {', '.join(MADE)}; not `{out}`")
        self.function = function
        self.out = out
        self.limits = {"timeout_s": timeout_s, "memory_mb": memory_mb, "network": network or None, "reads": list(reads) or None}
        self.__doc__ = function.__doc__
        self.__name__ = function.__name__
        self.__wrapped__ = function
        self.ports: List[str] = []
        self.params: Dict[str, Any] = {}
        for name, parameter in inspect.signature(function).parameters.items():
            if parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD):
                raise Error(f"{self.__name__} takes *{name}: name its ports and params one by one")
            if parameter.default is parameter.empty:
                self.ports.append(name)
            elif isinstance(parameter.default, (bool, int, float, str, list)):
                self.params[name] = parameter.default
            else:
                raise Error(f"{self.__name__}: the default of `{name}` must be a number, a text, a switch or a list")
        self.source = _source(function)

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        return self.function(*args, **kwargs)

    def __repr__(self) -> str:
        return f"<Stage {self.__name__}({', '.join([*self.ports, *self.params])}) → {self.out}>"

    def node(
        self, nodes: Sequence[dict], kinds: Mapping[str, str], said: Mapping[str, Any]
    ) -> Tuple[str, str, str]:
        """The stage as a node of a pipeline.

        Parameters
        ----------
        nodes : list of dict
            The pipeline's nodes, as `Pipeline.nodes`.
        kinds : dict
            The kinds of what it may read: of nodes by name, of inputs by ``@name``.
        said : dict
            Of ports the node that they read, of params their values.

        Returns
        -------
        table, file, source : str
            The node's keys as TOML, the name of the stage's file, and its text.
        """
        known = [*self.ports, *self.params]
        for name in said:
            if name not in known:
                raise Error(f"{self.__name__} has no argument `{name}`; it has {', '.join(known)}")
        from_: Dict[str, str] = {port: str(said.get(port, port)) for port in self.ports}
        for port, source in from_.items():
            if source not in kinds:
                raise Error(f"{self.__name__}: there is no node `{source}` for `{port}`; known: {', '.join(kinds)}")
            if kinds[source] not in READ:
                raise Error(f"{self.__name__}: {kinds[source]} (`{source}`) cannot be read in Python; known: {', '.join(READ)}")
        # Masks are named after photos, which must be there for that.
        read = [kinds[source] for source in from_.values()]
        if "photos" not in read and ("masks" in read or self.out == "masks"):
            of = [source for source in from_.values() if kinds[source] == "masks"] or list(from_.values())
            photos = beside(nodes, of[0], "photos") if of else None
            if photos is None:
                raise Error(f"{self.__name__}: masks belong to photos, and this pipeline has none")
            from_["_photos"] = photos
        values = {name: said.get(name, default) for name, default in self.params.items()}
        for name, value in values.items():
            if isinstance(self.params[name], float) and isinstance(value, int) and not isinstance(value, bool):
                values[name] = float(value)
        file = f"{self.__name__}.py"
        command = ["tailor-stage", f"{{here}}/{file}:{self.__name__}", f"{self.out}={{out}}"]
        command += [f"{port}={kinds[s]}:{{from.{port}{READ[kinds[s]]}}}" for port, s in from_.items()]
        command += [f"{name}={{with.{name}}}" for name in values]
        table = [
            'stage = "exec"',
            f"command = {toml(command)}",
            f"out = {toml(self.out)}",
            f"from = {toml(from_)}",
            f"with = {toml(values)}",
            f"files = {toml([file])}",
            'env = ["PYTHONPATH"]',
            "keep = true",
            *(f"{name} = {toml(limit, name)}" for name, limit in self.limits.items() if limit is not None),
        ]
        return "\n".join(table) + "\n", file, self.source


def stage(
    out: str,
    *,
    timeout_s: Optional[float] = None,
    memory_mb: Optional[float] = None,
    network: bool = False,
    reads: Sequence[str] = (),
) -> Callable[[Callable[..., Any]], Stage]:
    """Makes a function a stage: hashed, cached, swept and resumed as all others are.

    Arguments without a default are ports: they get what other nodes made, as `Run` gives it (photos, masks, a mesh,
    cameras; girths, landmarks and tags as their JSON). Arguments with a default are params. The function runs in a
    process of its own, which is kept for the run. It must be deterministic, and use of its module only functions, plain
    values and imported modules: all that is in the key.

    Parameters
    ----------
    out : {'masks', 'mesh', 'cameras', 'photos', 'document'}
        What it makes; it returns what `Pipeline.put` takes.
    timeout_s : float, optional
        How long it may take; an hour if not said.
    memory_mb : float, optional
        What it may hold with its children.
    network : bool
        Whether it may reach the network (kept from it by bubblewrap, where that is installed).
    reads : list of str
        Files and folders that it reads besides, by whole paths: in the key by content. In bubblewrap it sees nothing
        else of this machine but what is installed.

    Examples
    --------
    >>> @tailor.stage(out="masks")  # doctest: +SKIP
    ... def dark(photos, level=128):
    ...     return {i: photo.mean(axis=2) < level for i, photo in photos.items()}
    >>> tailor.Pipeline("body").add("masks", dark, level=90)  # doctest: +SKIP
    """
    if not isinstance(out, str):
        raise Error('name what it makes: @tailor.stage(out="masks")')
    return lambda function: Stage(function, out, timeout_s, memory_mb, network, reads)


def _text(function: Any, name: str) -> str:
    """A definition's text, without decorators."""
    try:
        text = textwrap.dedent(inspect.getsource(function))
    except (OSError, TypeError):
        raise Error(f"the text of {name} cannot be read: define it in a file or a notebook") from None
    tree = ast.parse(text).body[0]
    if not isinstance(tree, (ast.FunctionDef, ast.ClassDef)):
        raise Error(f"{name} is no plain function: write it with `def`")
    return "\n".join(text.splitlines()[tree.lineno - 1 :])


def _names(code: types.CodeType) -> List[str]:
    """Global names that code reads, its inner functions' too."""
    loads = [i.argval for i in dis.get_instructions(code) if i.opname in ("LOAD_GLOBAL", "LOAD_NAME")]
    inner = [c for c in code.co_consts if isinstance(c, types.CodeType)]
    return [*loads, *(name for c in inner for name in _names(c))]


def _plain(value: Any) -> bool:
    if isinstance(value, (list, tuple)):
        return all(map(_plain, value))
    if isinstance(value, dict):
        return all(map(_plain, value)) and all(map(_plain, value.values()))
    return value is None or isinstance(value, (bool, int, float, str, bytes))


def _imported(name: str, value: Any, own: str) -> Optional[Tuple[str, str]]:
    """The line that imports a value, and the module; None if it is the function's own module's."""
    if isinstance(value, types.ModuleType):
        line = f"import {value.__name__} as {name}" if value.__name__ != name else f"import {name}"
        return line, value.__name__
    module, called = getattr(value, "__module__", None), getattr(value, "__name__", None)
    if isinstance(module, str) and module != own and called:
        if getattr(sys.modules.get(module), called, None) is value:
            return f"from {module} import {called} as {name}", module
    return None


def _source(function: Callable[..., Any]) -> str:
    """A text that defines a function with all that it uses."""
    own = function.__module__
    imports: Dict[str, str] = {}
    values: Dict[str, str] = {}
    texts: Dict[str, str] = {}
    open_: List[Tuple[str, Any]] = [(function.__name__, function)]
    while open_:
        name, definition = open_.pop()
        if name in texts:
            continue
        texts[name] = _text(definition, name)
        code, where = definition.__code__, definition.__globals__
        cells = zip(code.co_freevars, definition.__closure__ or ())
        used = {**{n: where[n] for n in _names(code) if n in where}, **{n: c.cell_contents for n, c in cells}}
        for needed, value in sorted(used.items()):
            if isinstance(value, Stage):
                value = value.function
            line = _imported(needed, value, own)
            if line:
                imports[line[0]] = line[1]
            elif isinstance(value, types.FunctionType):
                open_.append((needed, value))
            elif _plain(value):
                values[needed] = f"{needed} = {value!r}"
            elif getattr(builtins, needed, None) is not value:
                raise Error(
                    f"{name} uses `{needed}`, a {type(value).__name__}, which cannot be in a key: make it an argument, "
                    "or a number, a text, a function or a module"
                )
    modules = sorted({module.split(".")[0] for module in imports.values()} | {own.split(".")[0]})
    told = [(m, getattr(sys.modules.get(m), "__version__", None)) for m in modules]
    # Within a minor version Python's own results stay.
    python = f"# {sys.implementation.name} {sys.version_info.major}.{sys.version_info.minor}"
    head = [python] + [f"# {module} {version}" for module, version in told if isinstance(version, str)]
    body = [texts[name] for name in sorted(texts)]
    return "\n".join([*head, *sorted(imports), *(values[n] for n in sorted(values)), "", "\n\n\n".join(body), ""])
