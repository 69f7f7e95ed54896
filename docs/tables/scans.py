#!/usr/bin/env python3
"""Takes surfaces of people through a modelled phone and writes what `docs/lab/phone.md` shows of masks, tapes and sizes.

    docs/tables/scans.py TAILOR WORK CASES SURFACE... > docs/tables/scans.json

A SURFACE is a folder with one PLY file [mm], upright, standing on its soles. CASES are of `bare`, `plate`, `mat` and `mat+plate`, with
commas: whether a mat lies on the disk, and whether somebody took a plate. Each surface is taken in each case: 18 photos of 1350x1800
with all faults of a phone at once (repeats.toml), then measured. Masks are held against the true ones (which no stabiliser shifts),
tapes against the true surface at the same planes, ours laid on it, without a mat at a free size. WORK keeps what was made; what is
there is not made again. Wants numpy, scipy, trimesh and Pillow.
"""

import json
import pathlib
import subprocess
import sys

import faults
import numpy as np
import timed
import trimesh
from PIL import Image

PIPELINE = pathlib.Path(__file__).with_name("repeats.toml")
TAKEN = {"ring.width": 1350, "ring.height": 1800, "ring.distance_mm": 3000.0, "ring.camera_mm": 1150.0, "ring.look_mm": 880.0}
TAKEN |= {"ring.seed": 1, "sway.seed": 1, "sway.sway_mm": 3.0, "taken.contrast": 0.2, "taken.finest_mm": 3.0, "taken.seed": 1}
PHONE = {"exposure_ev": 0.15, "white": 0.04, "over_ev": 0.1, "shift_px": 0.6, "vignetting": 0.38, "blur_px": 1.05, "shaken": 2}
PHONE |= {"shake_px": 4.0, "lateral_px": 0.5, "noise_levels": 2.0, "denoise_levels": 8.0, "sharpen": 0.6, "jpeg_quality": 84, "seed": 1}
CASES = {"bare": (False, False), "plate": (False, True), "mat": (True, False), "mat+plate": (True, True)}
SHOWN = [*faults.SHOWN, "WC_hip_bone", "NC", "TC_L", "TC_R", "CFC_L", "CFC_R"]


def flags(values):
    """Params as the command line takes them."""
    return [word for key, value in values.items() for word in ("--set", f"{key}={str(value).lower()}")]


def taken(tailor, work, surface, mat, plate):
    """A capture and its true masks, made if they are not there."""
    said = ["--input", f"surface={surface}", "--cache", work / "cache", "--quiet"]
    told = {"taken.mat": mat, "photos.plate": plate, "photos.mat": mat} | {f"photos.{k}": v for k, v in PHONE.items()}
    name = f"{surface.name}-{'mat' if mat else 'bare'}-{'plate' if plate else 'none'}"
    for node, how, out, more in [("photos", "capture", work / name, told), ("true_masks", "png", work / f"{surface.name}-masks", {})]:
        if not out.exists():
            all_said = [*said, *flags(TAKEN | more)]
            subprocess.run([tailor, "run", PIPELINE, *all_said, node], check=True, stdout=sys.stderr)
            show = [tailor, "show", node, "--pipeline", PIPELINE, *all_said, "--as", how, "-o", out]
            subprocess.run(show, check=True, stdout=sys.stderr)
    return work / name, work / f"{surface.name}-masks"


def masks(found, true):
    """How masks lie on the true ones: overlap, and what of the body is lost and what else is kept, as shares of it. [%]"""
    rows = []
    for path in sorted(true.glob("*.png")):
        a, b = (np.array(Image.open(folder / path.name).convert("L")) > 127 for folder in (found, true))
        rows.append([(a & b).sum() / (a | b).sum(), 100 * (b & ~a).sum() / b.sum(), 100 * (a & ~b).sum() / b.sum()])
    mean, least = np.mean(rows, 0), np.min(rows, 0)
    return {"iou": round(mean[0], 4), "least_iou": round(least[0], 4), "lost_pct": round(mean[1], 2), "kept_pct": round(mean[2], 2)}


def trunk_mm(body, true, free_scale):
    """The mean distance of our trunk, laid on the true surface, from it: between half and 78 % of the height. [mm]"""
    ours = trimesh.load(body, process=False)
    points = np.asarray(ours.vertices)
    size, turn, move = faults.laid_on(points[:: max(1, len(points) // 8000)], true, free_scale)
    points = size * points @ turn.T + move
    share = points[:, 2] / true.bounds[1][2]
    trunk = points[(share > 0.5) & (share < 0.78)]
    _, far, _ = trimesh.proximity.ProximityQuery(true).on_surface(trunk[:: max(1, len(trunk) // 1500)])
    return round(float(far.mean()), 2)


def measured(tailor, work, surface, mat, plate):
    """One capture's row."""
    capture, true_masks = taken(tailor, work, surface, mat, plate)
    out = work / "out" / capture.name
    if not (out / "girths.json").exists():
        done = subprocess.run([tailor, "measure", capture, "--out", out, "--cache", work / "cache", "--quiet"], capture_output=True, text=True)
        if done.returncode:
            return {"failed": done.stderr.strip()}
    true = trimesh.load(next(surface.glob("*.ply")), process=False)
    told = json.loads((out / "girths.json").read_text())
    tapes, size = faults.shares(told["girths"], out / "body.ply", true, not mat, SHOWN)
    row = {"masks": masks(out / "masks", true_masks), "tape_pct": tapes, "trunk_mm": trunk_mm(out / "body.ply", true, not mat)}
    row["missing"] = {m["name"]: m["reason"] for m in told["missing"]}
    return row if mat else row | {"size_pct": size}


def main(tailor, work, cases, *surfaces):
    """All surfaces in the cases."""
    work = pathlib.Path(work).resolve()
    rows = {}
    for surface in map(pathlib.Path, surfaces):
        for mat, plate in (CASES[case] for case in cases.split(",")):
            row = measured(tailor, work, surface, mat, plate)
            rows.setdefault(surface.name, []).append({"mat": mat, "plate": plate} | row)
            print(surface.name, mat, plate, row, file=sys.stderr, flush=True)
    json.dump({**timed.made_with(tailor), "scans": rows}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
