"""Masks by MediaPipe's pose model: mediapipe_masks.py PHOTOS OUT SURE

PHOTOS is a folder as `tailor show photos` writes it (images/, capture.toml). OUT gets a PNG for each photo, white
where the model says "person" with more than SURE (0 to 1). A photo in which it sees nobody is an error.
Needs mediapipe 0.10.x before 0.10.30: later packages come without their weights.
"""

import json
import pathlib
import sys

import cv2
import mediapipe
import numpy as np


def main():
    photos, out, sure = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), float(sys.argv[3])
    plate = [line.split("=", 1)[1].strip().strip('"') for line in (photos / "capture.toml").read_text().splitlines() if line.startswith("plate")]
    images = sorted(p for p in (photos / "images").iterdir() if not any(q.endswith(p.name) for q in plate))
    model = mediapipe.solutions.pose.Pose(static_image_mode=True, model_complexity=1, enable_segmentation=True)
    for done, path in enumerate(images, 1):
        seen = model.process(cv2.cvtColor(cv2.imread(str(path)), cv2.COLOR_BGR2RGB)).segmentation_mask
        if seen is None:
            sys.exit(f"MediaPipe sees nobody in {path.name}")
        mask = np.where(seen > sure, 255, 0).astype(np.uint8)
        # What hangs together with the body alone: specks elsewhere are none of it.
        count, parts, areas, _ = cv2.connectedComponentsWithStats(mask)
        if count > 2:
            mask[parts != 1 + int(np.argmax(areas[1:, cv2.CC_STAT_AREA]))] = 0
        cv2.imwrite(str(out / f"{path.stem}.png"), mask)
        print(json.dumps({"progress": done / len(images)}), flush=True)


main()
