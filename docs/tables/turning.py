#!/usr/bin/env python3
"""Lets surfaces of people turn on the spot before a made camera and writes what `docs/lab/turning.md` shows.

    docs/tables/turning.py TAILOR WORK SIZES SURFACE... > docs/tables/turning.json

A SURFACE is a folder with one PLY file [mm], upright, standing on its soles, facing -y. SIZES are widths and heights of photos with
commas: `1080x1920,540x960`; a surface may have its own: `s26@1080x1920`. Each surface is taken at each size by
`pipelines/turning-synth.toml`: 24 photos, steps, legs that step by themselves, a body that leans, hands, head and chest that move,
rows that are read while the body turns. With `film:` before a size it is a film of 30 frames a second (variant `film`), compressed
by ffmpeg and measured as a film. WORK keeps what was made; what is there is not made again.
"""

import json
import math
import pathlib
import re
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
    return {
        "size": size,
        "photos": read("score")["photos"],
        "first_azimuth_deg": round(read("first_score")["azimuth_rms_deg"], 3),
        "azimuth_deg": round(read("score")["azimuth_rms_deg"], 3),
        "tape_pct": tapes(read("girths"), read("true_girths")),
    }


def film(tailor, work, surface, size):
    """The same of a film."""
    width, height = size.split("x")
    out = work / f"{surface.name}-film-{size}"
    frames, measured = out / "frames", out / "measured"
    if not (measured / "run.json").exists():
        said = [tailor, "run", "turning-synth", "photos", "truth", "true_girths", "--variant", "film", "--quiet"]
        said += ["--input", f"surface={surface}", "--cache", work / "cache", "--out", frames]
        subprocess.run(said + ["--set", f"ring.width={width}", "--set", f"ring.height={height}"], stdout=sys.stderr, check=True)
        said = ["ffmpeg", "-loglevel", "error", "-y", "-framerate", "30", "-i", frames / "photos/images/%04d.jpg"]
        subprocess.run(said + ["-c:v", "libx264", "-pix_fmt", "yuv420p", out / "turn.mp4"], check=True)
        stature = re.search(r"height_cm = ([0-9.]+)", (frames / "photos/capture.toml").read_text())[1]
        said = [tailor, "measure", out / "turn.mp4", "--turning", "--stature", f"{float(stature):.1f}", "--focal", "27", "--quiet"]
        done = subprocess.run([*said, "--cache", work / "cache", "--out", measured], stdout=sys.stderr, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            return {"size": f"film {size}", "failed": done.stderr.strip().splitlines()[-1]}
    read = lambda path: json.loads(path.read_text())
    number = lambda view: int(re.search(r"(\d+)\.\w+$", view["image"])[1])
    true = {number(view): view["R"] for view in read(frames / "truth.json")["views"]}
    turns = []
    for view in read(measured / "cameras.json")["views"]:
        found, truth = view["R"], true[number(view)]
        by = lambda i, j: sum(found[k][i] * truth[k][j] for k in range(3))
        turns.append(math.atan2(by(1, 0) - by(0, 1), by(0, 0) + by(1, 1)))
    mean = math.atan2(sum(map(math.sin, turns)), sum(map(math.cos, turns)))
    off = [math.degrees(math.remainder(turn - mean, math.tau)) for turn in turns]
    return {
        "size": f"film {size}",
        "photos": len(off),
        "azimuth_deg": round(math.sqrt(sum(o * o for o in off) / len(off)), 3),
        "tape_pct": tapes(read(measured / "girths.json"), read(frames / "true_girths.json")),
    }


def tapes(found, true):
    """Waist and hip and their intervals' ends against the surface's own. [%]"""
    found, true = ({g["name"]: g for g in girths["girths"]} for girths in (found, true))
    off = {}
    for name in ("WC", "HC"):
        if name in found and name in true:
            truth = true[name]["tape_cm"]
            numbers = [found[name]["tape_cm"], *found[name]["interval_cm"]]
            off[name] = [round(100 * (cm / truth - 1), 2) for cm in numbers]
    return off


def main():
    tailor, work, sizes, *surfaces = sys.argv[1:]
    tailor, work = pathlib.Path(tailor).absolute(), pathlib.Path(work).absolute()
    scans = {}
    for surface in surfaces:
        surface, _, own = surface.partition("@")
        surface = pathlib.Path(surface).absolute()
        for size in (own or sizes).split(","):
            made = film if size.startswith("film:") else row
            scans.setdefault(surface.name, []).append(made(tailor, work, surface, size.removeprefix("film:")))
    json.dump({**timed.made_with(tailor), "scans": scans}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
