"""Tables: a frame of pandas, else of polars, else a list of dicts."""

from typing import Any, Dict, List, Optional

from ._errors import Error

Rows = List[Dict[str, Any]]


def frame(rows: Rows, kind: Optional[str] = None) -> Any:
    """Rows as a table.

    Parameters
    ----------
    rows : list of dict
        The rows, all with the same keys.
    kind : {'pandas', 'polars', 'dicts'}, optional
        Which; if none is said, the first of them that is installed.

    Returns
    -------
    pandas.DataFrame, polars.DataFrame or list of dict
        The table.
    """
    if kind not in (None, "pandas", "polars", "dicts"):
        raise Error(f"there is no frame `{kind}`; known: pandas, polars, dicts")
    if kind in (None, "pandas"):
        try:
            import pandas

            return pandas.DataFrame(rows)
        except ImportError:
            if kind:
                raise
    if kind in (None, "polars"):
        try:
            import polars

            return polars.DataFrame(rows)
        except ImportError:
            if kind:
                raise
    return rows


def flat(row: Dict[str, Any]) -> Dict[str, Any]:
    """A row without nests: what lies in a table of its own is ``key.name``, the ends of an interval ``key.lo`` and ``key.hi``,
    the numbers of a short list ``key.0`` and so on; texts of a list are one text; curves are left out."""
    out: Dict[str, Any] = {}
    for key, value in row.items():
        if isinstance(value, dict):
            out.update({f"{key}.{k}": v for k, v in flat(value).items()})
        elif not isinstance(value, list):
            out[key] = value
        elif all(isinstance(v, str) for v in value):
            out[key] = "; ".join(value)
        elif len(value) <= 3 and not any(isinstance(v, (list, dict)) for v in value):
            ends = ("lo", "hi") if "interval" in key and len(value) == 2 else range(len(value))
            out.update({f"{key}.{end}": v for end, v in zip(ends, value)})
    return out
