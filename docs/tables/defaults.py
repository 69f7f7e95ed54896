#!/usr/bin/env python3
"""Halves and doubles each default that was set by hand, and writes what surfaces, girths and cameras do.

    docs/tables/defaults.py TAILOR WORK STAGE,... CAPTURE... > docs/tables/defaults.json

A CAPTURE has its photos and `truth/`. A number is changed at all nodes of its stage in `pipelines/body.toml` at once, each from its own
value; whole numbers are rounded, and a value beyond the param's range is left out. `nothing` changes numbers by a hundred-thousandth
only: what moves then is chance. Of each value: mean distance of all and of the trunk from the true surface [mm]; by tapes at the measured
planes, root of the mean square and mean error [%], and how many are given; of the cameras, median error of centres [mm] and of rotations
[°]. Docs' pages with such tables: docs/lab/numbers.md. WORK keeps what was made; what is there is not made again.
"""

import json
import pathlib
import subprocess
import sys
import tomllib

PIPELINE = pathlib.Path(__file__).parents[2] / "pipelines/body.toml"
# What is measured of a value. Greater is worse but for how many girths are given.
FIGURES = ["all_mm", "trunk_mm", "tapes_rms_pct", "tapes_mean_pct", "girths", "centres_mm", "rotation_deg"]


def by_hand(tailor, stages):
    """Of each default that was set by hand: its stage, its name, its doc's record, range, and its value at each node."""
    nodes = tomllib.loads(PIPELINE.read_text())["node"]
    given = tomllib.loads(PIPELINE.read_text())["params"]
    for name in stages:
        stage = json.loads(subprocess.check_output([tailor, "stages", name, "--json"], stdin=subprocess.DEVNULL))[0]
        for param in stage["params"]:
            if param.get("source", {}).get("kind") != "by hand":
                continue
            whole, least, most = param["type"] == "a whole number", *param["range"]
            own = {}
            for node, of in nodes.items():
                if of["stage"] == name:
                    value = of.get("with", {}).get(param["name"], json.loads(param["default"]))
                    own[node] = given[value[1:]] if isinstance(value, str) else value
            yield name, param["name"], whole, (least, most), own


def flags(own, factor, whole, span):
    """The values of a number at its nodes, or nothing if one is beyond its range or as before."""
    values = {node: round(value * factor) if whole else value * factor for node, value in own.items()}
    if all(values[node] == own[node] for node in own) or not all(span[0] <= v <= span[1] for v in values.values()):
        return None
    return values


def figures(tailor, work, capture, name, values):
    """What surfaces, girths and cameras of a capture come out as with such values."""
    out = work / capture.name / name
    if not (out / "score.json").exists():
        run = [tailor, "run", PIPELINE, "girths", "cameras", "body", "--input", f"photos={capture}", "--quiet"]
        sets = [f"--set={where}={value!r}" for where, value in values.items()]
        done = subprocess.run([*run, *sets, "--cache", work / "cache", "--out", out], stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if done.returncode:
            return {"failed": done.stderr.strip().splitlines()[-1]}
        score = [tailor, "score", out, "--truth", capture / "truth", "--json", "--cache", work / "cache"]
        (out / "score.json").write_bytes(subprocess.check_output(score, stdin=subprocess.DEVNULL))
    of = json.loads((out / "score.json").read_text())[0]
    errors = [girth["tape_pct"] for girth in (of["girths_at_measured_planes"] or {}).values() if girth]
    if not errors:
        return {"failed": "no girth is given"}
    mesh, cameras = of["mesh"], of["cameras"]
    rms = (sum(e * e for e in errors) / len(errors)) ** 0.5
    mean = sum(errors) / len(errors)
    found = [mesh["all"]["accuracy_mean_mm"], mesh["trunk"]["accuracy_mean_mm"], rms, mean, len(errors)]
    found += [cameras["centre_mm_median"], cameras["rotation_deg_median"]]
    return dict(zip(FIGURES, (round(x, 4) for x in found)))


def main():
    tailor, work, stages = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3].split(",")
    captures = [pathlib.Path(capture) for capture in sys.argv[4:]]
    numbers = list(by_hand(tailor, stages))
    tried = [("as it is", {}), *((f"nothing {i}", nothing(numbers, 1 + 1e-5 * i)) for i in (1, 2, 3))]
    for stage, param, whole, span, own in numbers:
        for factor in (0.5, 2):
            if values := flags(own, factor, whole, span):
                tried.append((f"{stage}.{param} x {factor}", {f"{node}.{param}": value for node, value in values.items()}))
    rows = []
    for name, values in tried:
        row = {"number": name, "values": values}
        row |= {capture.name: figures(tailor, work, capture, name.replace(" ", "_"), values) for capture in captures}
        rows.append(row)
        print(json.dumps(row), file=sys.stderr, flush=True)
    json.dump(rows, sys.stdout, indent=1)
    print()


def nothing(numbers, factor):
    """All numbers that are no whole ones, changed by next to nothing."""
    return {f"{node}.{param}": value * factor for _, param, whole, _, own in numbers if not whole for node, value in own.items() if value}


if __name__ == "__main__":
    main()
