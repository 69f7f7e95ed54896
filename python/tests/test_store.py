"""A store that machines share, on an S3 server (moto) behind a proxy that fails as it is told."""

import json
import os
import pathlib
import re
import socket
import subprocess
import sys
import threading
import time
import urllib.request

import pytest
from proxy import Proxy

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMAND = os.environ.get("TAILOR_COMMAND") or os.path.join(os.path.dirname(sys.executable), "tailor")
CELLS = "--sweep=true_body.cell_mm=50,45,40"
SWEEP = ["sweep", "pipelines/synth.toml", "--nodes", "true_body"]


def free_port():
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        return listening.getsockname()[1]


@pytest.fixture(scope="module")
def moto():
    port = free_port()
    words = [sys.executable, "-m", "moto.server", "-H", "127.0.0.1", "-p", str(port)]
    server = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    for _ in range(300):
        try:
            urllib.request.urlopen(f"http://127.0.0.1:{port}/moto-api/", timeout=1).read()
            break
        except OSError:
            time.sleep(0.1)
    yield port
    server.kill()
    server.wait()


@pytest.fixture
def proxy(moto):
    proxy = Proxy(moto)
    yield proxy
    proxy.shutdown()
    proxy.server_close()


COUNT = [0]


@pytest.fixture
def s3(proxy, tmp_path):
    """A bucket of its own; runs the command on a cache of a name, on it."""
    COUNT[0] += 1
    bucket = f"bucket{COUNT[0]}"
    made = urllib.request.Request(f"{proxy.url}/{bucket}", method="PUT")
    urllib.request.urlopen(made).read()
    proxy.well()
    return S3(proxy, bucket, tmp_path)


class S3:
    def __init__(self, proxy, bucket, folder):
        self.proxy, self.folder = proxy, folder
        self.address = f"s3://{bucket}/some/prefix"
        self.without = []

    def env(self, **more):
        env = {name: value for name, value in os.environ.items() if not name.startswith(("AWS_", "TAILOR_STORE"))}
        env.update(
            AWS_ENDPOINT_URL=self.proxy.url,
            AWS_ALLOW_HTTP="true",
            AWS_REGION="us-east-1",
            AWS_ACCESS_KEY_ID="a-key-id",
            AWS_SECRET_ACCESS_KEY="a-very-secret-key",
            **more,
        )
        return {name: value for name, value in env.items() if name not in self.without}

    def start(self, cache, *words, address=None, **env):
        words = [COMMAND, *words, f"--cache={self.folder / cache}", f"--store={address or self.address}"]
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        return subprocess.Popen(words, cwd=ROOT, env=self.env(**env), **pipes)

    def run(self, cache, *words, code=0, **more):
        process = self.start(cache, *words, **more)
        out, said = process.communicate(timeout=240)
        assert process.returncode == code, said
        assert "a-very-secret-key" not in out + said
        return out, said

    def sweep(self, cache, *more, cells=CELLS, **how):
        """How many results were made by the three points; what was said."""
        out, said = self.run(cache, *SWEEP, cells, "--json", *more, **how)
        points = json.loads(out)["points"]
        assert all(point["done"] for point in points)
        return sum(point["made"] for point in points), said

    def alone(self, cells=CELLS):
        """The results of a run that shares nothing, by name."""
        words = [COMMAND, *SWEEP, cells, "--json", f"--cache={self.folder / 'alone'}"]
        subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
        return self.blobs("alone")

    def blobs(self, cache):
        found = (self.folder / cache / "cas").glob("*/*")
        return {file.name: file.read_bytes() for file in found}

    def waits(self, cache):
        return len(list((self.folder / cache / "waiting").glob("*")))


def test_one_makes_another_finds_and_bytes_are_those_of_a_run_alone(s3):
    assert s3.sweep("a")[0] == 4
    assert s3.sweep("b")[0] == 0
    alone = s3.alone()
    assert s3.blobs("a") == alone
    assert all(alone[name] == bytes for name, bytes in s3.blobs("b").items())
    looked = json.loads(s3.run("b", "cache", "store", "--json")[0])
    assert looked["records"] == 4 and looked["creates_once"] is True
    # No secret in what lies in a store, nor anything that names the machine's keys.
    for file in s3.folder.rglob("*"):
        assert not file.is_file() or b"a-very-secret-key" not in file.read_bytes(), file


def test_a_tenth_of_all_answers_wrong_and_workers_side_by_side_lose_nothing(s3):
    s3.proxy.errors = s3.proxy.cuts = 0.05
    words = [*SWEEP, CELLS, "--json"]
    workers = [s3.start(f"w{n}", *words) for n in range(4)]
    for worker in workers:
        said = worker.communicate(timeout=240)[1]
        assert worker.returncode == 0, said
        assert "not deterministic" not in said and "believed" not in said, said
    s3.proxy.well()
    for n in range(4):
        s3.run(f"w{n}", "cache", "push")
        assert s3.waits(f"w{n}") == 0
    assert s3.sweep("fresh")[0] == 0
    alone = s3.alone()
    assert all(alone[name] == bytes for name, bytes in s3.blobs("fresh").items())


def test_a_server_that_is_gone_is_told_and_what_waits_goes_there_later(s3):
    s3.sweep("a", cells="--sweep=true_body.cell_mm=30")
    s3.proxy.gone = True
    began = time.time()
    made, said = s3.sweep("a", "--store-wait=1")
    assert made == 3 and "going on without it" in said and "waits in the cache" in said, said
    # What was found may have to go there, too: nobody could ask.
    assert s3.waits("a") in (3, 4) and time.time() - began < 60
    s3.proxy.well()
    said = s3.run("a", "cache", "push")[1]
    assert "3 results uploaded" in said and s3.waits("a") == 0
    assert s3.sweep("b")[0] == 0


def test_a_strand_is_not_done_before_its_results_are_there(s3):
    plan = json.loads(s3.run("a", *SWEEP, CELLS, "--strands", "--json")[0])["plan"]
    s3.proxy.answer = (507, "<Error><Code>QuotaExceeded</Code></Error>")
    said = s3.run("b", "work", "--plan", plan, "--strand", "0", "--store-wait=1", code=1)[1]
    assert "quota is full" in said, said
    s3.proxy.well()
    # Gone for some seconds: waited for.
    s3.proxy.gone = True
    threading.Timer(3, s3.proxy.well).start()
    s3.run("b", "work", "--plan", plan, "--strand", "0")
    assert s3.waits("b") == 0
    s3.run("c", "work", "--plan", plan, "--strand", "1-3")
    status = json.loads(s3.run("d", "status", plan, "--json")[0])
    assert status["done"] is True
    assert s3.sweep("e")[0] == 0


def test_a_store_that_lies_is_not_believed(s3):
    # Results that do not ride in records.
    cells = "--sweep=true_body.cell_mm=14,15"
    s3.sweep("a", cells=cells)
    s3.proxy.lies = True
    made, said = s3.sweep("b", cells=cells)
    assert made > 0 and "not believed" in said, said
    alone = s3.alone(cells)
    assert all(alone[name] == bytes for name, bytes in s3.blobs("b").items())


def test_a_worker_killed_while_it_uploads_loses_nothing(s3):
    # Results that do not ride in records.
    cells = "--sweep=true_body.cell_mm=14,15"
    for moment in ["/cas/", "/ac/"]:
        cache = "killed" + moment.strip("/")
        s3.address += moment.strip("/")
        s3.proxy.hold, s3.proxy.requests = moment, []
        worker = s3.start(cache, *SWEEP, cells, "--json")

        def held(moment=moment):
            # What all points share is small and rides in its record: that is not the one meant.
            puts = [path for method, path in s3.proxy.requests if method == "PUT" and moment in path]
            return len(puts) >= (2 if moment == "/ac/" else 1)

        while not held():
            assert worker.poll() is None
            time.sleep(0.02)
        worker.kill()
        worker.communicate()
        there = {path for method, path in s3.proxy.requests if method == "PUT" and "/ac/" in path}
        assert moment == "/ac/" or len(there) <= 1, "no record before its blob"
        waits = s3.waits(cache)
        s3.proxy.well()
        s3.sweep(cache, cells=cells)
        assert waits > 0 and s3.waits(cache) == 0
        looked = json.loads(s3.run(cache, "cache", "store", "--json")[0])
        assert looked["records"] == 3
    made, said = s3.sweep("fresh", cells=cells)
    alone = s3.alone(cells)
    assert made == 0 and all(alone[name] == bytes for name, bytes in s3.blobs("fresh").items()), said


def test_what_strangers_wrote_is_not_used(s3):
    def keygen(name, code=0):
        return s3.run("a", "cache", "keygen", str(s3.folder / name), code=code)

    public = json.loads(s3.run("a", "cache", "keygen", str(s3.folder / "lab"), "--json")[0])["public"]
    keygen("eve")
    assert "exists" in keygen("eve", code=2)[1]
    (s3.folder / "trusted").write_text(f"# ours\n{public}\n")
    lab, eve, trust = (f"--{word}={s3.folder / name}" for word, name in
                       [("sign-key", "lab"), ("sign-key", "eve"), ("trust", "trusted")])
    assert s3.sweep("a", lab)[0] == 4
    made, said = s3.sweep("b", trust)
    assert made == 0 and "not signed" not in said
    # What somebody else wrote is not used, and written over by who is trusted.
    more = "--sweep=true_body.cell_mm=50,30"
    assert s3.sweep("c", eve, cells=more)[0] == 1
    made, said = s3.sweep("d", trust, cells=more)
    assert made == 1 and said.count("is not signed by anybody") == 1, said
    assert s3.sweep("e", cells=more)[0] == 0, "who asks for no signature takes it"
    s3.sweep("d", trust, lab, cells=more)
    assert s3.sweep("f", trust, cells=more)[0] == 0
    # Files that are no keys.
    secret = (s3.folder / "lab").read_text().splitlines()[1]
    (s3.folder / "lab").chmod(0o644)
    said = s3.run("a", *SWEEP, CELLS, lab, code=2)[1]
    assert "other users may read" in said and secret not in said
    (s3.folder / "trusted").write_text("# nobody\n")
    assert "no public key" in s3.run("a", *SWEEP, CELLS, trust, code=2)[1]


def test_a_profile_tells_who_asks(s3):
    aws = s3.folder / "aws"
    aws.write_text(
        "[lab]\naws_access_key_id = a-key-id\naws_secret_access_key = a-very-secret-key\n"
        "[away]\nsso_session = a-very-secret-key\n"
    )
    config = s3.folder / "config"
    config.write_text(f"[profile lab]\nregion = us-east-1\nendpoint_url = {s3.proxy.url}\n")
    env = {"AWS_SHARED_CREDENTIALS_FILE": str(aws), "AWS_CONFIG_FILE": str(config)}
    env |= {"AWS_ACCESS_KEY_ID": "", "AWS_SECRET_ACCESS_KEY": "", "AWS_REGION": "", "AWS_ENDPOINT_URL": ""}
    for name in [name for name, value in env.items() if not value]:
        s3.without.append(name)
    env = {name: value for name, value in env.items() if value}
    assert s3.sweep("a", AWS_PROFILE="lab", **env)[0] == 4
    assert s3.sweep("b", AWS_PROFILE="lab", **env)[0] == 0
    said = s3.run("c", *SWEEP, CELLS, AWS_PROFILE="away", code=2, **env)[1]
    assert "signs on by SSO (sso_session)" in said and "export-credentials" in said, said
    said = s3.run("c", *SWEEP, CELLS, AWS_PROFILE="none", code=2, **env)[1]
    assert "AWS_PROFILE=none" in said, said


def test_a_plan_s_state_is_asked_once(s3):
    cells = "--sweep=true_body.cell_mm=" + ",".join(str(n) for n in range(20, 50))
    plan = json.loads(s3.run("a", *SWEEP, cells, "--strands", "--json")[0])["plan"]
    s3.run("a", "work", "--plan", plan, "--strand", "0-30")
    s3.proxy.requests = []
    assert json.loads(s3.run("b", "status", plan, "--json")[0])["done"] is True
    # Whose store it is, the plan, the listing, and the one record that all others read.
    asked = [path for method, path in s3.proxy.requests]
    assert len(asked) <= 6, asked


def test_what_is_wrong_is_told(s3):
    said = s3.run("a", *SWEEP, CELLS, address="s3://no-such-bucket/p", code=2)[1]
    assert "no such bucket" in said, said
    said = s3.run("a", *SWEEP, CELLS, address="s3://key:secret@bucket/p", code=2)[1]
    assert "environment" in said and "key:secret" not in said, said
    for address in ["bucket", "ftp://x/y", "s3://"]:
        assert "its address is none" in s3.run("a", *SWEEP, CELLS, address=address, code=2)[1]
    assert "no store yet" in s3.run("a", *SWEEP, CELLS, "--store-read-only", code=2)[1]
    s3.proxy.answer = (403, "<Error><Code>AccessDenied</Code></Error>")
    assert "credentials" in s3.run("a", *SWEEP, CELLS, code=2)[1]
    s3.proxy.answer = (403, "<Error><Code>RequestTimeTooSkewed</Code></Error>")
    assert "clock" in s3.run("a", *SWEEP, CELLS, code=2)[1]


def test_the_book_names_tests_that_are_there():
    named = set(re.findall(r"`(test_\w{20,})`", (ROOT / "docs/lab/cluster.md").read_text()))
    there = "".join(file.read_text() for file in (ROOT / "python/tests").glob("test_*.py"))
    assert len(named) > 5 and [name for name in named if f"def {name}(" not in there] == []


def test_a_folder_that_machines_share(s3):
    there = s3.folder / "shared disk"
    there.mkdir()
    address = f"file://{there}"
    assert s3.sweep("a", address=address)[0] == 4
    assert s3.sweep("b", address=address)[0] == 0
    assert "no folder" in s3.run("a", *SWEEP, CELLS, address="file:///no/such/folder", code=2)[1]


def test_a_sweep_that_is_made_asks_once_and_one_from_afar_once_a_record(s3):
    count = int(os.environ.get("TAILOR_POINTS", "40"))
    cells = "--sweep=true_body.cell_mm=" + ",".join(f"{40 + n * 10 / count:.2f}" for n in range(count))

    def swept(cache):
        s3.proxy.requests = []
        began = time.time()
        made = s3.sweep(cache, cells=cells)[0]
        print(f"{count} points: {made} made in {time.time() - began:.2f} s with {len(s3.proxy.requests)} requests")
        return made, len(s3.proxy.requests)

    assert swept("a")[0] == count + 1
    assert swept("a") == (0, 1)
    made, requests = swept("b")
    assert made == 0 and requests <= count + 30
