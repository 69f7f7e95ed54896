#!/usr/bin/env python3
"""Takes surfaces of people in rooms by set-ups drawn by a seed, and writes how the disk's size, masks and girths come out.

    docs/tables/setups.py TAILOR WORK FIRST LAST SURFACE... > WORK/setups.json

As rooms.py, but the lens, its distance and height, what it looks at, its distortion (up to 1 % at the corners) and what EXIF says of
it, the number of photos, the way and the evenness of the turn, the disk's size and the sway are drawn by the scene's number, too; the
body fills 70 to 85 % of the photo's height. `edge_share` is how much of the disk's edge is on the photos, `away_pct` how much too far
the camera is by the disk's diameter, before there are masks (a focal length that EXIF has wrong makes it so, too, and no girth). Wants numpy, scipy, trimesh and Pillow.
"""

import json
import pathlib
import subprocess
import sys

import numpy as np
import rooms
import timed

STATURE_MM = 1750.0
WIDTH, HEIGHT = rooms.SIZE["ring.width"], rooms.SIZE["ring.height"]
# The longer way across the film that focal lengths are given for, and across the photo.
FILM_MM, ACROSS_PX = 43.267, float(np.hypot(WIDTH, HEIGHT))


def setup(scene):
    """Params of the camera, the disk and the turn."""
    draw = np.random.default_rng(7000 + scene)
    focal_mm = float(draw.choice([24, 26, 28, 35, 50, 65]))
    focal_px = focal_mm / FILM_MM * ACROSS_PX
    params = {"ring.focal_35mm": focal_mm}
    params["ring.distance_mm"] = round(focal_px * STATURE_MM / (draw.uniform(0.7, 0.85) * HEIGHT), 0)
    params["ring.camera_mm"] = round(draw.uniform(700, 1600), 0)
    params["ring.look_mm"] = round(draw.uniform(860, 920), 0)
    params["ring.views"] = int(draw.choice([12, 16, 18, 24, 36]))
    # No hand turns a disk back.
    params["ring.jitter_deg"] = min(float(draw.choice([0.1, 0.5, 2.0, 4.0])), 36.0 / params["ring.views"])
    params["ring.off_centre"] = round(draw.uniform(-0.008, 0.008), 4)
    params["ring.k1"] = round(float(draw.uniform(-0.01, 0.01)) * (2 * focal_px / ACROSS_PX) ** 2, 4)
    params["ring.clockwise"] = bool(draw.integers(2))
    params["ring.disk_mm"] = round(draw.uniform(230, 500), 0)
    params["sway.sway_mm"] = round(draw.uniform(0, 10), 1)
    params["taken.exif_error"] = round(draw.uniform(-0.03, 0.03), 3)
    return params


def edge_share(of):
    """How much of the disk's edge is on the photos."""
    radius, away, high = (of[f"ring.{name}_mm"] for name in ("disk", "distance", "camera"))
    pitch = np.arctan2(high - of["ring.look_mm"], away)
    turn = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    ahead, right = away - radius * np.cos(turn), radius * np.sin(turn)
    deep, down = ahead * np.cos(pitch) + high * np.sin(pitch), high * np.cos(pitch) - ahead * np.sin(pitch)
    focal_px = of["ring.focal_35mm"] / FILM_MM * ACROSS_PX
    seen = (np.abs(focal_px * right / deep) < WIDTH / 2) & (np.abs(focal_px * down / deep) < HEIGHT / 2)
    return round(float(seen.mean()), 2)


def away_pct(tailor, work, capture, away_mm):
    """How much farther the camera is by the disk's diameter; none where its edge was not found."""
    given = ["--input", f"photos={capture}", "--cache", work / "cache"]
    run = subprocess.run([tailor, "run", "body", *given, "--out", work / "placed", "--quiet", "placed"], stdout=sys.stderr)
    if run.returncode:
        return None
    show = [tailor, "show", "placed", "--pipeline", "body", *given, "--as", "json", "-o", "-"]
    placed = json.loads(subprocess.run(show, check=True, capture_output=True, text=True).stdout)
    if placed["scale"] != "disk":
        return None
    centres = [-np.array(view["R"]).T @ view["t"] for view in placed["views"]]
    return round(100 * (float(np.mean([np.hypot(*centre[:2]) for centre in centres])) / away_mm - 1), 2)


def main(tailor, work, first, last, *surfaces):
    """All scenes from the first to the last."""
    work = pathlib.Path(work).resolve()
    size, rows = dict(rooms.SIZE), {}
    for scene in range(int(first), int(last) + 1):
        surface, of = pathlib.Path(surfaces[scene % len(surfaces)]), setup(scene)
        rooms.SIZE = size | of
        plated, bare, true = rooms.captures(tailor, work, scene, surface)
        row = {"surface": surface.name, "edge_share": edge_share(of)} | of
        for kind, capture in [("plate", plated), ("none", bare)]:
            row[kind] = {"away_pct": away_pct(tailor, work, capture, of["ring.distance_mm"])}
            row[kind] |= rooms.measured(tailor, work, capture, true, surface)
        rows[scene] = row
        print(scene, row, file=sys.stderr, flush=True)
    json.dump({**timed.made_with(tailor), "setups": rows}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
