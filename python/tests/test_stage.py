"""Functions as stages: in the key, kept for the run, and every way in which they fail."""

import os
import subprocess
import sys
import time

import numpy
import pytest

import tailor
from conftest import COMMAND, DOLL
from tailor import worker

SHARE = 0.5


def smaller(mask, share):
    return mask > 255 * share


@tailor.stage(out="masks")
def cut(masks, share=0.5, rows=0):
    """Masks without their border, and without rows at the top."""
    made = {}
    for photo, mask in masks.items():
        made[photo] = smaller(mask, share * 2 * SHARE)
        made[photo][:rows] = False
    return made


@tailor.stage(out="mesh")
def moved(mesh, by=10.0, axis="z"):
    vertices = mesh.vertices + by * (numpy.arange(3) == "xyz".index(axis))
    return vertices, mesh.faces


@tailor.stage(out="document")
def table(cameras, girths, decimals=2):
    rows = [f"{g['name']},{g['cm']:.{decimals}f}" for g in girths["girths"]]
    # Numbers of processes are equal in all sandboxes; when one started is not (proc(5), stat, field 22).
    started = open("/proc/self/stat").read().split()[21]
    return "girths.csv", "\n".join(["name,cm", *rows, f"cameras,{len(cameras)}", f"started,{started}"])


@tailor.stage(out="mesh")
def raises(mesh):
    return mesh.vertices / {}["nothing"], mesh.faces


@tailor.stage(out="mesh")
def nothing(mesh):
    pass


@tailor.stage(out="mesh")
def other(mesh):
    return "a mesh"


@tailor.stage(out="mesh")
def nan(mesh):
    return mesh.vertices * float("nan"), mesh.faces


@tailor.stage(out="mesh", timeout_s=3)
def forever(mesh):
    while True:
        time.sleep(1)


@tailor.stage(out="mesh")
def forks(mesh):
    if not os.fork():
        time.sleep(60)
    return mesh


@tailor.stage(out="mesh")
def dies(mesh):
    os._exit(3)


@tailor.stage(out="mesh", memory_mb=150)
def hoards(mesh):
    held = numpy.ones(100_000_000)
    time.sleep(3)
    return mesh.vertices * held[0], mesh.faces


def test_a_stage_is_a_function_as_before():
    assert list(cut({0: numpy.full((2, 2), 255)})) == [0]
    assert repr(cut) == "<Stage cut(masks, share, rows) → masks>" and "border" in cut.__doc__


def test_a_stage_is_a_node_as_any_other(doll, shown):
    mine = doll.add("less", cut, masks="masks", rows=60)
    run = mine.run("less", progress=False)
    assert run.made == ["less"]
    for photo, mask in shown["masks"].items():
        wants = mask > 127.5
        wants[:60] = False
        assert ((run["less"][photo] == 255) == wants).all()
    assert mine.run("less", progress=False).made == []
    assert mine.set("less.rows", 61).run("less", progress=False).made == ["less"]
    states = {row["node"]: row["state"] for row in mine.set("less.rows", 61).plan("less", kind="dicts")}
    assert states["less"] == "cached"


def test_a_stage_in_place_of_a_node(doll, shown):
    run = doll.add("lifted", moved, mesh="carved", by=25).run("lifted", progress=False)
    assert numpy.allclose(run["lifted"].vertices - shown["carved"].vertices, [0, 0, 25], atol=1e-3)
    aside = doll.add("lifted", moved, mesh="carved", by=25, axis="x").run("lifted", progress=False)
    assert numpy.allclose(aside["lifted"].vertices - shown["carved"].vertices, [25, 0, 0], atol=1e-3)


def test_the_source_is_in_the_key_with_all_that_it_uses(doll, monkeypatch):
    assert "def smaller(mask, share):" in cut.source and "SHARE = 0.5" in cut.source
    assert f"# numpy {numpy.__version__}" in moved.source and "import numpy" in moved.source
    assert "@" not in cut.source
    assert cut.source.startswith(f"# {sys.implementation.name} {sys.version_info.major}.{sys.version_info.minor}\n")
    before = doll.add("less", cut).run("less", progress=False)
    monkeypatch.setitem(globals(), "SHARE", 0.25)
    again = tailor.stage(out="masks")(cut.function)
    assert "SHARE = 0.25" in again.source
    run = doll.add("less", again).run("less", progress=False)
    assert run.made == ["less"] and "less" in before
    monkeypatch.setitem(globals(), "__version__", "3.1")
    assert "# test_stage 3.1" in tailor.stage(out="masks")(cut.function).source


def test_a_worker_a_thread_serves_all_points_of_a_sweep(doll):
    mine = doll.add("told", table, cameras="cameras", girths="girths_formula")
    mine.run("girths_formula", progress=False)
    one, two = (mine.set("told.decimals", n) for n in (4, 5))
    start = time.perf_counter()
    mine.sweep(over={"told.decimals": list(range(6, 26))}, nodes=["told"], progress=False)
    each = (time.perf_counter() - start) / 20
    pids = {mine.set("told.decimals", n).run("told", progress=False)["told"].frame("dicts")[-1]["cm"] for n in range(6, 26)}
    assert len(pids) <= os.cpu_count()
    run = [p.run("told", progress=False)["told"].frame("dicts")[-1]["cm"] for p in (one, two)]
    assert run[0] != run[1] and not set(run) & pids
    print(f"a point of a stage in Python: {each * 1e3:.0f} ms")


@pytest.mark.parametrize("head, place", [("", "line 2 of mine.py, in half"), ("# cpython 3.12\n\n", "in half")])
def test_an_error_names_the_line_and_only_a_file_that_the_user_wrote(tmp_path, head, place):
    file = tmp_path / "mine.py"
    file.write_text(f"{head}def half(x=1):\n    return x / 0\n")
    with pytest.raises(ZeroDivisionError) as error:
        worker._function(f"{file}:half")()
    assert worker._told(error.value) == f"ZeroDivisionError: division by zero ({place}: `return x / 0`)"


@pytest.mark.parametrize(
    "stage, told",
    [
        (raises, '(in raises: `return mesh.vertices / {}["nothing"], mesh.faces`)'),
        (nothing, "gave nothing back"),
        (other, "a pair of vertices and faces"),
        (nan, "(NaN or infinite)"),
        (forever, "ended after 3 s"),
        (forks, "left processes behind"),
        (dies, "no answer"),
        (hoards, "more than 150 MB"),
    ],
)
def test_a_stage_that_fails_is_told_and_not_kept(doll, stage, told):
    mine = doll.add("wrong", stage, mesh="carved")
    for _ in range(2):
        with pytest.raises(tailor.Error) as error:
            mine.run("wrong", progress=False)
        assert told in str(error.value) and error.value.code == 1
        assert error.value.failures[0][0] == "wrong"
        if stage is forever:
            break
    assert doll.add("right", moved, mesh="carved").run("right", progress=False)["right"].faces.shape[1] == 3


def test_nothing_of_a_worker_stays(doll, cache):
    doll.add("less", cut, rows=7).run("less", progress=False)
    assert list((cache / "exec").iterdir()) == []
    mine = subprocess.run(["ps", "-o", "args", "--ppid", str(os.getpid())], capture_output=True, text=True).stdout
    assert "tailor-stage" not in mine


def test_the_command_runs_it_too(doll, cache, tmp_path):
    mine = doll.add("less", cut, rows=33)
    made = mine.run("less", progress=False)
    file = mine.save(tmp_path)
    path = os.path.dirname(COMMAND) + os.pathsep + os.environ["PATH"]
    words = [COMMAND, "run", str(file), "less", "--json", "--allow-exec", f"--cache={cache}"]
    done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "PATH": path})
    assert done.returncode == 0, done.stderr
    assert '"made"' not in done.stdout and "less" in made
    words = [*words[:4], "--set=less.rows=34", *words[4:]]
    done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "PATH": path})
    assert done.returncode == 0 and '"status": "made"' in done.stdout, done.stderr
    assert mine.set("less.rows", 34).run("less", progress=False).made == []


def test_what_is_no_stage_is_told(doll):
    held = object()

    def uses(mesh):
        return held

    def takes(mesh, *more):
        return mesh

    def defaults(mesh, size=None):
        return mesh

    for function, told in [(uses, "uses `held`, a object"), (takes, r"takes \*more"), (defaults, "default of `size`")]:
        with pytest.raises(tailor.Error, match=told):
            tailor.stage(out="mesh")(function)
    with pytest.raises(tailor.Error, match="not `girths`"):
        tailor.stage(out="girths")(takes)
    with pytest.raises(tailor.Error, match="name what it makes"):
        tailor.stage(takes)
    with pytest.raises(tailor.Error, match="cannot be read"):
        tailor.stage(out="mesh")(eval("lambda mesh: mesh"))
    with pytest.raises(tailor.Error, match="no node `mesh`"):
        doll.add("a", moved)
    with pytest.raises(tailor.Error, match="no argument `size`"):
        doll.add("a", moved, mesh="body", size=3)
    with pytest.raises(tailor.Error, match="cannot be read in Python"):
        doll.add("a", moved, mesh="keypoints")
    with pytest.raises(tailor.Error, match="no name"):
        doll.add("a b", moved, mesh="body")
    assert str(DOLL).endswith(".toml")
