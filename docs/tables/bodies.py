#!/usr/bin/env python3
"""Measures captures with ground truth and writes what `docs/accuracy.md` shows of them.

    docs/tables/bodies.py target/release/tailor CAPTURE...  > docs/tables/bodies.json

A capture is a folder with `truth/` in it; its name is that of its column. One run each, alone on the machine, with an empty cache.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import timed


def measured(tailor, capture):
    """One run: time and peak memory, and the score against the truth."""
    with tempfile.TemporaryDirectory() as work:
        out, cache = pathlib.Path(work, "out"), pathlib.Path(work, "cache")
        cost = timed.measured(tailor, capture, out, cache)
        score = subprocess.run([tailor, "score", out, "--truth", pathlib.Path(capture, "truth"), "--json"], check=True, stdout=subprocess.PIPE)
        return {**cost, "score": json.loads(score.stdout)[0]}


def main(tailor, *captures):
    """All captures, and what they were made with."""
    result = {**timed.made_with(tailor), "captures": {pathlib.Path(c).name: measured(tailor, c) for c in captures}}
    json.dump(result, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
