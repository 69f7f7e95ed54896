#!/usr/bin/env python3
"""Lets surfaces of people turn on the spot before a made camera and writes what `docs/lab/turning.md` shows.

    docs/tables/turning.py TAILOR WORK SIZES SURFACE... > docs/tables/turning.json

A SURFACE is a folder with one PLY file [mm], upright, standing on its soles, facing -y. SIZES are widths and heights of photos with
commas: `1080x1920,540x960`; a surface may have its own: `s26@1080x1920`. Each surface is taken at each size by
`pipelines/turning-synth.toml`: 24 photos, steps, legs that step by themselves, a body that leans, hands, head and chest that move,
rows that are read while the body turns. WORK keeps what was made; what is there is not made again.
"""

import json
import pathlib
import subprocess
import sys

import timed


def row(tailor, work, surface, size):
    """What one capture comes to: azimuths before and after the texture was asked, and girths against the surface's own. [%]"""
    width, height = size.split("x")
    out = work / f"{surface.name}-{size}"
    if not (out / "run.json").exists():
        said = [tailor, "run", "turning-synth", "score", "first_score", "girths", "true_girths", "--quiet"]
        said += ["--input", f"surface={surface}", "--cache", work / "cache", "--out", out]
        said += ["--set", f"ring.width={width}", "--set", f"ring.height={height}"]
        done = subprocess.run(said, stdout=sys.stderr, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            return {"size": size, "failed": done.stderr.strip().splitlines()[-1]}
    read = lambda name: json.loads((out / f"{name}.json").read_text())
    tapes = lambda name: {g["name"]: g for g in read(name)["girths"]}
    found, true = tapes("girths"), tapes("true_girths")
    off = {}
    for name in ("WC", "HC"):
        if name in found and name in true:
            truth = true[name]["tape_cm"]
            numbers = [found[name]["tape_cm"], *found[name]["interval_cm"]]
            off[name] = [round(100 * (cm / truth - 1), 2) for cm in numbers]
    return {
        "size": size,
        "photos": read("score")["photos"],
        "first_azimuth_deg": round(read("first_score")["azimuth_rms_deg"], 3),
        "azimuth_deg": round(read("score")["azimuth_rms_deg"], 3),
        "tape_pct": off,
    }


def main():
    tailor, work, sizes, *surfaces = sys.argv[1:]
    tailor, work = pathlib.Path(tailor).absolute(), pathlib.Path(work).absolute()
    scans = {}
    for surface in surfaces:
        surface, _, own = surface.partition("@")
        surface = pathlib.Path(surface).absolute()
        scans[surface.name] = [row(tailor, work, surface, size) for size in (own or sizes).split(",")]
    json.dump({**timed.made_with(tailor), "scans": scans}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
