"""Draws where each girth is taken, on a made body, as docs/drawings/definitions.svg.

    tailor run pipelines/surface.toml --input surface=FOLDER --out OUT      # FOLDER: one body of models/made
    python3 docs/drawings/definitions.py BODY.ply BODY.json OUT/girths.json docs/drawings/definitions.svg

BODY.json is the made body's truth: its marks are drawn as dots, with the tape that the program took in red.
"""
import json
import sys

import numpy as np
from scipy.spatial import ConvexHull
from skimage.draw import polygon
from skimage.filters import gaussian
from skimage.measure import approximate_polygon, find_contours

# Name, title, view, marks or true planes that define it, and how far the panel reaches up and down, as shares of stature.
PANELS = [
    ("NC", "NC neck: across its axis, below the larynx", "side", ["suprasternale", "larynx"], (0.79, 1.01)),
    ("CC", "CC chest: at the nipples", "side", ["nipple_l"], (0.62, 0.84)),
    ("WC_natural", "WC waist: midway between rib and hip bone", "front", ["rib", "crest"], (0.52, 0.74)),
    ("WC_narrowest", "WC_narrowest: the shortest tape", "front", [], (0.52, 0.74)),
    ("WC_navel", "WC_navel: at the navel", "side", ["navel"], (0.48, 0.70)),
    ("WC_hip_bone", "WC_hip_bone: top of the hip bone", "front", ["crest"], (0.48, 0.70)),
    ("HC", "HC hip: the buttocks' greatest prominence", "side", ["buttock"], (0.38, 0.60)),
    ("HC_max", "HC_max: the longest tape near the hip", "front", [], (0.35, 0.63)),
    ("AC_L", "AC upper arm: midway acromion to elbow", "front", ["acromion_l", "elbow_tip_l"], (0.58, 0.84)),
    ("TC_L", "TC thigh: fullest below the crotch", "front", ["crotch"], (0.34, 0.56)),
    ("CFC_L", "CFC calf: greatest, knee to ankle", "side", ["joint_knee_l", "joint_ankle_l"], (0.02, 0.30)),
]
SIZE, GAP, COLUMNS = 230, 34, 4
CELL = 2.0  # of the outline's raster [mm]


def read_ply(path):
    data = open(path, "rb").read()
    head, body = data.split(b"end_header\n", 1)
    count = {w.split()[1]: int(w.split()[2]) for w in head.decode().splitlines() if w.startswith("element")}
    v = np.frombuffer(body, "<f4", 3 * count["vertex"]).reshape(-1, 3).astype(float)
    face = np.dtype([("n", "u1"), ("i", "<i4", (3,))])
    return v, np.frombuffer(body, face, count["face"], 12 * count["vertex"])["i"]


def view(points, side):
    """Across and up, as the camera sees it: from the front (the body's left on the right) or from its left."""
    points = np.atleast_2d(points)
    return np.column_stack([points[:, 1] if side == "side" else points[:, 0], points[:, 2]])


def outlines(v, f, side):
    """Contours of the silhouette [mm]."""
    p = view(v, side)
    low = p.min(axis=0) - 5 * CELL
    grid = np.zeros(np.ceil((p.max(axis=0) - low) / CELL).astype(int) + 10, bool)
    q = (p - low) / CELL
    for a, b, c in q[f]:
        x, y = polygon([a[0], b[0], c[0]], [a[1], b[1], c[1]], grid.shape)
        grid[x, y] = True
        for corner in (a, b, c):
            grid[int(corner[0]), int(corner[1])] = True
    soft = gaussian(grid.astype(float), 1.5)
    return [approximate_polygon(c, 0.25) * CELL + low for c in find_contours(soft, 0.5) if len(c) > 40]


def tape(v, f, plane):
    """The tape: hull of the section's piece about the plane's point, in space [mm]."""
    n, at = np.array(plane["normal"]), np.array(plane["point_mm"])
    h = (v - at) @ n
    cut = f[(h[f] >= 0).any(axis=1) & ~(h[f] >= 0).all(axis=1)]
    ends, links = {}, {}
    for face in cut:
        keys = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            i, j = sorted((face[a], face[b]))
            if (h[i] >= 0) != (h[j] >= 0):
                ends[i, j] = v[i] + (v[j] - v[i]) * h[i] / (h[i] - h[j])
                keys.append((i, j))
        links.setdefault(keys[0], []).append(keys[1])
        links.setdefault(keys[1], []).append(keys[0])
    pieces, seen = [], set()
    for start in links:
        open_, piece = [start], []
        while open_:
            key = open_.pop()
            if key not in seen:
                seen.add(key)
                piece.append(ends[key])
                open_ += links[key]
        if len(piece) > 20:
            pieces.append(np.array(piece))
    piece = min(pieces, key=lambda p: np.linalg.norm(p.mean(axis=0) - at))
    u = np.cross(n, [1.0, 0.0, 0.0])
    u /= np.linalg.norm(u)
    flat = np.column_stack([(piece - at) @ u, (piece - at) @ np.cross(n, u)])
    return piece[ConvexHull(flat).vertices]


def path(points, closed=True):
    text = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
    return text + ("Z" if closed else "")


def panel(v, f, truth, girth, title, side, marks, reach, contours):
    low, high = (r * truth["stature"] for r in reach)
    middle = view(girth["plane"]["point_mm"], side)[0, 0]
    scale = SIZE / (high - low)
    place = lambda p: np.column_stack([SIZE / 2 + (p[:, 0] - middle) * scale, (high - p[:, 1]) * scale])
    out = [f'<path d="{"".join(path(place(c)) for c in contours)}" fill="#ddd" stroke="#888" stroke-width="1" fill-rule="evenodd"/>']
    for name in marks:
        if name in truth["marks"]:
            (x, y), = place(view(truth["marks"][name], side))
            out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="#125"/>')
        else:
            (_, y), = place(view(truth["planes"][name]["point"], side))
            out.append(f'<path d="M0 {y:.1f}H{SIZE}" stroke="#125" stroke-dasharray="4 4"/>')
            x = 24
        label = name.removesuffix("_l").removeprefix("joint_").replace("_", " ").replace("crest", "hip bone")
        out.append(f'<text x="{min(x + 5, SIZE - 70):.1f}" y="{y - 4:.1f}" font-size="11" fill="#125">{label}</text>')
    curve = tape(v, f, girth["plane"])
    out.append(f'<path d="{path(place(view(curve, side)))}" fill="none" stroke="#c22" stroke-width="2.5" stroke-linejoin="round"/>')
    inside = "".join(out)
    return f'<svg y="18" width="{SIZE}" height="{SIZE}" viewBox="0 0 {SIZE} {SIZE}">{inside}</svg><text y="11" font-size="11.5">{title}</text>'


def main(body, truth, girths, out):
    v, f = read_ply(body)
    truth = json.load(open(truth))
    girths = {g["name"]: g for g in json.load(open(girths))["girths"]}
    girths["WC_natural"] = girths.get("WC_natural", girths["WC"])
    contours = {side: outlines(v, f, side) for side in ("front", "side")}
    rows = -(-len(PANELS) // COLUMNS)
    wide, tall = COLUMNS * (SIZE + GAP) + GAP, rows * (SIZE + 20 + GAP) + GAP
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {tall}" font-family="sans-serif"><rect width="{wide}" height="{tall}" fill="#fff"/>']
    for k, (name, title, side, marks, reach) in enumerate(PANELS):
        x, y = GAP + k % COLUMNS * (SIZE + GAP), GAP + k // COLUMNS * (SIZE + 20 + GAP)
        inside = panel(v, f, truth, girths[name], title, side, marks, reach, contours[side])
        parts.append(f'<g transform="translate({x} {y})">{inside}</g>')
    parts.append("</svg>")
    open(out, "w").write("\n".join(parts) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
