#!/usr/bin/env python3
"""Halves and doubles a crate's constants that are not on record and its defaults set by hand, and writes what cameras do.

    docs/tables/constants.py CHECKOUT WORK CRATE CAPTURE... > docs/tables/constants.json

In WORK/src, a copy of the checkout, constants are functions that a variable scales (scaled.py); that program is built once. Params go by
`--set`, at all nodes of their stage at once, each from its own value. `CRATE/frame,mat` takes these folders and stages alone. A CAPTURE
has photos, `masks/`, which are taken as they are, and `truth/cameras.json`; before it, with a colon, the name of another pipeline than
`own-masks`. Keys do not know constants: each is tried on the cache as it was before the first node that reads it; where none does, and
where a param would be out of its range, there is null. `nothing` has other seeds and scales all by a hundred-thousandth: what moves then is
chance. Of each: whether cameras are the same bytes, and warnings where these are others; after a similarity, root of the mean square of the
centres' errors [mm] and median rotation error [deg]; besides, errors of scale [%], axis [deg] and ground [mm]. A truth whose unit is not
known is laid at a mean distance of 1000 mm. Docs' page with such a table: docs/lab/numbers.md. WORK keeps what was made; what is there is
not made again. Wants numpy.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy as np
import scaled

FIGURES = ["centres_mm", "rotation_deg", "scale_pct", "tilt_deg", "ground_mm"]


def cameras_of(path):
    """A file's cameras: rotations and translations by photo, the ground's height, and the unit in mm if it is known."""
    of = json.loads(path.read_text())
    about = json.dumps({key: value for key, value in of.items() if key != "views"})
    views = {pathlib.Path(v["image"]).name: (np.array(v["R"]), np.ravel(v["t"])) for v in of["views"]}
    return views, of.get("ground_mm", 0.0), 1000.0 if "metres" in about else 1.0 if '"mm"' in about else None


def figures(ours, true):
    """How far cameras are from the true ones."""
    both, unit = sorted(set(ours[0]) & set(true[0])), true[2]
    a, b = (np.array([-of[0][name][0].T @ of[0][name][1] for name in both]) for of in (ours, true))
    b = b * (unit or 1000 / np.linalg.norm(b - b.mean(0), axis=1).mean())
    u, s, vt = np.linalg.svd((b - b.mean(0)).T @ (a - a.mean(0)))
    flip = np.array([1, 1, np.sign(np.linalg.det(u @ vt))])
    size, turn = (s * flip).sum() / ((a - a.mean(0)) ** 2).sum(), u * flip @ vt
    move = b.mean(0) - size * turn @ a.mean(0)
    cosines = [(np.trace(ours[0][name][0] @ turn.T @ true[0][name][0].T) - 1) / 2 for name in both]
    found = [np.sqrt(((size * a @ turn.T + move - b) ** 2).sum(1).mean()), np.degrees(np.median(np.arccos(np.clip(cosines, -1, 1))))]
    if unit:
        found += [100 / size - 100, np.degrees(np.arccos(min(turn[2, 2], 1))), (size * turn @ [0, 0, ours[1]] + move)[2]]
    return {"cameras": len(both)} | dict(zip(FIGURES, (round(float(x), 5) for x in found)))


class Capture:
    """A capture, its nodes of the crate, and which node is the first to read a constant."""

    def __init__(self, tailor, work, crate, given):
        self.pipeline, self.path = (["own-masks", *given.split(":")])[-2:]
        self.tailor, self.work, self.first = tailor, work / pathlib.Path(self.path).name, {}
        self.true = cameras_of(pathlib.Path(self.path) / "truth/cameras.json")
        self.plain = self.run("as it is", self.work / "cache")
        self.nodes = [n for n in self.plain["nodes"] if n["stage"].startswith(crate + ".")]
        for node in (n["node"] for n in self.nodes):
            before, read = self.work / "before" / node, self.work / f"{node}.txt"
            if not before.exists():
                (self.work / "grown").mkdir(exist_ok=True)
                shutil.copytree(self.work / "grown", before)
            self.run(f"up to {node}", self.work / "grown", goal=node, TRIAL_READ=str(read))
            self.first = dict.fromkeys(read.read_text().split() if read.exists() else [], node) | self.first

    def run(self, name, cache, sets=(), goal="cameras", **trial):
        """What a run ends with: its nodes and where its files are, or why it failed."""
        out, pipeline = self.work / "out" / name, self.tailor.parents[2] / f"src/pipelines/{self.pipeline}.toml"
        if not (out / "end.json").exists():
            inputs = [f"--input=photos={self.path}", f"--input=masks={self.path}/masks", "--quiet", "--cache", cache, "--out", out]
            run = [self.tailor, "run", pipeline, goal, *inputs, *(f"--set={s}" for s in sets)]
            done = subprocess.run(run, stdin=subprocess.DEVNULL, capture_output=True, text=True, env=os.environ | trial)
            out.mkdir(parents=True, exist_ok=True)
            (out / "end.json").write_text(json.dumps(done.stderr.splitlines()[0] if done.returncode else None))
        why = json.loads((out / "end.json").read_text())
        return {"failed": why} if why else {"nodes": json.loads((out / "run.json").read_text())["nodes"], "file": out / "cameras.json"}

    def tried(self, ended):
        """What a run's cameras are like."""
        if "failed" in ended:
            return ended
        warned, before = ([w for n in of["nodes"] for w in n["warnings"]] for of in (ended, self.plain))
        same = ended["file"].read_bytes() == self.plain["file"].read_bytes()
        return {"same": same} | ({} if warned == before else {"warned": warned}) | figures(cameras_of(ended["file"]), self.true)

    def constant(self, name, factor):
        """What becomes of a constant scaled."""
        if name in self.first:
            with tempfile.TemporaryDirectory(dir=self.work) as cache:
                shutil.copytree(self.work / "before" / self.first[name], cache, dirs_exist_ok=True)
                return self.tried(self.run(f"{name} x {factor}".replace("/", "."), cache, TRIAL=f"{name}={factor}"))

    def nothing(self, i, params):
        """What becomes of what should change nothing, without a cache."""
        seeds = [f"{n['node']}.seed={int(value) + i}" for n in self.nodes for key, value in n["provenance"] if key == "with seed"]
        sets = [word for stage, param in params for word in self.set_by(stage, param, 1 + 1e-5 * i)]
        with tempfile.TemporaryDirectory(dir=self.work) as cache:
            return self.tried(self.run(f"nothing {i}", cache, seeds + sets, TRIAL=f"*={1 + 1e-5 * i}"))

    def set_by(self, stage, param, factor):
        """How a param is set that is scaled at its nodes; not at all where that is out of its range or nothing."""
        own = {n["node"]: json.loads(dict(n["provenance"])[f"with {param['name']}"]) for n in self.nodes if n["stage"] == stage}
        value = {node: round(v * factor) if param["type"] == "a whole number" else v * factor for node, v in own.items()}
        fits = value != own and all(param["range"][0] <= v <= param["range"][1] for v in value.values())
        return [f"{node}.{param['name']}={v!r}" for node, v in value.items()] if fits else []


def main(checkout, work, crate, *captures):
    work, (crate, _, parts) = pathlib.Path(work).resolve(), crate.partition("/")
    parts = tuple(parts.split(","))
    tailor, root = work / "target/release/tailor", work / "src/stages" / crate / "src"
    if not (work / "src").exists():
        shutil.copytree(checkout, work / "src", ignore=shutil.ignore_patterns(".git", "target"))
        scaled.rewritten(root)
    build = ["cargo", "build", "--release", "--target-dir", work / "target"]
    subprocess.run(build, cwd=work / "src", check=True, stdin=subprocess.DEVNULL)
    stages = json.loads(subprocess.check_output([tailor, "stages", "--json"], stdin=subprocess.DEVNULL))
    of = [s for s in stages if s["name"].startswith(tuple(f"{crate}.{part}" for part in parts))]
    params = [(s["name"], p) for s in of for p in s["params"] if p.get("source", {}).get("kind") == "by hand"]
    names, rows = [name for name in (root / "trial.txt").read_text().split() if name.startswith(parts)], {}
    for capture in (Capture(tailor, work, crate, given) for given in captures):
        def ends(row, found):
            rows.setdefault(row, {})[capture.work.name] = found
            print(capture.work.name, row, json.dumps(found), file=sys.stderr, flush=True)

        ends("as it is", capture.tried(capture.plain))
        for i in range(5):
            ends(f"nothing {i}", capture.nothing(i, params))
        for name in names:
            for by in (0.5, 2):
                ends(f"{name} x {by}", capture.constant(name, by))
        for stage, p in params:
            for by in (0.5, 2):
                sets, row = capture.set_by(stage, p, by), f"{stage}.{p['name']} x {by}"
                ends(row, capture.tried(capture.run(row, capture.work / "cache", sets)) if sets else None)
    json.dump(rows, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
