"""What tests share: a doll of 60 cm, whose every stage takes seconds, and one cache for all."""

import os
import pathlib
import subprocess
import sysconfig

import pytest

import tailor

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOLL = ROOT / "tests/fingerprints/stages.toml"
SAMPLE = ROOT / "samples/mannequin"
COMMAND = os.path.join(sysconfig.get_path("scripts"), "tailor")


@pytest.fixture(scope="session", autouse=True)
def permissions(tmp_path_factory):
    """Programs are allowed for these tests, and not for whoever runs them."""
    os.environ["XDG_STATE_HOME"] = str(tmp_path_factory.mktemp("state"))


@pytest.fixture(scope="session")
def cache(tmp_path_factory):
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(scope="session")
def doll(cache):
    return tailor.Pipeline(DOLL, cache=cache)


@pytest.fixture(scope="session")
def shown(doll):
    """The doll's parts, run once."""
    nodes = ["photos", "masks", "carved", "girths", "page", "textured", "tags", "tracks", "deformation", "mat", "aligned", "scene", "evidence", "labels", "people", "alarmed"]
    return doll.run(*nodes, progress=False)


@pytest.fixture
def command(cache):
    """The wheel's command, on the tests' cache."""

    def run(*words, code=0, **more):
        done = subprocess.run([COMMAND, *words, f"--cache={cache}"], capture_output=True, text=True, **more)
        assert done.returncode == code, done.stderr
        return done

    return run
