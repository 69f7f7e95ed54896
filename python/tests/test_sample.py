"""The sample: measured by the command, found by Python (TAILOR_SAMPLE_CACHE has a cache where it was)."""

import json
import os

import pytest

import tailor
from conftest import SAMPLE

CACHE = os.environ.get("TAILOR_SAMPLE_CACHE")


@pytest.mark.skipif(not CACHE, reason="TAILOR_SAMPLE_CACHE names no cache in which the sample was measured")
def test_what_the_command_measured_python_finds(tmp_path):
    run = tailor.measure(SAMPLE, out=tmp_path / "out", cache=CACHE, progress=False)
    assert run.made == [] and len(run.found) > 10
    assert json.loads((run.out / "girths.json").read_text()) == run.girths.document
    assert 40 < run.girths["WC"]["tape_cm"] < 48
    assert len(run["body"].faces) > 10_000 and len(run["photos"]) == 18
    assert (run.out / "report.html").stat().st_size > 100_000


@pytest.mark.parametrize(
    "folder, facts, told",
    [
        ("nowhere", {}, "nowhere"),
        (".", {}, "there are no photos in ."),
        (SAMPLE, {"statur": 178}, "statur"),
        (SAMPLE, {"stature": "tall"}, "--stature"),
        (SAMPLE, {"steps": 0}, "--steps 0"),
        (SAMPLE, {"set": {"hull.voxel": 3}}, "voxel_mm"),
        (SAMPLE, {"mat": "none.pdf"}, "none.pdf"),
    ],
)
def test_what_is_wrong_is_told(tmp_path, monkeypatch, folder, facts, told):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(tailor.Error) as error:
        tailor.measure(folder, out="out", cache="cache", progress=False, **facts)
    assert told in str(error.value) and error.value.code == 2
    assert not os.path.exists("out")


def test_facts_are_the_flags_of_the_command():
    from tailor.measuring import words

    said = words({"stature": 178, "no_photos": True, "walk": False, "mat": None, "images": ["a", "b"], "set": {"a.b": 1}})
    assert said == ["--stature=178", "--no-photos", "--images=a", "--images=b", "--set=a.b=1"]


def test_a_private_measure_keeps_nothing(tmp_path, monkeypatch):
    import tempfile

    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with pytest.raises(tailor.Error):
        tailor.measure(tmp_path, private=True, progress=False)
    assert list(tmp_path.iterdir()) == []
