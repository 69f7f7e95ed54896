#!/usr/bin/env python3
"""Measures captures with ground truth and writes what `docs/accuracy.md` shows of them.

    docs/tables/bodies.py target/release/tailor CAPTURE...  > docs/tables/bodies.json

A capture is a folder with `truth/` in it; its name is that of its column. One run each, alone on the machine, with an empty cache.
"""

import datetime
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time


def measured(tailor, capture):
    """One run: time and peak memory, and the score against the truth."""
    with tempfile.TemporaryDirectory() as work:
        out, cache = pathlib.Path(work, "out"), pathlib.Path(work, "cache")
        begun = time.monotonic()
        run = subprocess.Popen([tailor, "measure", capture, "--out", out, "--cache", cache, "--quiet"], stdout=subprocess.DEVNULL)
        _, status, usage = os.wait4(run.pid, 0)
        seconds = time.monotonic() - begun
        if status:
            sys.exit(f"{capture}: measure failed")
        score = subprocess.run([tailor, "score", out, "--truth", pathlib.Path(capture, "truth"), "--json"], check=True, stdout=subprocess.PIPE)
        return {"seconds": round(seconds, 1), "peak_gb": round(usage.ru_maxrss / 1e6, 3), "score": json.loads(score.stdout)[0]}


def main(tailor, *captures):
    """All captures, and what they were made with."""
    git = ["git", "describe", "--always", "--dirty=+"]
    commit = subprocess.run(git, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    version = subprocess.run([tailor, "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    result = {
        "program": f"{version} at {commit}",
        "date": datetime.date.today().isoformat(),
        "machine": f"{os.cpu_count()} cores",
        "captures": {pathlib.Path(c).name: measured(tailor, c) for c in captures},
    }
    json.dump(result, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main(*sys.argv[1:])
