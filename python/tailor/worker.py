"""``tailor-stage``: runs a function as a stage.

    tailor-stage FILE.py:FUNCTION KIND=OUT [PORT=KIND:PATH]... [PARAM=VALUE]...

Without arguments it stays, and takes such words as lines of JSON on standard input (`keep` in a pipeline): it answers each
with a line, ``{"done": true}`` or ``{"failed": "why"}``.
"""

import inspect
import json
import os
import re
import shutil
import sys
import tempfile
import traceback
from pathlib import Path
from typing import Any, Callable, Dict, List

from . import _native
from ._errors import Error
from .artifacts import Cameras, Photos, read
from .files import write

_LOADED: Dict[str, dict] = {}
#: How a file begins that `tailor.stage` wrote.
_WRITTEN = re.compile(r"# \w+ \d+\.\d+\n")


def _function(place: str) -> Callable[..., Any]:
    """The function of a file, loaded once a text."""
    path, _, name = place.rpartition(":")
    text = Path(path).read_text()
    if text not in _LOADED:
        space: dict = {"__name__": "tailor_stage", "__file__": path}
        exec(compile(text, os.path.basename(path), "exec"), space)
        _LOADED[text] = space
    found = _LOADED[text].get(name)
    found = getattr(found, "function", found)
    if not callable(found):
        raise Error(f"{os.path.basename(path)} has no function `{name}`")
    return found


def _taken(kind: str, path: str, beside: Any) -> Any:
    """What lies at a path, as `Run` gives it."""
    if kind in ("girths", "landmarks", "tags", "warps"):
        return json.loads(Path(path).read_text())
    if kind == "cameras":
        return Cameras.of(json.loads(Path(path).read_text()))
    if kind == "files":
        return Path(path)
    if os.path.isfile(path):
        # Importers read folders.
        with tempfile.TemporaryDirectory() as folder:
            name = "mesh.ply" if kind in ("mesh", "textured") else os.path.basename(path)
            shutil.copyfile(path, os.path.join(folder, name))
            return read(_native.taken("mesh" if kind == "textured" else kind, folder, beside))
    return read(_native.taken(kind, path, beside))


def _value(text: str, default: Any) -> Any:
    if isinstance(default, str):
        return text
    value = json.loads(text)
    return float(value) if isinstance(default, float) else value


def run(words: List[str]) -> None:
    """Runs a stage.

    Raises
    ------
    Error
        What is wrong with the words, or with what the function gave back.
    """
    if len(words) < 2:
        raise Error(f"name what to run: {(__doc__ or '').splitlines()[2].strip()}")
    function = _function(words[0])
    out, _, place = words[1].partition("=")
    parameters = inspect.signature(function).parameters
    arguments: Dict[str, Any] = {}
    ports = []
    for word in words[2:]:
        name, _, text = word.partition("=")
        if name in parameters and parameters[name].default is not inspect.Parameter.empty:
            arguments[name] = _value(text, parameters[name].default)
        else:
            kind, _, path = text.partition(":")
            ports.append((name, kind, path))
    photos = None
    # Photos first: others are read beside them.
    for name, kind, path in sorted(ports, key=lambda port: port[1] != "photos"):
        value = _taken(kind, path, photos)
        if kind == "photos":
            photos = value._native
        if name in parameters:
            arguments[name] = value
    made = function(**arguments)
    if made is None:
        raise Error(f"{function.__name__} gave nothing back; it must return what `{out}` are")
    target = Path(place) if os.path.isdir(place) else Path(place).parent
    write(out, made, target, lambda: Photos(photos).names if photos is not None else [])


def _told(why: BaseException) -> str:
    """An exception with its place in the user's text."""
    if isinstance(why, Error):
        return str(why)
    texts = {os.path.basename(space["__file__"]): text for text, space in _LOADED.items()}
    frames = traceback.extract_tb(why.__traceback__)
    frame = next((f for f in reversed(frames) if f.filename in texts), None)
    if frame is None:
        return f"{type(why).__name__}: {why}"
    text = texts[frame.filename]
    line = text.splitlines()[(frame.lineno or 1) - 1].strip()
    # Who made a function a stage by `tailor.stage` never saw the file that it went into.
    number = "" if _WRITTEN.match(text) else f"line {frame.lineno} of {frame.filename}, "
    return f"{type(why).__name__}: {why} ({number}in {frame.name}: `{line}`)"


def main() -> int:
    """The program; its exit code."""
    words = sys.argv[1:]
    if words:
        try:
            run(words)
        except Exception as why:
            print(_told(why), file=sys.stderr)
            return 1
        return 0
    answers, sys.stdout = sys.stdout, sys.stderr
    print('{"ready": true}', file=answers, flush=True)
    for line in sys.stdin:
        try:
            run(json.loads(line))
            answer: dict = {"done": True}
        except Exception as why:
            answer = {"failed": _told(why)}
        sys.stdout.flush()
        print(json.dumps(answer), file=answers, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
