"""Checks made bodies: closed, one piece, outside out, on the ground, no truth missing; how near `survey` came.

    python3 models/made/check_bodies.py OUT [FAMILY ...]

Prints what fails and ends with 1 if anything did.
"""
import json
import sys
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

# What a surface may stand off the ground, mm: subdivision and voxels move a sole a little.
GROUND = 2.0
# A tape on the surface as written against the template's, as a share; voxels, filled webs and fused armpits move limbs more.
TAPE = {"range": 0.15, "survey": 0.15, "poses": 0.01, "reach": 0.3}


def read_ply(path):
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    head = data[:end].decode().split()
    n, m = (int(head[head.index(k) + 1]) for k in ("vertex", "face"))
    v = np.frombuffer(data, "<f4", 3 * n, end).reshape(n, 3).astype(float)
    rows = np.frombuffer(data, [("n", "u1"), ("i", "<i4", (3,))], m, end + 12 * n)
    return v, rows["i"].astype(np.int64)


def faults(v, f, row):
    """What is wrong with one body, as words."""
    out = []
    e = np.vstack([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]])
    n = len(v)
    here, there = np.sort(e[:, 0] * n + e[:, 1]), np.sort(e[:, 1] * n + e[:, 0])
    if (np.diff(here) == 0).any() or (here != there).any():
        out.append("not closed, or an edge with more than two faces")
    pieces, _ = connected_components(coo_matrix((np.ones(len(e)), (e[:, 0], e[:, 1])), shape=(n, n)), directed=False)
    if pieces != 1:
        out.append(f"{pieces} pieces")
    volume = np.einsum("ij,ij->i", v[f[:, 0]], np.cross(v[f[:, 1]], v[f[:, 2]])).sum() / 6e9
    if not 0.2e1 < volume * 1000 < 400:
        out.append(f"holds {volume * 1000:.1f} litres")
    if abs(v[:, 2].min()) > GROUND or abs(v[:, 2].max() - row["stature"]) > 2 * GROUND + row["finish"].get("voxel", 0):
        out.append(f"stands from {v[:, 2].min():.1f} to {v[:, 2].max():.1f}, stature {row['stature']}")
    for name, p in row["planes"].items():
        if p["tape"] is None or p["tape_clean"] is None:
            out.append(f"{name} has no tape")
        elif abs(p["tape"] / p["tape_clean"] - 1) > TAPE[row["family"]]:
            out.append(f"{name}: {p['tape']} on the surface, {p['tape_clean']} on the template")
    m = row["marks"]
    order = ["crotch", "navel", "nipple_l", "suprasternale", "larynx"]
    if any(m[a][2] >= m[b][2] for a, b in zip(order, order[1:])):
        out.append("landmarks out of order")
    return out


def main():
    out, bad = Path(sys.argv[1]), 0
    for family in sys.argv[2:] or ["range", "survey", "poses", "reach"]:
        rows = []
        for path in sorted((out / family).glob("[0-9]*.json")):
            row = json.loads(path.read_text())
            rows.append(row)
            for fault in faults(*read_ply(path.with_suffix(".ply")), row):
                bad += 1
                print(f"{family} {path.stem}: {fault}")
        print(f"{family}: {len(rows)} bodies")
        for sex, word in ((1.0, "women"), (0.0, "men")):
            own = [r for r in rows if "target" in r and r["phenotype"]["gender"] == sex]
            for k in own[0]["target"] if own else []:
                d = np.array([r["achieved"][k] - r["target"][k] for r in own])
                print(f"  {word} {k}: {d.mean():+.1f} mm on average, sd {d.std():.1f}")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
