#!/usr/bin/env python3
"""Measures bodies that nothing was fitted to and writes how often intervals hold (`docs/lab/girths.md`).

    docs/tables/strangers.py TAILOR BODIES SCANS [FROM TO] > docs/tables/strangers.json

BODIES is the folder that `models/made/strangers.py` wrote, of which those from FROM to before TO (380, 408) are measured: those before
were looked at while the program was made. `people` of a level is how many deviations of the survey's people of the same true heights and
girths the rig's own level is above theirs. SCANS has PLY files of people (mm, soles at z = 0, facing -y) and levels.json, heights of WC and CC
set by eye with a half width: the true tape is the program's own girth there, arms parted as it parts them, and at both ends of what the eye
leaves open. Of a drawn neck the tape is taken twice: in the rig's plane, which may
run through shoulders or chin, and through the same larynx as a tape comes to rest that is free to tilt: where it is shortest (`NC_rest`).
So are those of upper arms (`AC_rest`, both): the rig's line of joints is not the arm's own. An arm that is one with the trunk there has none.
Wants numpy, scipy and trimesh.
"""

import csv
import functools
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import timed
import trimesh
from scipy.spatial import ConvexHull

PLANES = {"HC": "hip", "WC_navel": "navel", "CC": "chest", "NC": "neck", "AC_L": "upper_arm_l", "AC_R": "upper_arm_r"}
PLANES |= {"TC_L": "thigh_l", "TC_R": "thigh_r", "CFC_L": "calf_l", "CFC_R": "calf_r"}
BY_EYE = ["WC", "CC"]
FUSED = 0.1
LEVEL = ["HC", "WC_navel", "CC"]
SURVEY = pathlib.Path(__file__).parent.parent.parent / "models" / "tables" / "ansur2.csv"
KNOWN = ["buttockheight", "cervicaleheight", "neckcircumference", "buttockcircumference", "waistcircumference", "chestcircumference"]
LEVELS = {"CC": ("chestheight", "nipple_l"), "WC_navel": ("waistheightomphalion", "navel")}


def girths(tailor, surface, own=None):
    """What the program gives: girths and what is missing; `own` are girths of one's own, shares of the way from hip to neck by name."""
    sets = [f"landmarks.girth.{n}.{k}={v}" for n, at in (own or {}).items() for k, v in (("part", "trunk"), ("at", at))]
    with tempfile.TemporaryDirectory() as work:
        flags = ["--out", f"{work}/out", "--cache", f"{work}/cache", "--quiet", *(w for s in sets for w in ("--set", s))]
        subprocess.run([tailor, "measure", surface, *flags], check=True, stdout=subprocess.DEVNULL)
        told = json.loads(pathlib.Path(work, "out", "girths.json").read_text())
    return {g["name"]: g for g in told["girths"]}, {m["name"]: m["reason"] for m in told["missing"]}


def row(name, given, missing, truth):
    """A girth: why it is missing, or tape, interval and truth. [mm]"""
    if name not in given:
        return {"girth": name, "missing": missing.get(name, "unknown"), "truth": truth}
    low, high = given[name]["interval_cm"] or (None, None)
    mm = lambda cm: None if cm is None else round(10 * cm, 1)
    return {"girth": name, "tape": mm(given[name]["tape_cm"]), "low": mm(low), "high": mm(high), "truth": truth}


def drawn(tailor, truth_file):
    """The rows of a drawn body."""
    truth = json.loads(truth_file.read_text())
    given, missing = girths(tailor, truth_file.with_suffix(".ply"))
    rows = [row(n, given, missing, truth["planes"][p]["tape_clean"]) for n, p in PLANES.items()]
    for r in rows:
        if r["girth"] in LEVELS:
            r["people"] = above_people(truth, *LEVELS[r["girth"]])
        if r["girth"] in LEVEL and "tape" in r:
            r["level"] = round(given[r["girth"]]["plane"]["point_mm"][2] - truth["planes"][PLANES[r["girth"]]]["point"][2], 1)
    mesh = trimesh.load(truth_file.with_suffix(".ply"), process=False)
    if "NC" in given:
        larynx = truth["marks"]["larynx"]
        leans = np.radians(np.arange(-20, 61, 4))
        tape = min(around(mesh, larynx, [0, -np.sin(a), np.cos(a)], given["NC"]["plane"]["point_mm"]) for a in leans)
        rows.append(row("NC", given, missing, tape) | {"girth": "NC_rest"})
    for name in sorted({"AC_L", "AC_R"} & set(given)):
        plane = truth["planes"][PLANES[name]]
        tape = resting(mesh, np.array(plane["point"]), np.array(plane["normal"]))
        if abs(tape / plane["tape_clean"] - 1) < FUSED:
            rows.append(row(name, given, missing, tape) | {"girth": "AC_rest"})
    return {"body": truth["number"], "touching": truth["pose"]["arm_l"] < 15, "remeshed": "voxel" in truth["finish"], "rows": rows}


@functools.cache
def people(level):
    """Means and covariances of the survey's women and men: heights and girths as shares of stature, its logarithm, and a level."""
    with SURVEY.open() as file:
        rows = list(csv.DictReader(file))
    shares = lambda row: [float(row[c]) / float(row["stature"]) for c in [*KNOWN, level]]
    of = lambda sex: np.array([[np.log(float(r["stature"])), *shares(r)] for r in rows if r["sex"] == sex])
    return [(x.mean(axis=0), np.cov(x.T)) for x in map(of, "fm")]


def above_people(truth, level, mark):
    """How far a drawn body's mark is above where people of the likelier sex have it, whose other measures are all its own. [deviations]"""
    tall, marks, planes = truth["stature"], truth["marks"], truth["planes"]
    own = [marks["buttock"][2], marks["cervicale"][2], *(planes[p]["tape_clean"] for p in ("neck", "hip", "navel", "chest"))]
    own = np.array([np.log(tall), *(x / tall for x in own)])
    fits = []
    for mean, spread in people(level):
        among, across = spread[:-1, :-1], spread[:-1, -1]
        off, weights = own - mean[:-1], np.linalg.solve(among, across)
        log = -(off @ np.linalg.solve(among, off) + np.linalg.slogdet(among)[1]) / 2
        at = mean[-1] + weights @ off
        fits.append((log, (marks[mark][2] / tall - at) / np.sqrt(spread[-1, -1] - weights @ across)))
    return round(float(max(fits)[1]), 2)


def around(mesh, point, normal, near):
    """The tape around the ring of a plane that is nearest to a place. [mm]"""
    section = mesh.section(plane_origin=point, plane_normal=normal)
    far = lambda ring: np.linalg.norm((ring.min(axis=0) + ring.max(axis=0)) / 2 - near)
    ring = min(section.discrete, key=far)
    flat = trimesh.transform_points(ring, trimesh.geometry.plane_transform(point, normal))[:, :2]
    hull = flat[ConvexHull(flat).vertices]
    return round(float(np.linalg.norm(hull - np.roll(hull, 1, axis=0), axis=1).sum()), 1)


def resting(mesh, place, normal):
    """The shortest tape through a place that is free to tilt either way, by up to 20 degrees off a normal. [mm]"""
    aside = np.cross(normal, [0.0, 1.0, 0.0])
    for axis in (aside, np.cross(normal, aside)):
        turns = [trimesh.transformations.rotation_matrix(np.radians(d), axis)[:3, :3] for d in range(-20, 21, 4)]
        normal = min((turn @ normal for turn in turns), key=lambda n: around(mesh, place, n, place))
    return around(mesh, place, normal, place)


def scanned(tailor, surface, levels):
    """The rows of a scan."""
    given, _ = girths(tailor, surface, {"hip": 0, "half": 0.5})
    if not {"hip", "half"} <= set(given):
        return {"scan": surface.stem, "rows": []}
    hip, half = (given[n]["plane"]["point_mm"][2] for n in ("hip", "half"))
    own = {}
    for name in BY_EYE:
        if name in levels:
            at, wide = levels[name]["height_mm"], levels[name]["half_width_90_mm"]
            own |= {f"{name.lower()}_{k}": round((at + (k - 1) * wide - hip) / (2 * (half - hip)), 5) for k in range(3)}
    given, missing = girths(tailor, surface, own)
    rows = []
    for name in BY_EYE:
        if name in levels:
            tapes = [10 * given[n]["tape_cm"] if n in given else None for n in (f"{name.lower()}_{k}" for k in range(3))]
            ends = [round(t, 1) for t in tapes[::2] if t]
            if tapes[1]:
                rows.append(row(name, given, missing, round(tapes[1], 1)) | {"ends": ends})
    return {"scan": surface.stem, "rows": rows}


def main(tailor, bodies, scans, first="380", end="408"):
    """All bodies, and all scans."""
    files = [f for f in sorted(pathlib.Path(bodies).glob("**/[0-9]*.json")) if int(first) <= int(f.stem) < int(end)]
    made = []
    for file in files:
        made.append(drawn(tailor, file))
        print(made[-1]["body"], file=sys.stderr, flush=True)
    levels = json.loads(pathlib.Path(scans, "levels.json").read_text())
    seen = [scanned(tailor, file, levels.get(file.stem, {})) for file in sorted(pathlib.Path(scans).glob("*.ply"))]
    result = {**timed.made_with(tailor), "bodies": made, "scans": seen}
    print(json.dumps(result).replace('{"body"', '\n{"body"').replace('{"scan"', '\n{"scan"'))


if __name__ == "__main__":
    main(*sys.argv[1:])
