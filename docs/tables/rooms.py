#!/usr/bin/env python3
"""Takes surfaces of people in rooms, clothes, skin, light and on disks drawn by a seed, and writes how masks and girths come out.

    docs/tables/rooms.py TAILOR WORK FIRST LAST SURFACE... > docs/tables/rooms.json

A SURFACE is a folder with one PLY file [mm], upright, standing on its soles. Scene number N (`synth.turn`, param `scene`) is worn and
seen by surface N modulo their count; no mat lies on the disk, for its tags are too small on such photos. Each scene is taken as in
scans.py, 18 photos of 900x1200 with all faults of a phone at once, then measured with its plate and without. Masks are compared with
the true ones where the stabiliser moved them, girths with the true surface's at the same planes, ours laid on it at a free size.
`deep_lost_pct` and `far_kept_pct` are of what lies more than two pixels within or beyond the true outline, as shares of the body. WORK
keeps what was made; what is there is not made again. In one of three scenes clothes have the colour of the wall or of the floor.
Wants numpy, scipy, trimesh and Pillow.
"""

import json
import pathlib
import shutil
import subprocess
import sys

import faults
import numpy as np
import scans
import timed
import trimesh
from PIL import Image
from scipy.ndimage import distance_transform_edt

SIZE = {"ring.width": 900, "ring.height": 1200}


def captures(tailor, work, scene, surface):
    """The scene's capture with its plate, the same without, and its true masks, moved as the photos are."""
    name = f"scene-{scene:03}"
    plated, bare, true = (work / f"{name}{end}" for end in ("-plate", "-none", "-moved"))
    given = ["--input", f"surface={surface}", "--cache", work / "cache", "--quiet"]
    look = {"taken.scene": scene, "taken.mat": False, "photos.plate": True, "photos.mat": False, "ring.seed": scene, "sway.seed": scene}
    values = scans.TAKEN | SIZE | {f"photos.{k}": v for k, v in scans.PHONE.items()} | look | {"photos.seed": scene}
    values |= {"moved_masks.seed": scene, "moved_masks.shift_px": scans.PHONE["shift_px"]}
    for node, how, out in [("photos", "capture", plated), ("moved_masks", "png", true)]:
        if not out.exists():
            subprocess.run([tailor, "run", scans.PIPELINE, *given, *scans.flags(values), node], check=True, stdout=sys.stderr)
            show = [tailor, "show", node, "--pipeline", scans.PIPELINE, *given, *scans.flags(values), "--as", how, "-o", out]
            subprocess.run(show, check=True, stdout=sys.stderr)
    if not bare.exists():
        shutil.copytree(plated, bare)
        next(bare.rglob("plate.*")).unlink()
        toml = bare / "capture.toml"
        toml.write_text("".join(line for line in toml.open() if not line.startswith("plate")))
    return plated, bare, true


def beyond_two_px(found, true):
    """What is lost within the true outline and kept beyond it, each by more than two pixels, as shares of the body. [%]"""
    rows = []
    for path in sorted(true.glob("*.png")):
        a, b = (np.array(Image.open(folder / path.name).convert("L")) > 127 for folder in (found, true))
        deep, far = distance_transform_edt(b) > 2, distance_transform_edt(~b) > 2
        rows.append([100 * (b & ~a & deep).sum() / b.sum(), 100 * (a & ~b & far).sum() / b.sum()])
    lost, kept = np.mean(rows, 0)
    return {"deep_lost_pct": round(lost, 2), "far_kept_pct": round(kept, 2)}


def measured(tailor, work, capture, true, surface):
    """How one capture's masks and girths come out."""
    out = work / "out" / capture.name
    if not (out / "masks").exists():
        run = [tailor, "measure", capture, "--cache", work / "cache", "--out", out, "--quiet"]
        done = subprocess.run(run, capture_output=True, text=True)
        if not (out / "masks").exists():
            return {"failed": done.stderr.strip()}
    # A photo that found no camera has no mask, and counts as none.
    for path in true.glob("*.png"):
        if not (out / "masks" / path.name).exists():
            Image.new("L", Image.open(path).size).save(out / "masks" / path.name)
    found = scans.masks(out / "masks", true) | beyond_two_px(out / "masks", true)
    row = {name: float(value) for name, value in found.items()}
    if not (out / "girths.json").exists():
        return row
    of = json.loads((out / "girths.json").read_text())
    body = trimesh.load(next(surface.glob("*.ply")), process=False)
    row["tape_pct"], row["size_pct"] = faults.shares(of["girths"], out / "body.ply", body, True, scans.SHOWN)
    return row | {"missing": {m["name"]: m["reason"] for m in of["missing"]}}


def main(tailor, work, first, last, *surfaces):
    """All scenes from the first to the last."""
    work = pathlib.Path(work).resolve()
    rows = {}
    for scene in range(int(first), int(last) + 1):
        surface = pathlib.Path(surfaces[scene % len(surfaces)])
        plated, bare, true = captures(tailor, work, scene, surface)
        row = {"surface": surface.name}
        row |= {kind: measured(tailor, work, capture, true, surface) for kind, capture in [("plate", plated), ("none", bare)]}
        rows[scene] = row
        print(scene, rows[scene], file=sys.stderr, flush=True)
    json.dump({**timed.made_with(tailor), "rooms": rows}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
