"""What LiteRT makes of a painted figure: `stages/person/tests/reference.txt`, which a test holds our networks to.

    pip install ai-edge-litert==2.3.0 numpy==2.4.6
    python reference.py mediapipe-0.10.9-*.whl ../../stages/person/tests/reference.txt
"""

import sys
import zipfile
from pathlib import Path

import numpy as np
from ai_edge_litert.interpreter import Interpreter

# Boxes of a figure on a side of 64: left, top, right, bottom, colour. `tests/all/networks.rs` paints the same.
FIGURE = [
    (0, 0, 64, 48, (176, 180, 184)),
    (0, 48, 64, 64, (120, 104, 90)),
    (28, 6, 36, 15, (214, 170, 140)),
    (28, 5, 36, 7, (60, 44, 36)),
    (30, 15, 34, 17, (205, 160, 130)),
    (25, 17, 39, 33, (60, 90, 160)),
    (21, 18, 25, 34, (214, 170, 140)),
    (39, 18, 43, 34, (214, 170, 140)),
    (25, 33, 31, 56, (50, 50, 60)),
    (33, 33, 39, 56, (50, 50, 60)),
    (24, 56, 31, 59, (30, 30, 30)),
    (33, 56, 40, 59, (30, 30, 30)),
]


def figure(side):
    picture = np.zeros((side, side, 3), np.float32)
    for left, top, right, bottom, colour in FIGURE:
        rows, columns = [slice(a * side // 64, b * side // 64) for a, b in ((top, bottom), (left, right))]
        picture[rows, columns] = colour
    # A grain, so that nothing is flat.
    y, x = np.mgrid[:side, :side]
    return picture + ((x * 7 + y * 13) % 11)[..., None].astype(np.float32)


def run(data, picture):
    net = Interpreter(model_content=data, num_threads=1)
    net.allocate_tensors()
    net.set_tensor(net.get_input_details()[0]["index"], picture[None])
    net.invoke()
    return {d["name"]: net.get_tensor(d["index"]).ravel() for d in net.get_output_details()}


with zipfile.ZipFile(sys.argv[1]) as wheel:
    detector = wheel.read("mediapipe/modules/pose_detection/pose_detection.tflite")
    landmarks = wheel.read("mediapipe/modules/pose_landmark/pose_landmark_full.tflite")
found = run(detector, figure(224) * np.float32(2 / 255) - np.float32(1))
pose = run(landmarks, figure(256) * np.float32(1 / 255))
best = np.argsort(-found["Identity_1"], kind="stable")[:8]
every = lambda values, step: [(i, values[i]) for i in range(0, len(values), step)]
rows = [
    ("scores", every(found["Identity_1"], 97) + [(i, found["Identity_1"][i]) for i in best]),
    ("boxes", [(12 * i + k, found["Identity"][12 * i + k]) for i in best for k in range(12)]),
    ("landmarks", every(pose["Identity"], 1)),
    ("presence", every(pose["Identity_1"], 1)),
    ("mask", every(pose["Identity_2"], 523)),
]
text = "".join(f"{name} {i} {value:.8g}\n" for name, values in rows for i, value in values)
Path(sys.argv[2]).write_text(text)
