"""What belongs to what in a pipeline."""

from typing import Callable, Dict, List, Optional, Sequence


def before(nodes: Sequence[dict], node: str) -> List[str]:
    """The nodes that a node needs, the nearest first."""
    by_name: Dict[str, dict] = {n["node"]: n for n in nodes}
    found: List[str] = []
    open_ = [node]
    while open_:
        for source in by_name.get(open_.pop(0), {"from": {}})["from"].values():
            if source in by_name and source not in found:
                found.append(source)
                open_.append(source)
    return found


def beside(nodes: Sequence[dict], node: str, kind: str) -> Optional[str]:
    """The node of a kind (photos) that belongs to a node (masks).

    It is what the node itself reads, or who reads the node reads beside it, or what it comes from; else the pipeline's
    first. What needs the node is none.
    """
    by_name: Dict[str, dict] = {n["node"]: n for n in nodes}
    is_kind: Callable[[str], bool] = lambda n: n in by_name and by_name[n]["kind"] == kind
    read = list(by_name[node]["from"].values()) if node in by_name else []
    readers = [n for n in nodes if node in n["from"].values()]
    siblings = [source for n in readers for source in n["from"].values()]
    for found in [*read, *siblings, *before(nodes, node), *by_name]:
        if is_kind(found) and found != node and node not in before(nodes, found):
            return found
    return None
