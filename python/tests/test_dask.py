"""A plan on Dask: a cluster of this machine, a worker that is killed."""

import json
import os
import pathlib
import subprocess
import sys
import time

import pytest

distributed = pytest.importorskip("distributed")

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMAND = os.environ.get("TAILOR_COMMAND") or os.path.join(os.path.dirname(sys.executable), "tailor")
PIPELINE = """goal = "x"
[node.base]
stage = "exec"
out = "document"
with = { b = 0 }
command = ["sh", "-c", "echo base $2 > $1/a.txt", "sh", "{out}", "{with.b}"]
[node.x]
stage = "exec"
out = "document"
from = { base = "base" }
with = { n = 0 }
command = ["sh", "-c", "sleep 1; test $2 != 13 && cat $3 > $1/a.txt && echo $2 >> $1/a.txt", "sh", "{out}", "{with.n}", "{from.base}"]
"""


def tailor(cache, *words, code=0):
    words = [COMMAND, *words, "--json", f"--cache={cache}"]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, timeout=240)
    assert done.returncode == code, done.stdout + done.stderr
    return json.loads(done.stdout)


def sweep(folder, over):
    file = folder / "x.toml"
    file.write_text(PIPELINE)
    return ["sweep", str(file), "--nodes", "x", f"--sweep=x.n={over}", "--allow-exec"]


def blobs(cache):
    return {file.name: file.read_bytes() for file in (cache / "cas").glob("*/*")}


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """A scheduler in this process, and two workers that nobody starts again once they are killed."""
    folder = tmp_path_factory.mktemp("workers")
    with distributed.LocalCluster(n_workers=0, processes=True, dashboard_address=None) as cluster:
        words = [sys.executable, "-m", "distributed.cli.dask_worker", cluster.scheduler_address]
        words += ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", str(folder)]
        logs = [open(folder / f"{i}.log", "w") for i in range(2)]
        cluster.hands = [subprocess.Popen(words, stdout=log, stderr=log) for log in logs]
        try:
            with distributed.Client(cluster.scheduler_address) as client:
                client.wait_for_workers(2, timeout=120)
            yield cluster
        finally:
            for hand, log in zip(cluster.hands, logs):
                hand.kill()
                hand.wait()
                log.close()
                # Shown by pytest where a test failed.
                print(pathlib.Path(log.name).read_text()[-2000:])


def settled(cache, plan, engine):
    """The status once nothing works on the plan any more, and its exit code."""
    idle = 0
    for _ in range(200):
        words = [COMMAND, "status", plan, engine, "--json", f"--cache={cache}"]
        said = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, timeout=120)
        status = json.loads(said.stdout.splitlines()[0])
        idle = 0 if status["alive"] else idle + 1
        # A task whose worker was killed is nobody's for a moment.
        if status["done"] or idle > 3:
            return status, said.returncode
        time.sleep(0.3)
    raise AssertionError(status)


def test_a_plan_on_dask_comes_to_what_it_does_here_though_a_worker_is_killed(cluster, tmp_path):
    cache, alone = tmp_path / "cache", tmp_path / "alone"
    engine = f"--engine=dask={cluster.scheduler_address}"
    points = sweep(tmp_path, "1,2,3,4,5,6")
    plan = tailor(cache, *points, "--strands")["plan"]
    sent = tailor(cache, "submit", plan, engine, "--least-s=0")
    assert (sent["tasks"], sent["sent"]) == (7, 7)
    # Said again while it runs: what waits or runs is not sent twice; what ended while it was asked is found.
    assert tailor(cache, "submit", plan, engine, "--least-s=0")["sent"] < 7
    time.sleep(1)
    cluster.hands[0].kill()
    status, code = settled(cache, plan, engine)
    assert (code, status["strands"], status["strands_done"]) == (0, 7, 7)
    logs = [file.read_text().splitlines() for file in (cache / "runs").glob("*.jsonl")]
    made = sum('"event":"done"' in line and '"made"' in line for log in logs for line in log)
    assert made in (7, 8), "each once; the killed worker's perhaps once more"
    swept = tailor(cache, *points)
    assert sum(point["made"] for point in swept["points"]) == 0
    tailor(alone, *points)
    assert blobs(cache) == blobs(alone)
    assert tailor(cache, "submit", plan, engine)["tasks"] == 0


def test_a_strand_that_fails_fails_what_reads_it_alone_and_is_sent_again(cluster, tmp_path):
    cache = tmp_path / "cache"
    engine = f"--engine=dask={cluster.scheduler_address}"
    plan = tailor(cache, *sweep(tmp_path, "1,13"), "--strands")["plan"]
    tailor(cache, "submit", plan, engine, "--least-s=0")
    status, code = settled(cache, plan, engine)
    assert (code, status["done"], status["strands_done"]) == (1, False, 2), status
    assert tailor(cache, "submit", plan, engine, "--least-s=0")["sent"] == 1
    tailor(cache, "cancel", plan, engine)


def test_no_scheduler_and_no_address_are_told(tmp_path):
    cache = tmp_path / "cache"
    plan = tailor(cache, *sweep(tmp_path, "1,2"), "--strands")["plan"]
    for engine, told in [("dask=tcp://127.0.0.1:9", "no scheduler answers"), ("dask=", "give slurm"), ("x", "give slurm")]:
        words = [COMMAND, "submit", plan, f"--engine={engine}", f"--cache={cache}"]
        said = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, timeout=120)
        assert said.returncode == 2 and told in said.stderr, said.stderr
