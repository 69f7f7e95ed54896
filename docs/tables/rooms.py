#!/usr/bin/env python3
"""Takes surfaces of people in rooms, clothes, skin, light and on disks drawn by a seed, and writes how the masks lie.

    docs/tables/rooms.py TAILOR WORK FIRST LAST SURFACE... > docs/tables/rooms.json

A SURFACE is a folder with one PLY file [mm], upright, standing on its soles. Scene number N (`synth.turn`, param `scene`) is worn and
seen by surface N modulo their count; no mat lies on the disk, for its tags are too small on such photos. Each scene is taken as in
scans.py, 18 photos of 900x1200 with all faults of a phone at once, then cut out with its plate and without. WORK keeps what was made;
what is there is not made again, but masks of another TAILOR. In one of three scenes clothes have the colour of the wall or of the floor. Wants numpy and Pillow.
"""

import json
import pathlib
import shutil
import subprocess
import sys

import scans
import timed
from PIL import Image

SIZE = {"ring.width": 900, "ring.height": 1200}


def captures(tailor, work, scene, surface):
    """The scene's capture with its plate, the same without, and its true masks."""
    name = f"scene-{scene:03}"
    plated, bare, true = (work / f"{name}{end}" for end in ("-plate", "-none", "-masks"))
    given = ["--input", f"surface={surface}", "--cache", work / "cache", "--quiet"]
    look = {"taken.scene": scene, "taken.mat": False, "photos.plate": True, "photos.mat": False, "ring.seed": scene, "sway.seed": scene}
    values = scans.TAKEN | SIZE | {f"photos.{k}": v for k, v in scans.PHONE.items()} | look | {"photos.seed": scene}
    for node, how, out in [("photos", "capture", plated), ("true_masks", "png", true)]:
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


def cut(tailor, work, capture, true):
    """How one capture's masks lie."""
    out = work / "out" / capture.name
    run = [tailor, "run", "body", "--input", f"photos={capture}", "--cache", work / "cache", "--out", out, "--quiet", "masks"]
    done = subprocess.run(run, capture_output=True, text=True)
    if done.returncode:
        return {"failed": done.stderr.strip()}
    # A photo that found no camera has no mask, and counts as none.
    for path in true.glob("*.png"):
        if not (out / "masks" / path.name).exists():
            Image.new("L", Image.open(path).size).save(out / "masks" / path.name)
    return {name: float(value) for name, value in scans.masks(out / "masks", true).items()}


def main(tailor, work, first, last, *surfaces):
    """All scenes from the first to the last."""
    work = pathlib.Path(work).resolve()
    rows = {}
    for scene in range(int(first), int(last) + 1):
        surface = pathlib.Path(surfaces[scene % len(surfaces)])
        plated, bare, true = captures(tailor, work, scene, surface)
        rows[scene] = {"surface": surface.name, "plate": cut(tailor, work, plated, true), "none": cut(tailor, work, bare, true)}
        print(scene, rows[scene], file=sys.stderr, flush=True)
    json.dump({**timed.made_with(tailor), "rooms": rows}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
