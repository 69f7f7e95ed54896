"""Results of one's own, put in: taken as any input, or refused in words."""

import json

import numpy
import pytest

import tailor


def boxes(shown, grow=0):
    """A mask a photo: the box around the body."""
    for photo, mask in shown["masks"].items():
        box = numpy.zeros_like(mask)
        y, x = numpy.nonzero(mask)
        box[y.min() - grow : y.max() + grow, x.min() - grow : x.max() + grow] = 255
        yield photo, box


def test_masks_of_ones_own_change_what_is_downstream_and_nothing_else(doll, shown):
    run = doll.put("masks", dict(boxes(shown))).run("carved", progress=False)
    assert "carved" in run.made and "photos" in run.found
    assert run.metrics["carved.volume"] > 1.2 * shown.metrics["carved.volume"]
    for photo, box in boxes(shown):
        assert (run["masks"][photo] == box).all()
    again = doll.put("masks", [box for _, box in boxes(shown)]).run("carved", progress=False)
    assert again.made == []
    names = {shown["photos"].names[photo]: box > 0 for photo, box in boxes(shown)}
    assert doll.put("masks", names).run("carved", progress=False).made == []


def test_masks_that_are_none_are_refused(doll, shown):
    good = dict(boxes(shown))
    cases = [
        ({**good, 2: good[2].astype(float)}, "float64"),
        ({**good, 2: good[2][None]}, "(h, w)"),
        ({**good, 2: good[2][:0]}, "(h, w)"),
        (list(good.values())[:5], "5 masks and 8 photos"),
        ({99: good[2]}, "no photo 99"),
        ({"zzz": good[2]}, "no photo `zzz`"),
        ({}, "no mask"),
    ]
    for masks, told in cases:
        with pytest.raises(tailor.Error) as error:
            doll.put("masks", masks)
        assert told in str(error.value), masks
    for masks, told in [({**good, 2: good[2][:100]}, "pixels, but the photo"), ({**good, 2: good[2] * 0}, "does not show where")]:
        with pytest.raises(tailor.Error) as error:
            doll.put("masks", masks).run("carved", progress=False)
        assert told in str(error.value) and error.value.code == 1


def test_a_mesh_is_put_in(doll, shown):
    body = shown["body"]
    run = doll.put("body", (body.vertices, body.faces)).run("landmarks", progress=False)
    assert (run["body"].vertices == body.vertices).all()
    assert "landmarks" in run.found
    other = doll.put("body", body.to_trimesh()).run("landmarks", progress=False)
    assert other.made == []
    metres = doll.put("body", (body.vertices / 1000, body.faces), unit="m").run("body", progress=False)
    assert numpy.allclose(metres["body"].vertices, body.vertices, atol=1e-3)


def test_meshes_that_are_none_are_refused(doll, shown):
    v, f = shown["body"].vertices.copy(), shown["body"].faces.copy()
    lame = v.copy()
    lame[5, 1] = numpy.nan
    dangling = f.copy()
    dangling[0, 0] = len(v)
    cases = [
        ((lame, f), "NaN"),
        ((v, dangling), "there are"),
        ((v[:, :2], f), "(n, 3)"),
        ((v, f.astype(float)), "whole numbers"),
        ((v.astype(str), f), "numbers"),
        (f, "pair"),
        (7, "pair"),
    ]
    for mesh, told in cases:
        with pytest.raises(tailor.Error) as error:
            doll.put("body", mesh)
        assert told in str(error.value), told
    twice = f.copy()
    twice[0, 0] = twice[0, 1]
    with pytest.raises(tailor.Error, match="names a vertex twice") as error:
        doll.put("body", (v, twice)).run("body", progress=False)
    assert error.value.code == 1
    holed = doll.put("body", (v, f[1:])).run("body", progress=False)
    assert "may be missing" in holed.warnings[0]


def test_cameras_are_put_in(doll, shown):
    run = doll.put("framed", shown["cameras"]).run("framed", progress=False)
    assert [v.image for v in run["framed"]] == [v.image for v in shown["cameras"]]
    assert numpy.allclose(run["framed"].views[3].K, shown["cameras"].views[3].K)
    document = json.loads(json.dumps(shown["cameras"].document))
    document["views"][0]["t"][0] = float("nan")
    with pytest.raises(tailor.Error, match="NaN"):
        doll.put("framed", document)
    with pytest.raises(tailor.Error, match="views"):
        doll.put("framed", {"a": 1})


def test_cameras_of_pycolmap_are_put_in(doll, shown):
    pytest.importorskip("pycolmap")
    run = doll.put("framed", shown["cameras"].to_pycolmap()).run("framed", progress=False)
    assert len(run["framed"]) == 8


def test_a_document_is_put_in(doll):
    run = doll.put("mat", ("table.csv", "a,b\n1,2\n")).run("mat", progress=False)
    assert run["mat"].frame("dicts") == [{"a": "1", "b": "2"}]
    with pytest.raises(tailor.Error, match="no document"):
        doll.put("mat", ("table.exe", "a")).run("mat", progress=False)
    with pytest.raises(tailor.Error, match="pair"):
        doll.put("mat", "table.csv")


def test_what_cannot_be_put_in_is_told(doll):
    with pytest.raises(tailor.Error, match="warps, which cannot be put in"):
        doll.put("deformation", {})
    with pytest.raises(tailor.Error, match="girths cannot be written from Python"):
        doll.put("girths", {})
    with pytest.raises(tailor.Error, match="no node `mask`"):
        doll.put("mask", {})


def test_photos_are_put_in(doll, shown):
    photos = {name: shown["photos"][i] for i, name in enumerate(shown["photos"].names)}
    run = doll.put("photos", photos).run("photos", "keypoints", progress=False)
    assert len(run["photos"]) == 8 and (run["photos"][5] == shown["photos"][5]).all()
    assert "keypoints" in run.made
    with pytest.raises(tailor.Error, match=r"\(h, w, 3\)"):
        doll.put("photos", [shown["masks"][0]])
    with pytest.raises(tailor.Error, match="no photo"):
        doll.put("photos", [])
