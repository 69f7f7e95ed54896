"""Writes made bodies with their truth: FAMILY/NNNN.ply, NNNN.json and truth.csv under a folder.

    python3 models/made/make_bodies.py OUT range [--from 0] [--to 400] [--survey models/tables/ansur2.csv]

Families: range, survey, poses, reach (see README.md). A body depends on its family and number alone.
"""
import argparse
import csv
import json
import os
from pathlib import Path

# One thread: the same sums in the same order, and no quarrel over cores.
os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = os.environ["MKL_NUM_THREADS"] = "1"

import numpy as np

import families
import surface as surfaces
import truth as truths
from body import Body
from check_bodies import read_ply
from pose import posed


def range_body(body, number):
    rng = families.stream("range", number)
    years, phenotype = families.phenotype(body, rng)
    local = families.local_changes(rng)
    v, heads = body.shape(phenotype, local)
    about = {"years": round(years, 1), "phenotype": phenotype, "local": local}
    return v, heads, families.stance(rng, np.ptp(v[:, 2])), about, {}, finish(rng, number)


def reach_body(body, number):
    """Arms that hang against the trunk, heavy bodies oftener; always one remeshed surface."""
    rng = families.stream("reach", number)
    years, phenotype = families.phenotype(body, rng, children=0.1)
    phenotype["weight"] = float(np.clip(phenotype["weight"] + rng.uniform(-0.1, 0.3), 0, 1))
    local = families.local_changes(rng)
    v, heads = body.shape(phenotype, local)
    pose = families.stance(rng, np.ptp(v[:, 2]), arms=(3.0, 15.0), elbows=(0.0, 20.0))
    about = {"years": round(years, 1), "phenotype": phenotype, "local": local}
    return v, heads, pose, about, {}, {"voxel": float(rng.uniform(3.0, 4.0)), "web": float(rng.uniform(4.0, 16.0))}


def pose_body(body, number):
    sex, pose = families.pose_grid()[number]
    phenotype = {"gender": sex, "age": 2 / 3, "height": 0.35 if sex else 0.28}
    v, heads = body.shape(phenotype)
    return v, heads, pose, {"phenotype": phenotype, "local": {}}, {}, {"subdivide": True}


def finish(rng, number):
    """Every third body is remeshed as a reconstruction would leave it, every third subdivided."""
    voxel, web = float(rng.uniform(4.0, 8.0)), float(rng.uniform(0.0, 20.0))
    return ({"voxel": voxel, "web": web}, {"subdivide": True}, {})[number % 3]


def make(body, family, number, survey, kept=None):
    """Vertices, faces and the row of one body; `kept`: its surface as written before, of which the truth is taken anew."""
    if family == "survey":
        v, heads, pose, about, levels = survey.body_of(number)
        how = finish(np.random.default_rng([families.SEEDS["survey"], number, 1]), number)
    else:
        v, heads, pose, about, levels, how = {"range": range_body, "reach": reach_body, "poses": pose_body}[family](
            body, number
        )
    v, heads = posed(body, v, heads, pose)
    if callable(levels):
        levels = levels(truths.landmarks(body, v, heads))
    clean, stature, marks, planes = truths.truth(body, v, heads, levels)
    if kept is None:
        w, g, part = surfaces.written(body, clean, how, marks)
    else:
        w, g = kept
        part = surfaces.parts_from(w, g, clean.v, clean.f, body.face_part)
    row = truths.row(clean, truths.Surface(w, g, part), stature, marks, planes)
    return w, g, {"family": family, "number": number, "finish": how, "pose": rounded(pose), **rounded(about), **row}


def rounded(x):
    if isinstance(x, dict):
        return {k: rounded(y) for k, y in x.items()}
    return round(x, 5) if isinstance(x, float) else x


def flat(row):
    """The row for the table: one number a cell."""
    out = {"number": row["number"], "stature": row["stature"], "years": row.get("years", "")}
    out["gender"] = row["phenotype"]["gender"]
    out["remeshed"] = int("voxel" in row["finish"])
    out.update({k: row["pose"][k] for k in ("arm_l", "arm_r", "elbow_l", "elbow_r", "feet", "knee")})
    for n, p in row["marks"].items():
        out.update({f"{n}.{a}": x for a, x in zip("xyz", p)})
    for n, p in row["planes"].items():
        out.update({f"{n}.z": p["point"][2], f"{n}.tape": p["tape"], f"{n}.tape_clean": p["tape_clean"]})
    for n in ("target", "achieved"):
        out.update({f"{n}.{k}": x for k, x in row.get(n, {}).items()})
    return out


def table(folder):
    """truth.csv anew from all rows in the folder."""
    rows = [flat(json.loads(p.read_text())) for p in sorted(folder.glob("[0-9]*.json"))]
    names = list(dict.fromkeys(k for r in rows for k in r))
    with open(folder / "truth.csv", "w", newline="") as out:
        sheet = csv.DictWriter(out, names, lineterminator="\n")
        sheet.writeheader()
        sheet.writerows(rows)


def main():
    args = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    args.add_argument("out", type=Path)
    args.add_argument("family", choices=list(families.COUNTS))
    args.add_argument("--from", dest="first", type=int, default=0)
    args.add_argument("--to", dest="end", type=int)
    args.add_argument("--survey", type=Path, default=Path(__file__).parent.parent / "tables" / "ansur2.csv")
    args.add_argument("--retake", action="store_true", help="keep the surfaces there are, take their truth anew")
    args = args.parse_args()
    folder = args.out / args.family
    folder.mkdir(parents=True, exist_ok=True)
    body = Body()
    survey = None
    if args.family == "survey":
        from survey import Survey

        survey = Survey(body, args.survey)
    end = args.end or (len(families.pose_grid()) if args.family == "poses" else families.COUNTS[args.family])
    for number in range(args.first, end):
        path = folder / f"{number:04}.ply"
        kept = read_ply(path) if args.retake and path.exists() else None
        v, f, row = make(body, args.family, number, survey, kept)
        if kept is None:
            surfaces.write_ply(path, v, f)
        (folder / f"{number:04}.json").write_text(json.dumps(row) + "\n")
        print(args.family, number, row["stature"], row["finish"], flush=True)
    table(folder)


if __name__ == "__main__":
    main()
