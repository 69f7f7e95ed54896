#!/usr/bin/env python3
"""Captures made bodies again and again and writes what `tailor repeat` and `tailor follow` find of them.

    docs/tables/repeats.py [--captures 3] [--cells 8] TAILOR WORK [BODY.ply...]

Each body is captured so many times through `synth.turn` and `synth.phone` (repeats.toml): turned and moved on the disk, swaying, in
other light, exposure, white balance and noise, its marks other each time. The first body is the one by formula, its arms at 40 to 44
degrees; others are surfaces in PLY (binary, millimetres, z up). Then `tailor measure`, and `tailor repeat --same-level` of all; of
each body's first capture its waist is grown by a belt of 60 mm height, 5 mm around, captured once more, and `tailor follow` tells the
change from every capture to the grown one, and from the first to each other, where there is none. WORK keeps all; what is there is
not made again. 18 photos of 800x1200 a capture. Results: WORK/repeat/, WORK/follow-*/, and WORK/told.json (also on the screen).
"""

import argparse
import json
import math
import pathlib
import random
import struct
import subprocess
import sys

SIZES = {"char": 1, "uchar": 1, "short": 2, "ushort": 2, "int": 4, "uint": 4, "float": 4, "double": 8}
SIZES |= {"int8": 1, "uint8": 1, "int16": 2, "uint16": 2, "int32": 4, "uint32": 4, "float32": 4, "float64": 8}
GROWN_MM, BELT_MM = 5.0, 60.0


class Surface:
    """A PLY file whose vertices can be moved; all else of it stays as it is."""

    def __init__(self, path):
        data = path.read_bytes()
        end = data.index(b"end_header") + len(b"end_header")
        end = data.index(b"\n", end - 1) + 1
        lines = data[:end].decode("ascii").split("\n")
        if "format binary_little_endian 1.0" not in [line.strip() for line in lines]:
            sys.exit(f"{path}: a binary PLY is wanted (little endian)")
        words = [line.split() for line in lines]
        at = next(i for i, w in enumerate(words) if w[:2] == ["element", "vertex"])
        if any(w[:1] == ["element"] for w in words[:at]):
            sys.exit(f"{path}: vertices must come first")
        fields = []
        for w in words[at + 1 :]:
            if w[:1] != ["property"]:
                break
            fields.append((w[1], w[2]))
        self.kind = fields[0][0]
        if [name for _, name in fields[:3]] != ["x", "y", "z"] or any(kind != self.kind for kind, _ in fields[:3]):
            sys.exit(f"{path}: vertices must begin with x, y, z of one kind")
        self.stride = sum(SIZES[kind] for kind, _ in fields)
        self.head, self.body, self.count = data[:end], bytearray(data[end:]), int(words[at][2])
        self.code = "<3d" if SIZES[self.kind] == 8 else "<3f"

    def points(self):
        """All vertices [mm]."""
        return [struct.unpack_from(self.code, self.body, i * self.stride) for i in range(self.count)]

    def moved(self, move, path):
        """Writes the surface with every vertex moved."""
        body = bytearray(self.body)
        for i, p in enumerate(self.points()):
            struct.pack_into(self.code, body, i * self.stride, *move(p))
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(self.head + body)


def placed(turn_deg, x_mm, y_mm):
    """A turn about the vertical and a move on the disk."""
    c, s = math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg))
    return lambda p: (c * p[0] - s * p[1] + x_mm, s * p[0] + c * p[1] + y_mm, p[2])


def belted(surface, girth):
    """What grows the body around a girth: outward from the girth's middle, full at its height, nothing at the belt's edges."""
    x, y, z = girth["plane"]["point_mm"]
    share = GROWN_MM / (10.0 * girth["tape_cm"])
    reach = girth["tape_cm"] * 10.0 / math.tau * 1.6

    def move(p):
        beside, up = math.hypot(p[0] - x, p[1] - y), abs(p[2] - z) / (BELT_MM / 2)
        # Flat in the middle third, so that the tape finds all of it; arms beyond stay.
        rise = 1.0 if up < 1 / 3 else 0.5 + 0.5 * math.cos(math.pi * min(1.0, (up - 1 / 3) * 1.5))
        by = share * rise * (beside < reach)
        return (p[0] + by * (p[0] - x), p[1] + by * (p[1] - y), p[2])

    return move


def run(*command):
    """A command that must succeed."""
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}: exit {done.returncode}")
    return done.stdout


class Study:
    """One run of the study."""

    def __init__(self, args):
        self.tailor, self.work, self.cells = pathlib.Path(args.tailor).resolve(), pathlib.Path(args.work).resolve(), args.cells
        self.pipeline = pathlib.Path(__file__).with_name("repeats.toml")
        self.common = ["--cache", self.work / "cache", "--quiet"]

    def shown(self, pipeline, node, path, said, *how):
        """Runs a pipeline to a node and writes its result."""
        run(self.tailor, "run", pipeline, *said, node, *self.common)
        path.parent.mkdir(parents=True, exist_ok=True)
        run(self.tailor, "show", node, "--pipeline", pipeline, *said, *how, "-o", path, *self.common)

    def formula(self, arms_deg, path):
        """The body by formula with its arms held so."""
        self.shown("synth", "true_body", path, ["--set", f"solid.arms_deg={arms_deg:.2f}"])

    def captured(self, name, surface, seed):
        """Photos of a surface, and what is measured of them: the folder of results."""
        out = self.work / f"{name}-out"
        if (out / "girths.json").exists():
            return out
        dice = random.Random(seed)
        sets = {
            "ring.seed": seed, "sway.seed": seed, "sway.sway_mm": dice.uniform(2, 4), "taken.seed": seed,
            "taken.ambient": dice.uniform(0.4, 0.6), "taken.noise_levels": dice.uniform(0.8, 1.6),
            "photos.seed": seed, "photos.exposure_ev": dice.uniform(0.02, 0.1), "photos.white": dice.uniform(0.0, 0.02),
        }
        flags = [f for key, value in sets.items() for f in ("--set", f"{key}={value}")]
        photos = self.work / name
        self.shown(self.pipeline, "photos", photos, ["--input", f"surface={surface.parent}", *flags], "--as", "capture")
        run(self.tailor, "measure", photos, "--out", out, "--set", f"params.cell_mm={self.cells}", *self.common)
        return out

    def person(self, name, body, captures, first):
        """Captures of one body, and one with its waist grown: folders of results."""
        outs = []
        for k in range(captures + 1):
            seed = first + k
            dice = random.Random(1000 + seed)
            grown = k == captures
            label = f"{name}-grown" if grown else f"{name}-{k + 1}"
            file = self.work / "surfaces" / label / "body.ply"
            if body is None:
                source = self.work / "surfaces" / f"{label}-rest" / "body.ply"
                self.formula(42.0 if grown else dice.uniform(40, 44), source)
            else:
                source = body
            surface = Surface(source)
            if grown:
                waist = self.waist_at_rest(surface, label)
                rest = self.work / "surfaces" / f"{label}-belt" / "body.ply"
                surface.moved(belted(surface, waist), rest)
                surface = Surface(rest)
            surface.moved(placed(dice.uniform(-15, 12), dice.uniform(-20, 20), dice.uniform(-20, 20)), file)
            outs.append(self.captured(label, file, seed))
            print(f"{label}: measured", file=sys.stderr)
        return outs

    def waist_at_rest(self, surface, label):
        """The waist of the surface itself, without photos."""
        place = self.work / "surfaces" / f"{label}-true" / "body.ply"
        surface.moved(lambda p: p, place)
        out = self.work / "surfaces" / f"{label}-girths"
        run(self.tailor, "run", "surface", "--input", f"surface={place.parent}", "--out", out, *self.common)
        girths = json.loads((out / "girths.json").read_text())["girths"]
        return next(g for g in girths if g["name"] == "WC")


def main():
    """The study, told as JSON."""
    asks = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    asks.add_argument("--captures", type=int, default=3)
    asks.add_argument("--cells", type=float, default=8.0, help="cells of both hulls [mm]")
    asks.add_argument("tailor")
    asks.add_argument("work")
    asks.add_argument("bodies", nargs="*", type=pathlib.Path)
    args = asks.parse_args()
    study = Study(args)
    study.work.mkdir(parents=True, exist_ok=True)
    bodies = {"formula": None} | {f"{body.stem}{i}": body for i, body in enumerate(args.bodies, 1)}
    people = {name: study.person(name, body, args.captures, 100 * i) for i, (name, body) in enumerate(bodies.items(), 1)}
    captures = [out for outs in people.values() for out in outs[:-1]]
    told = study.work / "repeat"
    run(study.tailor, "repeat", "--same-level", *captures, "--out", told, "--quiet")
    result = {"captures": args.captures, "cell_mm": args.cells, "repeat": json.loads((told / "repeat.json").read_text())["repeatability"], "waist": {}}
    for name, outs in people.items():
        grown, *others = outs[-1:] + outs[:-1]
        pairs = {f"{o.name} -> {grown.name}": (o, grown) for o in others}
        pairs |= {f"{others[0].name} -> {o.name}": (others[0], o) for o in others[1:]}
        for label, pair in pairs.items():
            text = run(study.tailor, "follow", name, *pair, "--repeat", told / "repeat.json", "--json", "--quiet")
            lines = json.loads(text)["girths"]
            waist = next(line for line in lines if line["name"] == "WC")["at"][-1]
            result["waist"][label] = {"grown_mm": GROWN_MM if pair[1] is grown else 0.0} | {
                key: waist[key] for key in ("change_mm", "lsc95_mm", "changed")
            }
    (study.work / "told.json").write_text(json.dumps(result, indent=1) + "\n")
    json.dump(result, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
