"""Sweeps as flat tables: replicates, comparisons of them, girths."""

import statistics

import pytest

import tailor

# A hull of a cylinder out of silhouettes whose borders err.
HULLS = """
goal = "hull"
[node.solid]
stage = "synth.solid"
with = { figure = "cylinder", stature_mm = 300.0, wide_mm = 90.0, deep_mm = 70.0 }
[node.body]
stage = "synth.body"
from = ["solid"]
with = { cell_mm = 15.0 }
[node.ring]
stage = "synth.ring"
with = { views = 6, width = 48, height = 64, distance_mm = 900.0, camera_mm = 300.0, look_mm = 150.0, disk_mm = 150.0 }
[node.masks]
stage = "synth.masks"
from = { mesh = "body", cameras = "ring" }
with = { rays = 1 }
[node.seen]
stage = "synth.jitter"
from = ["masks"]
with = { border_px = 0.2, length_px = 8.0 }
[node.hull]
stage = "hull.carve"
from = { masks = "seen", cameras = "ring" }
with = { voxel_mm = 12.0 }
[variant.fine]
with.seen = { border_px = 0.2 }
[variant.worse]
with.seen = { border_px = 2.0 }
[sweep.hulls]
over.hull = { voxel_mm = [12.0, 16.0] }
with = ["fine", "worse"]
replicate = 6
tell = "hull.volume"
"""


@pytest.fixture(scope="module")
def hulls(tmp_path_factory, cache):
    file = tmp_path_factory.mktemp("hulls") / "hulls.toml"
    file.write_text(HULLS)
    return tailor.Pipeline(file, cache=cache)


@pytest.fixture(scope="module")
def swept(hulls):
    return tailor.sweep(hulls, "hulls", progress=False)


def test_replicates_are_points_and_what_they_scatter(swept):
    points = swept.frame("dicts")
    assert len(points) == len(swept) == 2 * 2 * 6
    assert {p["replicate"] for p in points} == {1, 2, 3, 4, 5, 6}
    assert all(isinstance(p["hull.voxel_mm"], float) and isinstance(p["hull.volume"], float) for p in points)
    spreads = swept.replicates("dicts")
    assert len(spreads) == 4
    for row in spreads:
        own = [p["hull.volume"] for p in points if (p["variant"], p["hull.voxel_mm"]) == (row["variant"], row["hull.voxel_mm"])]
        assert (row["n"], row["refused"], row["failed"], row["unit"]) == (6, 0, 0, "l")
        assert row["mean"] == pytest.approx(statistics.mean(own)) and row["sd"] == pytest.approx(statistics.stdev(own))
        assert row["low95"] < row["mean"] < row["high95"]


def test_variants_are_compared_replicate_by_replicate(swept):
    pairs = swept.paired("dicts")
    points = swept.frame("dicts")
    assert [(p["first"], p["second"], p["hull.voxel_mm"]) for p in pairs] == [("fine", "worse", 12.0), ("fine", "worse", 16.0)]
    for pair in pairs:
        of = {v: [p["hull.volume"] for p in points if (p["variant"], p["hull.voxel_mm"]) == (v, pair["hull.voxel_mm"])] for v in ("fine", "worse")}
        assert pair["effect"] == pytest.approx(statistics.mean(b - a for a, b in zip(of["fine"], of["worse"])))
        # Errors of silhouettes cut a hull: in all six pairs, which two of 64 signs give.
        assert (pair["p"], pair["exact"], pair["differ"], pair["n"]) == (2 / 64, True, True, 6)


def test_more_replicates_find_the_first_ones(hulls, swept):
    more = tailor.sweep(hulls, over={"hull.voxel_mm": [12.0, 16.0]}, tell=["hull.volume", "hull.processor"], replicate=7, progress=False)
    points = more.frame("dicts")
    known = {(p["hull.voxel_mm"], p["replicate"]): p["hull.volume"] for p in swept.frame("dicts") if p["variant"] == "fine"}
    for point in points:
        key = (point["hull.voxel_mm"], point["replicate"])
        assert point["made"] == 0 or point["replicate"] == 7
        assert known.get(key, point["hull.volume"]) == point["hull.volume"]
    table = hulls.sweep(over={"hull.voxel_mm": [12.0]}, tell=["hull.volume"], replicate=2, kind="dicts", progress=False)
    assert [row["replicate"] for row in table] == [1, 2]


def test_replicates_that_cannot_be_are_refused(hulls):
    with pytest.raises(tailor.Error, match="all replicates would be the same"):
        hulls.sweep(nodes=["solid"], replicate=3, progress=False)
    with pytest.raises(tailor.Error, match="varies by itself and by `replicate`"):
        hulls.sweep(over={"seen.seed": [1, 2]}, replicate=3, progress=False)
    with pytest.raises(tailor.Error, match="there is no such folder"):
        hulls.sweep(over={"hull.voxel_mm": [12.0]}, truth="nowhere", progress=False)


def test_frames_are_of_pandas_and_polars_alike(swept):
    pandas = pytest.importorskip("pandas")
    polars = pytest.importorskip("polars")
    for of in (swept.frame, swept.replicates, swept.paired):
        assert isinstance(of("pandas"), pandas.DataFrame) and isinstance(of("polars"), polars.DataFrame)
        assert list(of("pandas").columns) == list(of("polars").columns)


def test_girths_are_a_flat_table_with_what_was_refused(doll, shown):
    for node in ("girths", "girths_formula"):
        girths = doll.run(node, progress=False)[node]
        rows = girths.frame("dicts")
        assert {row["name"] for row in rows if not row["refused"]} == set(girths)
        assert {row["name"] for row in rows if row["refused"]} == {m["name"] for m in girths.document.get("missing", [])}
        for row in rows:
            assert list(row) == list(rows[0]), "the same columns in every row"
            assert not any(isinstance(value, (dict, list)) for value in row.values()), row
    given = next(row for row in shown["girths"].frame("dicts") if not row["refused"])
    assert given["interval_cm.lo"] < given["tape_cm"] < given["interval_cm.hi"]
    assert given["sigma_cm.surface"] > 0
