"""The package itself: how soon it is there, what it holds, its command."""

import ast
import json
import os
import pathlib
import subprocess
import sys

import tailor
from conftest import COMMAND
from tailor import _native

HERE = pathlib.Path(tailor.__file__).parent


def said(text):
    return subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True).stdout


def test_import_is_quick_and_loads_no_numpy():
    text = (
        "import time, sys; t = time.perf_counter(), time.process_time(); import tailor; "
        "print(time.process_time() - t[1], time.perf_counter() - t[0]); assert 'numpy' not in sys.modules"
    )
    cpu, wall = (min(column) for column in zip(*([float(x) for x in said(text).split()] for _ in range(7))))
    print(f"import tailor: {cpu * 1e3:.0f} ms of the processor, {wall * 1e3:.0f} ms by the clock")
    # By the clock it depends on who else works here.
    assert cpu <= 0.15


def test_the_stub_names_what_there_is():
    stub = ast.parse((HERE / "_native.pyi").read_text()).body
    told = {n.name for n in stub if isinstance(n, (ast.FunctionDef, ast.ClassDef))} | {"version"}
    assert told == {name for name in vars(_native) if not name.startswith("__")}
    for node in stub:
        if isinstance(node, ast.ClassDef):
            for part in node.body:
                name = part.name if isinstance(part, ast.FunctionDef) else part.target.id
                assert hasattr(getattr(_native, node.name), name), name


def test_it_is_typed_and_every_public_name_is_documented():
    assert (HERE / "py.typed").exists()
    for name in tailor.__all__:
        thing = getattr(tailor, name)
        if callable(thing):
            assert thing.__doc__, name
            methods = vars(thing).items() if isinstance(thing, type) else ()
            for own, method in methods:
                if callable(method) and not own.startswith("_"):
                    assert method.__doc__, f"{name}.{own}"


def test_the_wheel_holds_the_command():
    told = subprocess.run([COMMAND, "--version"], capture_output=True, text=True, check=True).stdout
    assert told == f"tailor {tailor.__version__}\n"
    told = subprocess.run([sys.executable, "-m", "tailor", "pipelines", "body"], capture_output=True, text=True)
    assert told.returncode == 0 and "goal = " in told.stdout


def test_the_command_ends_with_its_own_codes(tmp_path):
    def code(*words):
        done = subprocess.run([COMMAND, *words], cwd=tmp_path, capture_output=True, text=True)
        return done.returncode, done.stderr

    assert code("measure", "nowhere")[0] == 2
    assert "nowhere" in code("measure", "nowhere")[1]
    assert code("measures")[0] == 2
    assert not (tmp_path / "nowhere-out").exists()


def test_a_panic_is_an_error_and_no_other_exception():
    error = None
    try:
        _native.png(b"", 0, 0, 1)
    except BaseException as why:
        error = why
    assert type(error) is tailor.Error


def test_errors_travel_between_processes():
    import pickle

    error = tailor.Error("a", 1, json.dumps({"failures": [{"node": "x", "why": "y"}]}))
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.code, again.failures) == ("a", 1, [("x", "y")])


def test_names_of_the_environment(monkeypatch, tmp_path):
    monkeypatch.setenv("TAILOR_CACHE", str(tmp_path / "elsewhere"))
    assert repr(tailor.Pipeline("body")) == "<Pipeline body>"
    tailor.Pipeline("body").input("photos", tmp_path)
    assert tailor.Pipeline("body")._cache == os.path.join(tmp_path, "elsewhere")
