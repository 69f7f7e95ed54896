"""What more cores gain: the same capture on 1, 2, 4 … cores of one machine, node by node.

    python3 benches/cores.py PROGRAM CAPTURE [--cores 1 2 4 8 16] [--runs 3] [--json FILE]

PROGRAM is a `tailor`, CAPTURE a folder of photos. Each run begins with an empty cache, and is kept to the cores by the
system. By the clock, the run in the middle counts. A node's clock runs on while others take its cores. Last, whether
the files written are the same bytes on all numbers of cores (`run.json`, which has times, left out).
"""

import argparse
import hashlib
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time


def run(program, capture, cores):
    """Of one run: seconds by the clock and of the processor, the same by node, and the hash of what it wrote."""
    some = sorted(os.sched_getaffinity(0))[:cores]
    with tempfile.TemporaryDirectory() as place:
        trace, out = os.path.join(place, "trace.json"), os.path.join(place, "out")
        command = [program, "measure", capture, "--threads", str(cores), "--profile", trace]
        command += ["--cache", os.path.join(place, "cache"), "--out", out]
        start = time.monotonic()
        child = subprocess.Popen(
            command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, preexec_fn=lambda: os.sched_setaffinity(0, some)
        )
        first = [time.monotonic() - start for line in child.stderr if line.startswith("first answer")]
        _, status, used = os.wait4(child.pid, 0)
        clock = time.monotonic() - start
        if status != 0:
            sys.exit(f"{program} failed on {capture}")
        with open(trace) as file:
            spans = [e for e in json.load(file)["traceEvents"] if e["ph"] == "X" and e["name"] == e["cat"] and e["args"]["processor_s"] is not None]
        written = hash_of(out)
    nodes = {e["name"]: (e["dur"] / 1e6, e["args"]["processor_s"]) for e in spans}
    processor = used.ru_utime + used.ru_stime
    return {"clock": clock, "processor": processor, "first": first[:1], "nodes": nodes, "written": written, "spans": spans}


def hash_of(folder):
    """Of all files of a folder, with their names."""
    whole = hashlib.sha256()
    for at, _, names in sorted(os.walk(folder)):
        for name in sorted(set(names) - {"run.json"}):
            with open(os.path.join(at, name), "rb") as file:
                whole.update(os.path.relpath(file.name, folder).encode() + hashlib.sha256(file.read()).digest())
    return whole.hexdigest()


def middle(runs, of):
    """The median of what each run gives."""
    return statistics.median(of(run) for run in runs)


def main():
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("program")
    asked.add_argument("capture")
    asked.add_argument("--cores", type=int, nargs="+", default=[1, 2, 4, 8, 16])
    asked.add_argument("--runs", type=int, default=3)
    asked.add_argument("--json")
    asked = asked.parse_args()
    program = os.path.abspath(asked.program)
    runs = {cores: [run(program, asked.capture, cores) for _ in range(asked.runs)] for cores in asked.cores}
    few = runs[asked.cores[0]]
    print("| | " + " | ".join(map(str, asked.cores)) + " |\n|---" + "|---" * len(asked.cores) + "|")
    rows = {
        "by the clock, s": lambda run: run["clock"],
        "of the processor, s": lambda run: run["processor"],
        "first answer after, s": lambda run: sum(run["first"]),
    }
    for name, of in rows.items():
        print(f"| {name} | " + " | ".join(f"{middle(runs[c], of):.1f}" for c in asked.cores) + " |")
    gains = (middle(few, rows["by the clock, s"]) / middle(runs[c], rows["by the clock, s"]) for c in asked.cores)
    print("| times sooner | " + " | ".join(f"{gain:.1f}" for gain in gains) + " |")
    for name in few[0]["nodes"]:
        clocks = [middle(runs[c], lambda run: run["nodes"].get(name, (0.0, 0.0))[0]) for c in asked.cores]
        if max(clocks) >= 0.1:
            print(f"| `{name}` | " + " | ".join(f"{clock:.2f}" for clock in clocks) + " |")
    written = {run["written"] for of_some in runs.values() for run in of_some}
    print("the same bytes" if len(written) == 1 else f"{len(written)} different results")
    if asked.json:
        with open(asked.json, "w") as file:
            json.dump(runs, file)


if __name__ == "__main__":
    main()
