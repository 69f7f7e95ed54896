#!/usr/bin/env python3
"""Measures one capture at many sizes and writes what `docs/performance.md` shows of how time and memory grow.

    docs/tables/growth.py TAILOR SURFACE CAPTURE WORK > docs/tables/growth.json

SURFACE is a folder with one PLY file [m]: 72 photos of one turn of it are rendered, of which every eighth, fourth, second and
each is measured. CAPTURE has 18 photos of some 24 megapixels, which are reduced. Edges of the last surface are changed on the
smallest of those. One run each, alone on the machine, with an empty cache. Captures are kept in WORK. Wants numpy and Pillow.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np
from PIL import Image

import timed

PHOTOS = [9, 18, 36, 72]
MEGAPIXELS = [1.5, 3, 6, 12, 24]
EDGES_PX = [8.0, 5.6, 4.0, 2.8]
MADE = {
    "true_body.unit": "m",
    "ring.views": max(PHOTOS),
    "ring.width": 1000,
    "ring.height": 1500,
    "ring.distance_mm": 3000.0,
    "ring.camera_mm": 1150.0,
    "ring.look_mm": 880.0,
    "taken.mat": "true",
    "photos.mat": "true",
    "photos.plate": "true",
}
REPEATS = pathlib.Path(__file__).parent / "repeats.toml"


def rendered(tailor, surface, work):
    """A capture of as many photos as are ever asked for."""
    if (work / "all").exists():
        return work / "all"
    sets = [part for key, value in MADE.items() for part in ("--set", f"{key}={value}")]
    said = ["--input", f"surface={surface}", "--cache", work / "made", *sets]
    subprocess.run([tailor, "run", REPEATS, *said, "--quiet", "photos"], check=True, stdout=sys.stderr)
    show = [tailor, "show", "photos", "--pipeline", REPEATS, *said, "--as", "capture", "-o", work / "all"]
    subprocess.run(show, check=True, stdout=sys.stderr)
    return work / "all"


def photos_of(capture):
    """Its photos in their order, the empty scene left out."""
    found = sorted((capture / "images").glob("*.*"))
    return [photo for photo in found if "plate" not in photo.name]


def every(capture, step, to):
    """A capture of every so many photos of another."""
    if to.exists():
        return to
    shutil.copytree(capture, to)
    photos = photos_of(to)
    for k, photo in enumerate(photos):
        if k % step:
            photo.unlink()
    count = len(photos_of(to))
    said = (to / "capture.toml").read_text()
    said = re.sub(r"(?m)^views = .*$", f"views = {count}", said)
    (to / "capture.toml").write_text(re.sub(r"(?m)^step_deg = .*$", f"step_deg = {360 / count}", said))
    return to


def reduced(capture, megapixels, to):
    """A capture with its photos at another size; EXIF data is kept."""
    if to.exists():
        return to
    shutil.copytree(capture, to, ignore=shutil.ignore_patterns("truth"))
    for photo in (to / "images").iterdir():
        with Image.open(photo) as image:
            share = min(1.0, (megapixels * 1e6 / (image.width * image.height)) ** 0.5)
            size = [max(1, round(side * share)) for side in image.size]
            image.resize(size, Image.LANCZOS).save(photo, quality=92, exif=image.info.get("exif", b""))
    return to


def measured(tailor, capture, work, *flags):
    """One run: seconds by the clock and of the processor, peak memory, and faces of the surface."""
    out, cache = work / "out", work / "cache"
    cost = timed.measured(tailor, capture, out, cache, *flags)
    head = (out / "body.ply").read_bytes()[:4000].decode("latin-1")
    row = {**cost, "faces": int(re.search(r"element face (\d+)", head)[1])}
    shutil.rmtree(out)
    shutil.rmtree(cache)
    print(capture.name, flags, row, file=sys.stderr)
    return row


def exponent(rows, over, what):
    """The slope of a line through the logarithms."""
    x, y = ([np.log(row[key]) for row in rows] for key in (over, what))
    return round(float(np.polyfit(x, y, 1)[0]), 2)


def main(tailor, surface, big, work):
    """All sizes."""
    tailor, big, work = str(pathlib.Path(tailor).resolve()), pathlib.Path(big), pathlib.Path(work)
    work.mkdir(exist_ok=True)
    made = rendered(tailor, surface, work)
    turns = {count: every(made, max(PHOTOS) // count, work / f"{count} photos") for count in PHOTOS}
    sizes = {mpx: reduced(big, mpx, work / f"{mpx} megapixels") for mpx in MEGAPIXELS}
    small = sizes[MEGAPIXELS[0]]
    edges = {edge: ["--set", f"body.edge_px={edge}"] for edge in EDGES_PX}
    rows = {
        "photos": [{"photos": n, **measured(tailor, capture, work)} for n, capture in turns.items()],
        "megapixels": [{"megapixels": n, **measured(tailor, capture, work)} for n, capture in sizes.items()],
        "faces": [{"edge_px": n, **measured(tailor, small, work, *flags)} for n, flags in edges.items()],
    }
    result = {
        **timed.made_with(tailor),
        "rows": rows,
        "exponents": {
            over: {what: exponent(of, over, what) for what in ("processor_s", "peak_gb")} for over, of in rows.items()
        },
    }
    json.dump(result, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
