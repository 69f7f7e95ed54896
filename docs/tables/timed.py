"""A measure whose cost is taken, and what a table was made with: for the programs beside it."""

import datetime
import os
import subprocess
import sys
import time


def measured(tailor, capture, out, cache, *flags):
    """What one run cost: seconds by the clock and of the processor, peak memory [GB]."""
    begun = time.monotonic()
    run = subprocess.Popen([tailor, "measure", capture, "--out", out, "--cache", cache, "--quiet", *flags], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(run.pid, 0)
    seconds = time.monotonic() - begun
    if status:
        sys.exit(f"{capture}: measure failed")
    processor = usage.ru_utime + usage.ru_stime
    return {"seconds": round(seconds, 1), "processor_s": round(processor, 1), "peak_gb": round(usage.ru_maxrss / 1e6, 3)}


def made_with(tailor):
    """The program, the day, the machine."""
    git = ["git", "describe", "--always", "--dirty=+"]
    commit = subprocess.run(git, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    version = subprocess.run([tailor, "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    return {"program": f"{version} at {commit}", "date": datetime.date.today().isoformat(), "machine": f"{os.cpu_count()} cores"}
