"""What a sweep came to: points, replicates, comparisons, each as a flat table."""

from typing import Any, Dict, Optional

from .frames import Rows, frame


class Sweep:
    """What `tailor.sweep` gives.

    Attributes
    ----------
    document : dict
        All of it, as ``sweep.json`` has it.
    """

    def __init__(self, document: dict) -> None:
        self.document = document

    def __repr__(self) -> str:
        return f"<Sweep {self.document['sweep']}: {self.document['summary']}>"

    def __len__(self) -> int:
        return len(self.document["points"])

    def frame(self, kind: Optional[str] = None) -> Any:
        """A row a point: its variant and params, ``replicate``, metrics, ``made``, ``found``, ``seconds``, ``trouble``.

        Parameters
        ----------
        kind : {'pandas', 'polars', 'dicts'}, optional
            Which table; if none is said, the first that is installed.
        """
        return frame([_row(point) for point in self.document["points"]], kind)

    def replicates(self, kind: Optional[str] = None) -> Any:
        """A row a set of params and metric: ``n``, ``refused``, ``failed``, ``mean``, ``sd``, ``low95``, ``high95``."""
        rows: Rows = []
        for group in self.document.get("replicates", []):
            own = _params(group["variant"], group["params"])
            for m in group["metrics"]:
                low, high = m["interval"] or (None, None)
                told = {key: m[key] for key in ("n", "refused", "mean", "sd")}
                rows.append({**own, "metric": m["name"], "unit": m["unit"], **told, "failed": group["failed"], "low95": low, "high95": high})
        return frame(rows, kind)

    def paired(self, kind: Optional[str] = None) -> Any:
        """A row a comparison of two variants over replicates: ``effect``, ``low95``, ``high95``, ``p``, ``differ``, refusals."""
        rows: Rows = []
        for against in self.document.get("paired", []):
            for pair in against["pairs"]:
                low, high = pair["interval"] or (None, None)
                first, second = pair["means"] or (None, None)
                keys = ("unit", "n", "only_first", "only_second", "neither", "effect", "size", "p", "exact", "differ")
                own = {"first": against["first"], "second": against["second"], **_params(None, pair["params"])}
                told = {key: pair[key] for key in keys}
                rows.append({**own, "metric": pair["name"], **told, "mean_first": first, "mean_second": second, "low95": low, "high95": high})
        return frame(rows, kind)


def _params(variant: Optional[str], params: Dict[str, str]) -> Dict[str, Any]:
    own: Dict[str, Any] = {} if variant is None else {"variant": variant}
    own.update({k: number(v) for k, v in params.items() if "." in k})
    return own


def _row(point: dict) -> Dict[str, Any]:
    row: Dict[str, Any] = {k: number(v) for k, v in point["params"].items()}
    row.update({m["name"]: m["value"] for m in point["metrics"]})
    row.update(made=point["made"], found=point["found"], seconds=point["seconds"], trouble=point["why"])
    return row


def number(text: str) -> Any:
    """A param's value as the number that it is."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return {"true": True, "false": False}.get(text, text)
