#!/usr/bin/env python3
"""Fits how wide a piece of a part of the body a mask may leave out before it is named.

    cargo run --release -p person --features tables --example alarm -- PHOTOS MASKS [PHOTOS MASKS]... > lost.jsonl
    models/person/alarm.py lost.jsonl [HELD_OUT.jsonl]

By part: the middle between the most that a true mask leaves out, and what nine in ten masks leave out that lack a limb of that part (of
two). Prints them, and by part how many true masks and how many without a
limb are named, of the fit and of the held-out. `stages/person/src/alarm.rs` holds the numbers. Wants numpy.
"""

import json
import sys

import numpy as np

PARTS = {"head": ["head"], "trunk": ["left side", "right side"], "arms": ["left forearm", "right forearm"], "legs": ["left shank", "right shank"]}


def read(path):
    """By part: widths that true masks leave out, and that masks without a limb of it do. [pixels of the network]"""
    rows = [json.loads(line) for line in open(path)]
    of = lambda k, taken: np.array([row["parts"][k][0] for row in rows if row["taken"] in taken])
    return {part: (of(k, ["nothing"]), of(k, taken)) for k, (part, taken) in enumerate(PARTS.items())}


def bound(true, lacking):
    """The width from which on a mask is named."""
    return (true.max() + np.quantile(lacking, 0.1)) / 2


def main(fitted_on, held_out=None):
    """Fits and prints."""
    fitted = read(fitted_on)
    bounds = {part: round(bound(*widths), 1) for part, widths in fitted.items()}
    for name, widths in [("fitted on", fitted), ("held out", read(held_out) if held_out else {})]:
        for part, (true, lacking) in widths.items():
            named = [int((some > bounds[part]).sum()) for some in (true, lacking)]
            print(f"{name}: {part} {bounds[part]} px: true masks named {named[0]} of {len(true)} (most {true.max():.1f} px), without a limb {named[1]} of {len(lacking)}")


if __name__ == "__main__":
    main(*sys.argv[1:])
