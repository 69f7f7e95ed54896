"""Pipelines: set, planned, run, swept; one cache with the command."""

import threading
import time

import pytest

import tailor
from conftest import DOLL


def test_what_the_command_made_python_finds_and_the_other_way_round(doll, command):
    mine = doll.set("body.cell_mm", 7)
    command("run", str(DOLL), "carved", "--set", "body.cell_mm=7")
    run = mine.run("carved", progress=False)
    assert run.made == [] and "carved" in run.found
    other = doll.set({"body.cell_mm": 8.0})
    made = other.run("carved", progress=False).made
    assert "carved" in made and "body" in made
    told = command("run", str(DOLL), "carved", "--set", "body.cell_mm=8", "--json").stdout
    assert '"made"' not in told


def test_threads_are_in_no_key(cache):
    one = tailor.Pipeline(DOLL, cache=cache, threads=1).set("body.cell_mm", 9).run("carved", progress=False)
    two = tailor.Pipeline(DOLL, cache=cache, threads=3).set("body.cell_mm", 9).run("carved", progress=False)
    assert "carved" in one.made and two.made == []


def test_a_pipeline_is_not_changed_by_a_change_of_it(doll):
    other = doll.set(body={"cell_mm": 20}).input("x", "y").variant("z")
    assert doll._sets == [] and other._sets == ["body.cell_mm=20"]
    assert (doll._inputs, doll._variant) == ({}, None)


def test_a_plan_says_what_would_run_and_why(doll):
    doll.run("body", progress=False)
    rows = {row["node"]: row for row in doll.plan("body", kind="dicts")}
    assert rows["body"]["state"] == "cached"
    rows = {row["node"]: row for row in doll.set("body.cell_mm", 6.5).plan("body", kind="dicts")}
    assert rows["body"]["state"] == "will run" and "6.0 → 6.5" in rows["body"]["why"]


def test_nodes_inputs_and_goal_are_told(doll):
    nodes = {n["node"]: n for n in doll.nodes}
    assert nodes["body"]["kind"] == "mesh" and nodes["body"]["from"] == {"solid": "solid"}
    assert nodes["body"]["params"]["cell_mm"] == "6.0"
    body = tailor.Pipeline("body")
    assert body.goal == ["girths", "masks", "report"] and body.inputs[0]["name"] == "photos"
    assert "body" in tailor.pipelines() and body.about


@pytest.mark.parametrize(
    "change, told",
    [
        (lambda p: p.set("body.cel_mm", 1), "cell_mm"),
        (lambda p: p.set("bdy.cell_mm", 1), "body"),
        (lambda p: p.set("body.cell_mm", "much"), "cell_mm"),
        (lambda p: p.set("body.cell_mm", -1), "cell_mm"),
        (lambda p: p.set("body.cell_mm", float("nan")), "finite"),
        (lambda p: p.set("body", 1), "NODE.PARAM"),
        (lambda p: p.set("body.cell_mm"), "say set"),
        (lambda p: p.set("body.cell_mm", object()), "of type object"),
        (lambda p: p.variant("none"), "none"),
        (lambda p: p.input("photo", "/"), "photo"),
        (lambda p: tailor.Pipeline("bodi"), "built-in pipelines are"),
        (lambda p: tailor.Pipeline("body").input("photos", "/nowhere"), "/nowhere"),
        (lambda p: tailor.Pipeline("body"), "photos"),
        (lambda p: tailor.Pipeline(DOLL, cache="/dev/null/x"), "/dev/null/x"),
        (lambda p: tailor.Pipeline(DOLL, threads=0), "threads=0"),
    ],
)
def test_what_is_wrong_is_told_before_anything_runs(doll, tmp_path, change, told):
    with pytest.raises(tailor.Error) as error:
        pipeline = change(doll)
        if pipeline._cache.endswith("cache"):
            pipeline._cache = str(tmp_path / "cache")
        pipeline.run(progress=False)
    assert told in str(error.value) and error.value.code == 2


def test_a_node_that_there_is_not(doll):
    with pytest.raises(tailor.Error, match="carved"):
        doll.run("carvd", progress=False)


def test_a_stage_that_fails_is_told_with_its_node(doll):
    with pytest.raises(tailor.Error) as error:
        doll.set("carved.voxel_mm", 50).run("carved", progress=False)
    assert error.value.code == 1
    assert [node for node, _ in error.value.failures] == ["carved"]
    run = doll.set("carved.voxel_mm", 50).run("carved", "mat", progress=False, keep_going=True)
    assert [node for node, _ in run.failures] == ["carved"] and "mat" in run and "carved" not in run


def test_a_cache_of_another_version_is_refused(tmp_path):
    (tmp_path / "format").write_text("tailor store 99\n")
    with pytest.raises(tailor.Error, match="99|layout|version"):
        tailor.Pipeline(DOLL, cache=tmp_path).run("mat", progress=False)
    assert (tmp_path / "format").read_text() == "tailor store 99\n"


def test_a_sweep_is_a_frame(doll):
    import pandas

    table = doll.sweep(over={"body.cell_mm": [10, 12.0]}, tell=["body.volume", "body.faces"], nodes=["body"], progress=False)
    assert isinstance(table, pandas.DataFrame)
    assert list(table["body.cell_mm"]) == [10.0, 12.0]
    assert table["body.faces"][0] > table["body.faces"][1] and table["trouble"].isna().all()
    again = doll.sweep(over={"body.cell_mm": "10,12"}, tell=["body.volume"], nodes=["body"], kind="dicts", progress=False)
    assert [row["made"] for row in again] == [0, 0]
    assert again[0]["body.volume"] == table["body.volume"][0]


def test_a_point_that_fails_has_its_trouble(doll):
    rows = doll.sweep(over={"carved.voxel_mm": [6, 50]}, nodes=["carved"], kind="dicts", progress=False)
    assert rows[0]["trouble"] is None and "carved failed" in rows[1]["trouble"]


def test_a_sweep_that_cannot_be_is_told(doll):
    for wrong in [dict(name="cell"), dict(), dict(over={"body.cel_mm": [1]}), dict(over={"body.cell_mm": []})]:
        with pytest.raises(tailor.Error):
            doll.sweep(progress=False, **wrong)
    with pytest.raises(tailor.Error, match="pandas, polars, dicts"):
        doll.plan("mat", kind="excel")


def test_progress_is_heard(doll):
    heard = []
    doll.set("body.cell_mm", 11).run("carved", progress=heard.append)
    assert all(isinstance(event, tailor.Event) for event in heard)
    what = [(event.what, event.node) for event in heard]
    assert ("started", "body") in what and ("made", "body") in what
    assert what.index(("started", "body")) < what.index(("made", "body"))
    heard.clear()
    doll.sweep(over={"body.cell_mm": [11, 13]}, nodes=["body"], progress=heard.append)
    assert [e.done for e in heard if e.what == "point"] == [1, 2]


def test_a_bar_of_tqdm(doll, capsys):
    doll.run("carved", progress=True)
    assert "node" in capsys.readouterr().err


def test_an_exception_of_the_listener_stops_the_run(doll):
    def hear(event):
        raise ZeroDivisionError(event.node)

    with pytest.raises(ZeroDivisionError):
        doll.set("body.cell_mm", 5).run("carved", progress=hear)


def test_python_goes_on_while_it_runs(doll):
    count, ended = [0], threading.Event()

    def work():
        doll.set("body.cell_mm", 3.1).run("carved", progress=False)
        ended.set()

    thread = threading.Thread(target=work)
    thread.start()
    start = time.time()
    while not ended.is_set():
        count[0] += 1
        time.sleep(0.002)
    thread.join()
    # Who holds the interpreter's lock lets nobody count.
    assert count[0] > 20 * (time.time() - start)


def test_two_runs_side_by_side(doll):
    made = []

    def work():
        made.append(doll.set("body.cell_mm", 14).run("carved", progress=False).made)

    threads = [threading.Thread(target=work) for _ in range(2)]
    [t.start() for t in threads]
    [t.join() for t in threads]
    assert sorted(("carved" in m) for m in made) == [False, True]
