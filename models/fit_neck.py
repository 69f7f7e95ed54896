"""Feature table of necks, and the fit of what `planes/neck_level.rs` holds.

    python3 models/fit_neck.py table MADE TOOL models/tables/neck.csv   # MADE: made bodies; TOOL: example neck_features
    python3 models/fit_neck.py fit models/tables/neck.csv

Made bodies are those of models/made (FAMILY/NNNN.ply and .json). Offsets are along the neck's axis from its tightest
section, as shares of its diameter `d` [mm]. `notch` (suprasternale) and `larynx` are carried template vertices;
`rig_lean` is the line of the rig's joints [degrees]; `tape_larynx` the tape square to the neck's own axis through the
larynx [mm]; `tape_rig` the rig's tape there, square to the line of its joints [mm].
"""
import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull

FAMILIES = ("range", "reach", "survey")
TOLD = ("up", "low", "hollow", "hollow_depth", "angle", "angle_depth", "nape", "lean", "head", "d", "told", "sigma")
MORE = ("placed", "tape", "notch", "larynx", "rig_lean", "tape_larynx", "tape_rig")
SHARE = 2 / 3


def read_ply(path):
    data = path.read_bytes()
    head, body = data.split(b"end_header\n", 1)
    count = {w.split()[1]: int(w.split()[2]) for w in head.decode().splitlines() if w.startswith("element")}
    v = np.frombuffer(body, "<f4", 3 * count["vertex"]).reshape(-1, 3)
    face = np.dtype([("n", "u1"), ("i", "<i4", (3,))])
    return v, np.frombuffer(body, face, count["face"], 12 * count["vertex"])["i"]


def tape(v, f, point, normal, near):
    """Tape around the piece of a section whose middle is nearest to a place; None without one."""
    h = (v - point) @ normal
    s = h[f] >= 0
    f = f[s.any(axis=1) & ~s.all(axis=1)]
    e = np.sort(np.vstack([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]]), axis=1)
    face = np.tile(np.arange(len(f)), 3)
    cut = (h[e[:, 0]] >= 0) != (h[e[:, 1]] >= 0)
    face, (e, at) = face[cut], np.unique(e[cut], axis=0, return_inverse=True)
    if len(e) < 6:
        return None
    t = (h[e[:, 0]] / (h[e[:, 0]] - h[e[:, 1]]))[:, None]
    p = v[e[:, 0]] * (1 - t) + v[e[:, 1]] * t
    link = coo_matrix((np.ones(len(face)), (face, at.ravel())), shape=(len(f), len(e)))
    _, piece = connected_components(link.T @ link, directed=False)
    pieces = [p[piece == k] for k in range(piece.max() + 1)]
    best = min((q for q in pieces if len(q) > 5), key=lambda q: np.linalg.norm(q.mean(axis=0) - near), default=None)
    if best is None:
        return None
    x = np.cross(normal, [1.0, 0, 0])
    x /= np.linalg.norm(x)
    return float(ConvexHull(np.column_stack([best @ x, best @ np.cross(normal, x)])).area)


def row(name, told, made):
    """One body's row; `told` is what the tool says."""
    family, number = name.split("/")
    truth = json.loads((made / f"{name}.json").read_text())
    v, f = read_ply(made / f"{name}.ply")
    v = v.astype(float)
    marks, rig = truth["marks"], truth["planes"]["neck"]
    origin = np.array([told[k] for k in "xyz"])
    axis = np.array([told["n" + k] for k in "xyz"])
    offset = {k: float((np.array(marks[k]) - origin) @ axis) for k in ("suprasternale", "larynx")}
    at = origin + axis * offset["larynx"]
    here = f[(v[f][:, :, 2] > origin[2] - 3 * told["d"]).all(axis=1)]
    front = axis * [1, 1, 0] / np.linalg.norm(axis[:2])
    n = np.array(rig["normal"])
    told = dict(
        told,
        notch=offset["suprasternale"] / told["d"],
        larynx=offset["larynx"] / told["d"],
        rig_lean=np.degrees(np.arctan2(n @ front, n[2])),
        tape_larynx=tape(v, here, at, axis, at) or "",
        tape_rig=rig["tape"],
        lean=np.degrees(told["lean"]),
    )
    cells = [told[k] for k in TOLD + MORE]
    cells = [c if c == "" else f"{c:.4g}" if abs(c) < 10 else f"{c:.1f}" for c in cells]
    return [family, number, truth.get("years", ""), f"{truth['stature']:.0f}", *cells]


def table(made, tool, out):
    names = [f"{k}/{p.stem}" for k in FAMILIES for p in sorted((made / k).glob("[0-9]*.json"))]
    with tempfile.TemporaryDirectory() as folder:
        lines = []
        for i, name in enumerate(names):
            v, f = read_ply(made / f"{name}.ply")
            path = Path(folder) / f"{i}.raw"
            path.write_bytes(np.array([len(v), len(f)], "<u4").tobytes() + v.tobytes() + f.astype("<u4").tobytes())
            lines.append(f"{name} {path}")
        (Path(folder) / "list").write_text("\n".join(lines))
        said = subprocess.run([tool, f"{folder}/list"], capture_output=True, text=True, check=True).stdout
    with open(out, "w", newline="") as sheet:
        write = csv.writer(sheet, lineterminator="\n")
        write.writerow(["family", "number", "years", "stature", *TOLD, *MORE])
        for line in said.splitlines():
            name, *cells = line.split()
            told = {k: float(x) for k, x in (c.split("=") for c in cells if "=" in c)}
            if "nx" in told:
                write.writerow(row(name, told, made))
            else:
                print(f"{name}: no neck")


def line(x, y):
    slope, always = np.polyfit(x, y, 1)
    return always, slope


def told(t, notch):
    """Level and sigma, as planes/neck_level.rs has them, of a table with a notch line and its deviation."""
    (always, slope), sd = notch
    low = np.minimum(always + slope * t["low"], t["angle"] - 0.1)
    larynx = low + SHARE * (t["angle"] - low)
    own = ((1 - SHARE) * sd) ** 2 + (SHARE * 0.05) ** 2 + (0.08 * (t["angle"] - low)) ** 2
    return larynx, np.sqrt(own)


def fit(path):
    with open(path) as sheet:
        rows = list(csv.DictReader(sheet))
    family = np.array([r["family"] for r in rows])
    t = {k: np.array([float(r[k] or "nan") for r in rows]) for k in TOLD + MORE}
    always, slope = line(t["low"], t["notch"])
    print(f"{len(rows)} bodies; notch = {always:.3f} + {slope:.3f} low")
    left, level, sigma = (np.full(len(rows), np.nan) for _ in range(3))
    for k in FAMILIES:
        out = family == k
        if not out.any():
            continue
        law = line(t["low"][~out], t["notch"][~out])
        left[out] = t["notch"][out] - law[0] - law[1] * t["low"][out]
        level[out], sigma[out] = told({n: x[out] for n, x in t.items()}, (law, 0.111))
        report(k, left[out], (level - t["larynx"])[out], sigma[out], {n: x[out] for n, x in t.items()})
    report("all", left, level - t["larynx"], sigma, t)


def report(name, notch, level, sigma, t):
    lean = t["lean"] - t["rig_lean"]
    own, rig = (np.abs(t["tape"] / t[k] - 1) * 100 for k in ("tape_larynx", "tape_rig"))
    own = own[~np.isnan(own)]
    print(f"{name} ({len(notch)}), held out:")
    print(f"  notch    {np.mean(notch):+.3f} ± {np.std(notch):.3f} of the diameter")
    print(f"  level    {np.mean(level):+.3f} ± {np.std(level):.3f}; {np.mean(level * t['d']):+.1f} ± {np.std(level * t['d']):.1f} mm")
    print(f"  covered  {np.mean(np.abs(level) < 1.645 * sigma):.2f} of 90 %")
    print(f"  lean     {np.mean(lean):+.1f} ± {np.std(lean):.1f} degrees against the rig's joints")
    print(f"  tape     {np.median(own):.1f}; {np.quantile(own, 0.9):.1f} % middle and nine in ten, against the larynx and own axis")
    print(f"           {np.median(rig):.1f}; {np.quantile(rig, 0.9):.1f} % against the rig's plane")


if __name__ == "__main__":
    if sys.argv[1:2] == ["table"]:
        table(Path(sys.argv[2]), sys.argv[3], sys.argv[4])
    else:
        fit(sys.argv[2])
