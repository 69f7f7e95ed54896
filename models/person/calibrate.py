#!/usr/bin/env python3
"""Fits how far the network's log-odds of the body are to be believed.

    cargo run --release -p person --features tables --example calibrate -- PHOTOS MASKS [PHOTOS MASKS]... > counts.jsonl
    models/person/calibrate.py counts.jsonl [HELD_OUT.jsonl]

Logistic calibration (Platt 1999): log-odds of the body = base + slope * the network's, by maximum likelihood, every capture with the
same weight, whatever its size. Prints both numbers, and the log-loss [nat a pixel] before and after, on the captures of the fit and on
those held out: `stages/silhouette/src/likelihood/person.rs` holds the numbers. Wants numpy and scipy.
"""

import json
import sys

import numpy as np
from scipy.optimize import minimize

# The network's log-odds are kept in sixteenths of a nat, -127 to 127.
ODDS = (np.arange(255) - 127) / 16


def loss(counts, base, slope):
    """Mean log-loss of each capture. [nat a pixel]"""
    odds = base + slope * ODDS
    of_background, of_body = np.logaddexp(0, odds), np.logaddexp(0, -odds)
    return [(c[:, 0] @ of_background + c[:, 1] @ of_body) / c.sum() for c in counts]


def read(path):
    """Counts of background and body by step of log-odds, a capture a line."""
    return [np.array(json.loads(line)["counts"], float) for line in open(path)]


def main(fitted_on, held_out=None):
    """Fits and prints."""
    counts = read(fitted_on)
    base, slope = minimize(lambda p: np.mean(loss(counts, *p)), [0.0, 1.0], method="Nelder-Mead").x
    print(f"base {base:.3f}, slope {slope:.3f}, {len(counts)} captures")
    for name, of in [("fitted on", counts), ("held out", read(held_out) if held_out else [])]:
        if of:
            print(f"{name}: {np.mean(loss(of, 0, 1)):.4f} before, {np.mean(loss(of, base, slope)):.4f} after, each after:", np.round(loss(of, base, slope), 4))


if __name__ == "__main__":
    main(*sys.argv[1:])
