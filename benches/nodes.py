"""What each node takes of the processor, by two programs in turns on the same machine.

    python3 benches/nodes.py BEFORE NOW CAPTURE [--runs 3] [--json FILE]

BEFORE and NOW are programs (`tailor` of two commits), CAPTURE a folder of photos. Each run begins with an empty cache. Of
each node the least of all runs counts: where other programs share the cores, a run takes more than it needs, never less.
A node beside which another runs has an even share of what both take. Last come the whole process and its most memory.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time

# What is measured of a process: its name in the table, and in the file.
WHOLE = [
    ("whole process, s", "process_s"),
    ("by the clock, s", "clock_s"),
    ("most memory, MB", "memory_mb"),
    ("first answer after, s", "first_s"),
]


def run(program, capture):
    """Seconds of the processor by node; of the process: those, by the clock, its most memory in MB, its first answer after."""
    with tempfile.TemporaryDirectory() as place:
        trace = os.path.join(place, "trace.json")
        command = [program, "measure", capture, "--profile", trace]
        command += ["--cache", os.path.join(place, "cache"), "--out", os.path.join(place, "out")]
        start, first = time.monotonic(), math.nan
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        for line in child.stderr:
            if line.startswith("first answer"):
                first = time.monotonic() - start
        _, status, used = os.wait4(child.pid, 0)
        whole = time.monotonic() - start
        if status != 0:
            sys.exit(f"{program} failed on {capture}")
        with open(trace) as file:
            events = json.load(file)["traceEvents"]
    return by_node(events), used.ru_utime + used.ru_stime, whole, used.ru_maxrss / 1024, first


def by_node(events):
    """Seconds of the processor by node, from a trace; earlier programs have them as a curve alone."""
    spans = [e for e in events if e["ph"] == "X" and e["name"] == e["cat"]]
    if all("args" in e for e in spans):
        nodes = {}
        for e in spans:
            nodes[e["name"]] = nodes.get(e["name"], 0.0) + (e["args"]["processor_s"] or 0.0)
        return nodes
    spans = [(e["name"], e["ts"], e["ts"] + e["dur"]) for e in spans]
    busy = [e for e in events if e["ph"] == "C" and e["name"] == "threads busy"]
    busy = [(e["ts"], e["args"]["value"]) for e in busy]
    nodes = {}
    for (start, threads), (end, _) in zip(busy, busy[1:]):
        middle = (start + end) / 2
        running = list(dict.fromkeys(n for n, a, b in spans if a <= middle < b)) or ["beside all nodes"]
        for node in running:
            nodes[node] = nodes.get(node, 0.0) + threads * (end - start) / len(running) / 1e6
    return nodes


def least(runs):
    """The least of all runs, node by node."""
    names = list(dict.fromkeys(name for nodes, *_ in runs for name in nodes))
    nodes = {name: min(nodes.get(name, 0.0) for nodes, *_ in runs) for name in names}
    return {"nodes": nodes} | {key: min(run[i + 1] for run in runs) for i, (_, key) in enumerate(WHOLE)}


def main():
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("before")
    asked.add_argument("now")
    asked.add_argument("capture")
    asked.add_argument("--runs", type=int, default=3)
    asked.add_argument("--json")
    asked = asked.parse_args()
    programs = [os.path.abspath(asked.before), os.path.abspath(asked.now)]
    runs = {program: [] for program in programs}
    for _ in range(asked.runs):
        for program in programs:
            runs[program].append(run(program, asked.capture))
    before, now = (least(runs[program]) for program in programs)
    print("| node | before, s | now, s | |\n|---|---|---|---|")
    for name in list(dict.fromkeys([*before["nodes"], *now["nodes"]])):
        a, b = before["nodes"].get(name, 0.0), now["nodes"].get(name, 0.0)
        if max(a, b) >= 0.1:
            print(f"| `{name}` | {a:.1f} | {b:.1f} | {b / max(a, 1e-9):.2f} |")
    for name, key in WHOLE:
        print(f"| {name} | {before[key]:.1f} | {now[key]:.1f} | {now[key] / before[key]:.2f} |")
    if asked.json:
        with open(asked.json, "w") as file:
            json.dump({"before": before, "now": now, "runs": asked.runs}, file, indent=1)


if __name__ == "__main__":
    main()
