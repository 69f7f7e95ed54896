#!/usr/bin/env python3
"""Takes a capture again through a phone's faults, one at a time, and writes what `docs/lab/phone.md` shows of it.

    docs/tables/faults.py TAILOR CAPTURE VARIANTS CACHE [free-scale] > docs/tables/faults.json

VARIANTS go before each fault: `no_plate`, `no_mat`, `no_plate,no_mat`, or `-` for none. CAPTURE/truth/mesh.ply is the true surface
[m]; ours is laid on it (rigidly, by nearest points), and both are cut by the planes of our girths. With `free-scale` ours is brought to
its size, too, for without a mat a scale hangs on a disk's edge or is none: `surface_pct` is then of the shape alone, and `scale_pct`
says how much too large ours was. Wants numpy, scipy and trimesh.
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


def laid_on(points, true, free_scale):
    """The motion that lays points on a surface: the best of turns about z, then nearest points, the farthest tenth left out.

    A size beside a rotation and a way; the size is 1 unless it is free. Where it is, rounds begin at the same height."""
    to = trimesh.sample.sample_surface(true, 40000, seed=1)[0]
    tree = cKDTree(to)
    first = np.ptp(to[:, 2]) / np.ptp(points[:, 2]) if free_scale else 1.0

    def rounds(size, turn, move, count):
        for _ in range(count):
            far, near = tree.query(size * points @ turn.T + move)
            keep = far <= np.quantile(far, 0.9)
            a, b = points[keep], to[near[keep]]
            middle_a, middle_b = a.mean(0), b.mean(0)
            u, lengths, v = np.linalg.svd((a - middle_a).T @ (b - middle_b))
            sides = np.array([1, 1, np.linalg.det(v.T @ u.T)])
            turn = v.T @ np.diag(sides) @ u.T
            if free_scale:
                size = (lengths * sides).sum() / ((a - middle_a) ** 2).sum()
            move = middle_b - size * turn @ middle_a
        return np.minimum(far, 50).mean(), size, turn, move

    best = None
    for angle in np.radians(np.arange(0, 360, 15)):
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        tried = rounds(first, turn, to.mean(0) - first * turn @ points.mean(0), 8)
        best = tried if best is None or tried[0] < best[0] else best
    return rounds(*best[1:], 40)[1:]


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


def of(entry, name):
    """A length of a girth or a point of its plane, whether it has millimetres or is relative."""
    return next((entry[key] for key in entry if key.rsplit("_", 1)[0] == name), None)


def shares(girths, body, true, free_scale, shown=SHOWN):
    """Of each girth: how far its tape is off the true surface's at the same plane, arms not let in; and how much too large ours is. [%]"""
    ours = trimesh.load(body, process=False)
    points = np.asarray(ours.vertices)
    size, turn, move = laid_on(points[:: max(1, len(points) // 8000)], true, free_scale)
    ours.vertices = size * points @ turn.T + move
    found = {}
    for girth in girths:
        if girth["name"] in shown and girth.get("plane"):
            at, normal = size * turn @ np.array(of(girth["plane"], "point")) + move, turn @ np.array(girth["plane"]["normal"])
            a, b = tape(ours, at, normal), tape(true, at, normal)
            # A section that runs into an arm is no chest: ours where the program split the arm off, the true one where it is far longer.
            told = size * (10 * girth["tape_cm"] if "tape_cm" in girth else girth["tape_rel"])
            if a and b and abs(a / told - 1) < 0.01 and abs(a / b - 1) < 0.1:
                found[girth["name"]] = round(100 * (a / b - 1), 3)
    return found, round(100 * (1 / size - 1), 3)


def measured(show, true, free_scale):
    """What one capture came to: `show(node, file)` writes a result's file, or says why there is none."""
    with tempfile.TemporaryDirectory() as work:
        girths, body = pathlib.Path(work, "girths.json"), pathlib.Path(work, "body.ply")
        why = show("girths", girths) or show("body", body)
        if why:
            return {"failed": why}
        told = json.loads(girths.read_text())
        surface, size = shares(told["girths"], body, true, free_scale)
    row = {"surface_pct": surface, "missing": {m["name"]: m["reason"] for m in told["missing"]}}
    unit = "tape_cm" if told["unit"] == "cm" else "tape_rel"
    row[unit] = {g["name"]: g[unit] for g in told["girths"]}
    if free_scale and unit == "tape_cm":
        row["scale_pct"] = size
    return row


def main(tailor, capture, variants, cache, scale=""):
    """All faults of one capture."""
    free_scale = {"": False, "free-scale": True}[scale]
    before = [] if variants == "-" else variants.split(",")
    said = ["--input", f"photos={capture}", "--cache", cache]
    true = trimesh.load(pathlib.Path(capture, "truth", "mesh.ply"), process=False)
    true.apply_scale(1000)
    rows = {}
    with tempfile.TemporaryDirectory() as work:
        flags = ["--variant", variants] if before else []
        sweep = [tailor, "sweep", PIPELINE, "faults", *said, *flags, "--out", work, "--quiet"]
        # A point that fails ends with 1, and its row says so.
        if subprocess.run(sweep, stdout=sys.stderr).returncode not in (0, 1):
            sys.exit("the sweep could not be run")
        for line in csv.DictReader(open(pathlib.Path(work, "sweep.csv"), encoding="utf-8")):
            fault = line["variant"]

            def show(node, file, fault=fault):
                how = ["--as", "json"] if node == "girths" else []
                flags = ["--pipeline", PIPELINE, *said, "--variant", ",".join([fault, *before])]
                done = subprocess.run([tailor, "show", node, *flags, *how, "-o", file], capture_output=True, text=True)
                return done.stderr.strip() if done.returncode else None

            rows[fault] = measured(show, true, free_scale)
            print(fault, rows[fault], file=sys.stderr)
    version = subprocess.run([tailor, "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    result = {"program": version, "date": datetime.date.today().isoformat(), "capture": pathlib.Path(capture).name, "variants": before}
    result |= {"free_scale": free_scale, "rows": rows}
    json.dump(result, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
