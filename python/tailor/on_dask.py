"""`tailor-dask`: what `tailor cluster submit --engine dask=ADDRESS` asks of a Dask scheduler.

One JSON object comes in: a verb (`submit`, `status`, `cancel`), the scheduler's address, the prefix of the plan's
tasks; for `submit` its tasks (key, strands, the keys of those that it waits for) and the command that works on
strands. One goes out. Dask carries keys, never results: those lie in the store.
"""

from __future__ import annotations

import json
import sys

PATIENCE_S = 20


def work(command, strands, *_after):
    """Runs on a worker, which needs the command and nothing else of ours."""
    import subprocess

    words = [strands if word == "{strands}" else word for word in command]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or ["nothing was said"]
        raise RuntimeError(f"strands {strands}: code {done.returncode}: {lines[-1]}")
    return strands


def states(prefix, dask_scheduler=None):
    """Runs on the scheduler: the state of each task of a plan."""
    tasks = dask_scheduler.tasks.items()
    return {key: task.state for key, task in tasks if isinstance(key, str) and key.startswith(prefix)}


def answer(asked, client):
    from distributed import Future, fire_and_forget

    there = client.run_on_scheduler(states, asked["prefix"])
    alive = {key for key, state in there.items() if state not in ("memory", "erred", "forgotten", "released")}
    if asked["verb"] == "status":
        counts = {}
        for state in there.values():
            counts[state] = counts.get(state, 0) + 1
        return {"states": counts}
    if asked["verb"] == "cancel":
        client.cancel([Future(key, client) for key in alive], force=True)
        return {"cancelled": len(alive)}
    fresh = {}
    for task in asked["tasks"]:
        key = task["key"]
        if key in alive:
            # Sent before, and still wanted: whoever was killed between two of these goes on where they were.
            continue
        reads = [other for other in task["after"] if other in fresh or other in alive]
        after = [fresh[other] if other in fresh else Future(other, client) for other in reads]
        fresh[key] = client.submit(work, asked["command"], task["strands"], *after, key=key, pure=False)
        fire_and_forget(fresh[key])
    # Sent in batches: asked anything, the scheduler has them all.
    client.run_on_scheduler(states, asked["prefix"])
    return {"sent": len(fresh)}


def main() -> int:
    asked = json.load(sys.stdin)
    try:
        import cloudpickle
        from distributed import Client
    except ImportError as why:
        print(f"Dask is missing ({why}): pip install distributed", file=sys.stderr)
        return 2
    # Workers need not have this package.
    cloudpickle.register_pickle_by_value(sys.modules[work.__module__])
    try:
        client = Client(asked["address"], timeout=PATIENCE_S, name="tailor")
    except (OSError, TimeoutError, ValueError) as why:
        print(f"no scheduler answers at {asked['address']}: {why}", file=sys.stderr)
        return 2
    with client:
        print(json.dumps(answer(asked, client)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
