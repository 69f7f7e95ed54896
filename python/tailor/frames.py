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
