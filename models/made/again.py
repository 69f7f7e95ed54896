"""The same bodies captured again: made bodies remeshed as another reconstruction would leave them.

    python3 models/made/again.py OUT [--every 4]

Reads OUT/survey (bodies that are not remeshed themselves) and writes OUT/again: the surface on voxels of another size and
place, with other webs, and the first body's truth with `repeats` naming it. A body depends on its number alone.
"""
import argparse
import json
from pathlib import Path

import numpy as np
import trimesh

import families
import surface


def again(path, out):
    """Writes one body's second capture."""
    truth = json.loads(path.read_text())
    mesh = trimesh.load(path.with_suffix(".ply"), process=False)
    rng = families.stream("again", truth["number"])
    voxel, web = float(rng.uniform(4.0, 7.0)), float(rng.uniform(0.0, 15.0))
    marks = truth["marks"]
    half = 1.1 * max(abs(marks["acromion_l"][0]), abs(marks["acromion_r"][0]))
    box = ([-half, -1e3, marks["crotch"][2] - 150], [half, 1e3, marks["acromion_l"][2]])
    v, f = np.asarray(mesh.vertices) + rng.uniform(-3.0, 3.0, 3), np.asarray(mesh.faces)
    w, g = surface.remeshed(v, f, voxel, web, box)
    surface.write_ply(out / f"{path.stem}.ply", w, g)
    truth |= {"family": "again", "repeats": f"{path.parent.name}/{path.stem}", "finish": {"voxel": voxel, "web": web}}
    (out / path.name).write_text(json.dumps(truth))


def main():
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("out", type=Path)
    words.add_argument("--every", type=int, default=4)
    said = words.parse_args()
    out = said.out / "again"
    out.mkdir(exist_ok=True)
    paths = [p for p in sorted((said.out / "survey").glob("*.json")) if "voxel" not in json.loads(p.read_text())["finish"]]
    for path in paths[:: said.every]:
        again(path, out)


if __name__ == "__main__":
    main()
