"""Values of params as a pipeline writes them (TOML)."""

import json
import math
import os
from typing import Any

from ._errors import Error


def toml(value: Any, what: str = "a value") -> str:
    """A value as TOML.

    Parameters
    ----------
    value : bool, int, float, str, path, list, tuple, dict or numpy scalar or array
        The value.
    what : str
        What it is called if it cannot be written.

    Returns
    -------
    str
        Its text.

    Raises
    ------
    Error
        It is of another type, or no finite number.
    """
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if not math.isfinite(value):
            raise Error(f"{what} is {value}: say a finite number")
        text = repr(value)
        return text if any(c in text for c in ".e") else text + ".0"
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        # JSON's escapes are TOML's but for DEL.
        return json.dumps(value, ensure_ascii=True).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml(v, what) for v in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{toml(str(k))} = {toml(v, what)}" for k, v in value.items()) + " }"
    raise Error(f"{what} is of type {type(value).__name__}: say a number, a text, a switch, a list or a table")
