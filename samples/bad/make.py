#!/usr/bin/env python3
"""Makes three captures as they should not be taken, of the man of `samples/person`, small.

    samples/bad/make.py TAILOR WORK

WORK is that of `samples/person/make.py`, whose surface is photographed again. Writes a picture for docs/first-capture.md, too.
"""
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[1] / "docs/tables")]

from PIL import Image
from scans import PIPELINE, flags

TAKEN = {"ring.width": 450, "ring.height": 600, "ring.views": 16, "ring.focal_35mm": 55.0, "ring.distance_mm": 3400.0}
TAKEN |= {"ring.camera_mm": 1200.0, "ring.look_mm": 820.0, "ring.disk_mm": 400.0, "ring.seed": 6, "sway.seed": 6}
TAKEN |= {"sway.sway_mm": 3.0, "taken.seed": 6, "taken.contrast": 0.12, "taken.finest_mm": 3.0, "taken.coarsest_mm": 40.0}
TAKEN |= {"taken.scene": 9, "taken.mat": False, "taken.jpeg_quality": 0, "taken.noise_levels": 0.0}
TAKEN |= {"photos.noise_levels": 1.5, "photos.blur_px": 0.5, "photos.jpeg_quality": 82, "photos.seed": 6}
FACTS = """# what is known about this capture
[camera]
focal_35mm = 54.8

[subject]
height_cm = 176.0
"""
FAULTS = {
    "moving-light": {"photos.exposure_ev": 1.2, "photos.white": 0.1, "photos.plate": False},
    "feet-cut-off": {"ring.look_mm": 1170.0},
    "empty-photo": {},
}


def main(tailor, work):
    """All three."""
    work = pathlib.Path(work).resolve()
    for name, fault in FAULTS.items():
        out = HERE / name
        shutil.rmtree(out, ignore_errors=True)
        said = ["--input", f"surface={work / 'surface'}", "--cache", work / "cache", "--quiet", *flags(TAKEN | fault)]
        for words in (["run", PIPELINE, *said, "photos"], ["show", "photos", "--pipeline", PIPELINE, *said, "--as", "capture", "-o", work / name]):
            subprocess.run([tailor, *map(str, words)], check=True, stdout=sys.stderr)
        out.mkdir(parents=True)
        for photo in sorted((work / name).rglob("*.jpg")):
            shutil.copyfile(photo, out / photo.name)
        (out / "capture.toml").write_text(FACTS)
        shutil.rmtree(work / name)
    # The subject came late: the empty scene lies among the turn's photos, under a number of its own.
    (HERE / "empty-photo/plate.jpg").rename(HERE / "empty-photo/0007.jpg")
    shown = ["person/images/0001", "bad/moving-light/0000", "bad/moving-light/0009", "bad/feet-cut-off/0001", "bad/empty-photo/0007"]
    sheet = Image.new("RGB", (5 * 240, 320))
    for i, name in enumerate(shown):
        sheet.paste(Image.open(HERE.parent / f"{name}.jpg").resize((240, 320)), (240 * i, 0))
    sheet.save(HERE.parents[1] / "docs/pictures/good-and-bad.jpg", quality=82)


if __name__ == "__main__":
    main(*sys.argv[1:])
