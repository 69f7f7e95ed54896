"""The reader without packages (python/read_store.py) against the wheel."""

import sys

import numpy

from conftest import ROOT

sys.path.insert(0, str(ROOT / "python"))
import read_store  # noqa: E402


def test_the_reader_reads_what_the_wheel_reads(doll, cache):
    run = doll.run("carved", "masks", "mat", progress=False)
    store = read_store.Store(cache)
    contents = {n["node"]: n["content"] for n in run.record["nodes"]}
    positions, faces = store.artifact(contents["carved"], verify=True).mesh()
    assert (numpy.array(positions, numpy.float32) == run["carved"].vertices).all()
    assert (numpy.array(faces) == run["carved"].faces).all()
    masks = store.artifact(contents["masks"])
    for photo, mask in run["masks"].items():
        width, pixels = masks.mask(photo)
        assert mask.shape[1] == width and mask.tobytes() == pixels
    assert store.artifact(contents["mat"]).sections["bytes"] == run["mat"].bytes
