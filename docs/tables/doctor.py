#!/usr/bin/env python3
"""Spoils photos of captures, one fault at a time, and counts what `tailor doctor` finds; of order and gaps, what cameras do.

    docs/tables/doctor.py TAILOR WORK CAPTURE... > docs/tables/doctor.json

A CAPTURE has photos in turning order without faults, and may have a plate. Which photo is spoilt is drawn by a seed. `named`: the
finding that the fault asks for, of no other photos than it asks for; `found`: that finding, of whatever photos; `findings`: all that
the untouched capture has not. Wants numpy and Pillow.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np
from PIL import Image, ImageFilter

GAMMA = 2.2


def light(change):
    """A change of light, of what files hold."""
    def of(picture):
        linear = (np.asarray(picture, float) / 255) ** GAMMA
        return Image.fromarray(np.uint8(np.clip(change(linear), 0, 1) ** (1 / GAMMA) * 255 + 0.5))
    return of


def shaken(picture, length):
    """Blurred along a row, as by a camera that was knocked."""
    pixels = np.asarray(picture, float)
    parts = [np.roll(pixels, k - length // 2, axis=1) for k in range(length)]
    return Image.fromarray(np.uint8(np.mean(parts, axis=0) + 0.5))


def noisy(picture, levels, draw):
    pixels = np.asarray(picture, float)
    return Image.fromarray(np.uint8(np.clip(pixels + levels * draw.normal(size=pixels.shape), 0, 255) + 0.5))


def moved(picture, px, draw):
    """Taken by a hand: shifted by some pixels, the border cut off."""
    x, y = (int(v) for v in draw.integers(0, px + 1, 2))
    return picture.crop((x, y, picture.width - px + x, picture.height - px + y))


def spoilt(fault, much, photos, plate, draw):
    """The photos as they are to be written, as (new name, picture) in order, and names that are to be found."""
    pictures = [(p.name, Image.open(p).convert("RGB")) for p in photos]
    at = int(draw.integers(2, len(pictures) - 3))
    name, picture = pictures[at]
    change = {
        "defocus, px": lambda p: p.filter(ImageFilter.GaussianBlur(much)),
        "shaken, px": lambda p: shaken(p, much),
        "exposure of one, EV": light(lambda v: v * 2.0**much),
    }
    every = {
        "noise of all, levels": lambda p: noisy(p, much, draw),
        "camera in a hand, px": lambda p: moved(p, much, draw),
        "cut off below": lambda p: p.crop((0, 0, p.width, round(p.height * (1 - much)))),
        "cut off above": lambda p: p.crop((0, round(p.height * much), p.width, p.height)),
    }
    if fault in change:
        pictures[at] = (name, change[fault](picture))
        return pictures, {name}
    if fault in every:
        return [(n, every[fault](p)) for n, p in pictures], set()
    if fault == "two exchanged, places apart":
        to = (at + much) % len(pictures)
        pictures[at], pictures[to] = (name, pictures[to][1]), (pictures[to][0], picture)
        return pictures, {name, pictures[to][0]}
    if fault == "shuffled":
        order = draw.permutation(len(pictures))
        return [(n, pictures[k][1]) for (n, _), k in zip(pictures, order)], set()
    if fault == "taken twice":
        pictures[at + 1] = (pictures[at + 1][0], noisy(picture, 1, draw))
        return pictures, {name}
    if fault == "left out":
        return pictures[: at + 1] + pictures[at + 1 + much :], {name}
    if fault == "nobody there":
        pictures[at] = (name, noisy(Image.open(plate).convert("RGB"), 1, draw))
        return pictures, {name}
    return pictures, set()


FAULTS = {
    "nothing": ([0], []),
    "defocus, px": ([0.7, 1, 1.5, 2.5], ["find-blurred"]),
    "shaken, px": ([3, 6, 12], ["find-blurred"]),
    "exposure of one, EV": ([-0.5, -0.35, -0.2, 0.2, 0.35, 0.5], ["find-uneven"]),
    "noise of all, levels": ([3, 6, 12, 24], ["find-noise"]),
    "camera in a hand, px": ([8, 30, 120], ["find-moved"]),
    "cut off below": ([0.1, 0.2, 0.3], ["find-feet", "warn-cut-lower"]),
    "cut off above": ([0.05, 0.1, 0.2], ["find-head", "warn-cut-upper"]),
    "two exchanged, places apart": ([1, 2, 4, 7], ["fail-misplaced"]),
    "shuffled": ([0], ["find-shuffled"]),
    "taken twice": ([0], ["warn-shows-same"]),
    "left out": ([1, 2, 3], ["warn-large-step"]),
    "nobody there": ([0], ["find-empty"]),
}


def findings(tailor, _, folder):
    """Codes of what is odd, each with its photos."""
    found = subprocess.run([tailor, "doctor", folder, "--json"], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    found = json.loads(found.stdout)
    # What is refused at once is a finding, too.
    odd = {f["what"]["code"]: set(f["photos"]) for f in found.get("findings", [])} | {w["code"]: set() for w in found.get("warnings", [])}
    return odd | ({found["error"][:60]: set()} if "error" in found else {})


def in_cameras(tailor, work, folder):
    """What the way to cameras without a mat reports of a turn, by its codes."""
    run = [tailor, "run", "body", "--variant", "first", "--input", f"photos={folder}", "--cache", work / "cache", "calibrated", "--json"]
    found = json.loads(subprocess.run(run, stdin=subprocess.DEVNULL, capture_output=True, text=True).stdout)
    moved = re.search(r"out of turning order \((.*?)\)", found.get("error", ""))
    if moved:
        return {"fail-misplaced": set(moved[1].split(", "))}
    if "error" in found:
        return {found["error"][:60]: set()}
    warnings = [w for node in found["nodes"] for w in node["warnings"]]
    names = lambda w: {w["fields"][k] for k in ("before",) if k in w["fields"]}
    return {w["code"]: names(w) for w in warnings if w["code"] in ("warn-shows-same", "warn-large-step")}


def outcome(tailor, work, capture, fault, much, seed):
    """What is found of one fault, its capture made and removed again."""
    draw = np.random.default_rng(seed)
    folder = work / "spoilt"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(capture, folder, ignore=shutil.ignore_patterns("truth"))
    photos = sorted(p for p in (folder / "images").iterdir() if "plate" not in p.name)
    plate = next(folder.rglob("*plate*.*"), None)
    if fault == "nobody there" and plate is None:
        return None
    pictures, wanted = spoilt(fault, much, photos, plate, draw)
    for photo in photos:
        photo.unlink()
    # Neither a count nor an empty scene that others would be compared with.
    known = (folder / "capture.toml").read_text().splitlines()
    (folder / "capture.toml").write_text("\n".join(l for l in known if not l.startswith(("plate", "views"))) + "\n")
    if plate:
        plate.unlink()
    for name, picture in pictures:
        picture.save((folder / "images" / name).with_suffix(".jpg"), quality=95)
    look = in_cameras if fault in ("two exchanged, places apart", "taken twice", "left out") else findings
    return look(tailor, work, folder), {pathlib.Path(n).with_suffix(".jpg").name for n in wanted}


def main():
    tailor, work = sys.argv[1], pathlib.Path(sys.argv[2])
    rows = []
    for at, capture in enumerate(map(pathlib.Path, sys.argv[3:])):
        usual = {}
        for fault, (sizes, codes) in FAULTS.items():
            for much in sizes:
                came = outcome(tailor, work, capture, fault, much, at)
                if came is None:
                    continue
                found, wanted = came
                if fault == "nothing":
                    usual = found
                # A photo that was odd before is no news.
                new = {c: photos - usual.get(c, set()) for c, photos in found.items() if c not in usual or photos - usual[c]}
                hit = [c for c in codes if c in new]
                rows.append({
                    "capture": capture.name, "fault": fault, "much": much, "wanted": sorted(wanted),
                    "found": bool(hit), "named": any(new[c] <= wanted and bool(new[c]) == bool(wanted) for c in hit),
                    "findings": {c: sorted(p) for c, p in sorted((found if fault == "nothing" else new).items())},
                })
                print(json.dumps(rows[-1]), file=sys.stderr, flush=True)
    json.dump(rows, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
