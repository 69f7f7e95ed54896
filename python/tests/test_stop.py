"""Ctrl-C ends a run as it ends the command; what is done is kept."""

import os
import signal
import subprocess
import sys
import time

from conftest import COMMAND, DOLL

# A shell's background jobs ignore SIGINT, and so would what they start: Python's own handler is set.
PROGRAM = """
import signal, sys, time, tailor
signal.signal(signal.SIGINT, signal.default_int_handler)
doll = tailor.Pipeline(sys.argv[1], cache=sys.argv[2])
print("begun", flush=True)
try:
    doll.run("walk_masks", progress=lambda e: print(e.what, e.node, flush=True))
except KeyboardInterrupt:
    print("stopped", flush=True)
print("goes on", sum(range(10)), flush=True)
"""


def wait_for(process, text):
    for line in process.stdout:
        if text in line:
            return
    raise AssertionError(f"it never said {text}")


def test_ctrl_c_is_a_keyboard_interrupt_and_python_goes_on(tmp_path):
    words = [sys.executable, "-c", PROGRAM, str(DOLL), str(tmp_path)]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    wait_for(process, "started walk_keypoints")
    begun = time.time()
    process.send_signal(signal.SIGINT)
    rest = process.communicate(timeout=120)[0]
    assert "stopped" in rest and "goes on 45" in rest and process.returncode == 0
    assert time.time() - begun < 60
    done = subprocess.run([COMMAND, "plan", str(DOLL), "body", f"--cache={tmp_path}", "--json"], capture_output=True, text=True)
    assert "cached" in done.stdout


def test_ctrl_c_ends_the_command_with_130(tmp_path):
    words = [COMMAND, "run", str(DOLL), "walk_masks", f"--cache={tmp_path}"]
    process = subprocess.Popen(words, stderr=subprocess.PIPE, text=True)
    for line in process.stderr:
        if "walk " in line or "body" in line:
            break
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=120)
    assert process.returncode == 130


def test_a_run_in_a_child_that_was_forked(tmp_path):
    """Forked children of a process that has run things can run things."""
    text = (
        "import os, sys, tailor\n"
        "doll = tailor.Pipeline(sys.argv[1], cache=sys.argv[2])\n"
        "doll.run('sway', progress=False)\n"
        "child = os.fork()\n"
        "if not child:\n"
        "    doll.set('cameras.views', 9).run('sway', progress=False)\n"
        "    os._exit(7)\n"
        "print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    told = subprocess.run([sys.executable, "-c", text, str(DOLL), str(tmp_path)], capture_output=True, text=True, timeout=60)
    assert told.stdout == "7\n", told.stderr + str(os.getpid())
