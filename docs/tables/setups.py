#!/usr/bin/env python3
"""Takes surfaces of people in rooms by set-ups drawn by a seed, and writes how cameras, the disk's size, masks and girths come out.

    docs/tables/setups.py TAILOR WORK FIRST LAST LIGHT SURFACE... > WORK/setups.json

As rooms.py, but the lens, its distance and height, what it looks at, its distortion (up to 1 % at the corners) and what EXIF says of
it, the number of photos, the way and the evenness of the turn, the disk's size and the sway are drawn by the scene's number, too; the
body fills 70 to 85 % of the photo's height. `edge_share` is how much of the disk's edge is on the photos, `away_pct` how much too far
the camera is by the disk's diameter, before there are masks (a focal length that EXIF has wrong makes it so, too, and no girth);
`focal_pct`, `row_px`, `pitch_deg` and `k1` are how far the lens and the camera's pitch are off. LIGHT is `even`, which throws no
shadow, or `lamp` (on either side, up to 15 degrees wide) or `flash` (near the camera, low, up to 6 degrees wide), drawn by the
scene's number, too, or `toned`: even, but the phone takes back a quarter to a half of what surroundings differ by, photo by photo.
Wants numpy, scipy, trimesh and Pillow.
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


def light(kind, scene):
    """Params of the light and of what the phone makes of it; a lamp's face is even in its logarithm."""
    if kind == "even":
        return {}
    if kind == "toned":
        return {"photos.local_tone": 0.5}
    seed, widest, aside, low, high = {"lamp": (8000, 15, 120, 20, 70), "flash": (9000, 6, 25, 5, 40)}[kind]
    draw = np.random.default_rng(seed + scene)
    width = round(float(np.exp(draw.uniform(0, np.log(widest)))), 1)
    right, up = round(draw.uniform(-aside, aside), 0), round(draw.uniform(low, high), 0)
    return {"taken.lamp_deg": width, "taken.lamp_right_deg": right, "taken.lamp_up_deg": up}


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


def cameras(tailor, work, capture, of):
    """How far off the cameras are; none where there are none, no distance where the disk's edge was not found."""
    given = ["--input", f"photos={capture}", "--cache", work / "cache"]
    run = subprocess.run([tailor, "run", "body", *given, "--out", work / "placed", "--quiet", "placed"], stdout=sys.stderr)
    if run.returncode:
        return {}
    show = [tailor, "show", "placed", "--pipeline", "body", *given, "--as", "json", "-o", "-"]
    placed = json.loads(subprocess.run(show, check=True, capture_output=True, text=True).stdout)
    first = placed["views"][0]
    focal_px = of["ring.focal_35mm"] / FILM_MM * ACROSS_PX
    pitch = np.arctan2(of["ring.camera_mm"] - of["ring.look_mm"], of["ring.distance_mm"])
    row = {
        "focal_pct": round(100 * (first["K"][0][0] / focal_px - 1), 2),
        "row_px": round(first["K"][1][2] - (HEIGHT - 1) / 2 - of["ring.off_centre"] * HEIGHT, 1),
        "pitch_deg": round(float(np.degrees(np.arcsin(-first["R"][2][2]) - pitch)), 2),
        "k1": round(first["distortion"][0] - of["ring.k1"], 4),
    }
    if placed["scale"] == "disk":
        centres = [-np.array(view["R"]).T @ view["t"] for view in placed["views"]]
        away_mm = float(np.mean([np.hypot(*centre[:2]) for centre in centres]))
        row["away_pct"] = round(100 * (away_mm / of["ring.distance_mm"] - 1), 2)
    return row


def main(tailor, work, first, last, kind, *surfaces):
    """All scenes from the first to the last."""
    work = pathlib.Path(work).resolve()
    size, rows = dict(rooms.SIZE), {}
    for scene in range(int(first), int(last) + 1):
        surface, of = pathlib.Path(surfaces[scene % len(surfaces)]), setup(scene) | light(kind, scene)
        rooms.SIZE = size | of
        plated, bare, true = rooms.captures(tailor, work, scene, surface)
        row = {"surface": surface.name, "edge_share": edge_share(of)} | of
        for case, capture in [("plate", plated), ("none", bare)]:
            row[case] = cameras(tailor, work, capture, of)
            row[case] |= rooms.measured(tailor, work, capture, true, surface)
        rows[scene] = row
        print(scene, row, file=sys.stderr, flush=True)
    json.dump({**timed.made_with(tailor), "setups": rows}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
