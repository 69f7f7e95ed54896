#!/usr/bin/env python3
"""Takes a capture again through a phone's faults, one at a time, and writes what `docs/experiments.md` shows of it.

    docs/tables/faults.py TAILOR CAPTURE VARIANTS CACHE > docs/tables/faults.json

VARIANTS go before each fault: `no_plate`, `no_mat`, `no_plate,no_mat`, or `-` for none. CAPTURE/truth/mesh.ply is the true surface
[m]; ours is laid on it (rigidly, by nearest points), and both are cut by the planes of our girths. Wants numpy, scipy and trimesh.
"""

import csv
import datetime
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import trimesh
from scipy.spatial import ConvexHull, cKDTree

SHOWN = ["WC", "WC_narrowest", "WC_navel", "HC", "HC_max", "CC"]
PIPELINE = pathlib.Path(__file__).resolve().parents[2] / "pipelines" / "phone.toml"


def laid_on(points, true):
    """The rigid motion that lays points on a surface: the best of turns about z, then nearest points, the farthest tenth left out."""
    to = trimesh.sample.sample_surface(true, 40000, seed=1)[0]
    tree = cKDTree(to)

    def rounds(turn, move, count):
        for _ in range(count):
            far, near = tree.query(points @ turn.T + move)
            keep = far <= np.quantile(far, 0.9)
            a, b = points[keep], to[near[keep]]
            middle_a, middle_b = a.mean(0), b.mean(0)
            u, _, v = np.linalg.svd((a - middle_a).T @ (b - middle_b))
            turn = v.T @ np.diag([1, 1, np.linalg.det(v.T @ u.T)]) @ u.T
            move = middle_b - turn @ middle_a
        return np.minimum(far, 50).mean(), turn, move

    best = None
    for angle in np.radians(np.arange(0, 360, 15)):
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        tried = rounds(turn, to.mean(0) - turn @ points.mean(0), 8)
        best = tried if best is None or tried[0] < best[0] else best
    return rounds(best[1], best[2], 40)[1:]


def tape(surface, at, normal):
    """The tape around the part of a section whose middle is nearest to a point; none where it is open or missing. [mm]"""
    section = surface.section(plane_origin=at, plane_normal=normal)
    if section is None:
        return None
    lines = [line for line in section.discrete if np.allclose(line[0], line[-1])]
    line = min(lines, key=lambda line: np.linalg.norm(line.mean(0) - at), default=None)
    if line is None:
        return None
    across = np.cross(normal, [1.0, 0.0, 0.3])
    across /= np.linalg.norm(across)
    return ConvexHull(np.c_[line @ across, line @ np.cross(normal, across)]).area


def shares(girths, body, true):
    """Of each girth: how far its tape is off the true surface's at the same plane, arms not let in. [%]"""
    ours = trimesh.load(body, process=False)
    points = np.asarray(ours.vertices)
    turn, move = laid_on(points[:: max(1, len(points) // 8000)], true)
    ours.vertices = points @ turn.T + move
    found = {}
    for girth in girths:
        if girth["name"] in SHOWN and girth.get("plane"):
            at, normal = turn @ np.array(girth["plane"]["point_mm"]) + move, turn @ np.array(girth["plane"]["normal"])
            a, b = tape(ours, at, normal), tape(true, at, normal)
            # A section that runs into an arm on one of the two is no chest.
            if a and b and abs(a / b - 1) < 0.1:
                found[girth["name"]] = round(100 * (a / b - 1), 3)
    return found


def main(tailor, capture, variants, cache):
    """All faults of one capture."""
    before = [] if variants == "-" else variants.split(",")
    said = ["--input", f"photos={capture}", "--cache", cache]
    true = trimesh.load(pathlib.Path(capture, "truth", "mesh.ply"), process=False)
    true.apply_scale(1000)
    rows = {}
    with tempfile.TemporaryDirectory() as work:
        flags = ["--variant", variants] if before else []
        sweep = [tailor, "sweep", PIPELINE, "faults", *said, *flags, "--out", work, "--quiet"]
        subprocess.run(sweep, check=True, stdout=sys.stderr)
        for row in csv.DictReader(open(pathlib.Path(work, "sweep.csv"), encoding="utf-8")):
            fault, files = row["variant"], {}
            for node, name in (("girths", "girths.json"), ("body", "body.ply")):
                files[node] = pathlib.Path(work, f"{fault}-{name}")
                how = ["--as", "json"] if node == "girths" else []
                show = [tailor, "show", node, "--pipeline", PIPELINE, *said, "--variant", ",".join([fault, *before]), *how, "-o", files[node]]
                subprocess.run(show, check=True, stdout=subprocess.DEVNULL)
            told = json.loads(files["girths"].read_text())
            rows[fault] = {
                "tape_cm": {g["name"]: g["tape_cm"] for g in told["girths"]},
                "surface_pct": shares(told["girths"], files["body"], true),
                "missing": {m["name"]: m["reason"] for m in told["missing"]},
            }
    version = subprocess.run([tailor, "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    result = {"program": version, "date": datetime.date.today().isoformat(), "capture": pathlib.Path(capture).name, "variants": before, "rows": rows}
    json.dump(result, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
