"""COLMAP's cameras: colmap.py PHOTOS OUT MAX_FEATURES

PHOTOS is a folder as `tailor show photos` writes it (images/, capture.toml). What stands still in all
photos is masked, since on a disk the subject turns and the room does not. OUT gets a model as text.
Needs pycolmap (BSD) with its numpy; one thread and a fixed seed, so that it gives the same twice.
"""

import json
import pathlib
import sys

import numpy as np
import pycolmap

# A pixel that differs from the middle of all photos by more than this has moved, and so have its
# neighbours up to this far; shares of 255 and of the photo's width.
MOVED, AROUND = 14, 0.012


def progress(share):
    print(json.dumps({"progress": share}), flush=True)


def gray(path):
    return pycolmap.Bitmap.read(str(path), as_rgb=False).to_array().squeeze().astype(np.int16)


def grown(mask, reach):
    """A mask with all that lies within a square around it."""
    for axis in (0, 1):
        total = np.cumsum(np.pad(mask.astype(np.int32), [(reach + 1, reach) if a == axis else (0, 0) for a in (0, 1)]), axis)
        size = mask.shape[axis]
        ahead = np.take(total, range(2 * reach + 1, 2 * reach + 1 + size), axis)
        behind = np.take(total, range(0, size), axis)
        mask = ahead > behind
    return mask


def main():
    photos, out, most = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), int(sys.argv[3])
    images = photos / "images"
    plate = [line.split("=", 1)[1].strip().strip('"') for line in (photos / "capture.toml").read_text().splitlines() if line.startswith("plate")]
    names = sorted(p.name for p in images.iterdir() if not any(q.endswith(p.name) for q in plate))
    shades = np.stack([gray(images / name) for name in names])
    still = np.median(shades, axis=0).astype(np.int16)
    masks = pathlib.Path("masks")
    masks.mkdir()
    for name, shade in zip(names, shades):
        moved = grown(np.abs(shade - still) > MOVED, int(AROUND * shade.shape[1]))
        mask = np.where(moved, 255, 0).astype(np.uint8)
        pycolmap.Bitmap.from_array(mask).write(str(masks / f"{name}.png"))
    progress(0.1)
    pycolmap.set_random_seed(0)
    database = "database.db"
    reading = pycolmap.ImageReaderOptions(mask_path=str(masks))
    features = pycolmap.FeatureExtractionOptions(num_threads=1)
    features.sift.max_num_features = most
    pycolmap.extract_features(database, images, names, pycolmap.CameraMode.SINGLE, reading, features)
    progress(0.4)
    pycolmap.match_exhaustive(database, pycolmap.FeatureMatchingOptions(num_threads=1), verification_options=pycolmap.TwoViewGeometryOptions())
    progress(0.6)
    options = pycolmap.IncrementalPipelineOptions(num_threads=1, random_seed=0)
    pathlib.Path("models").mkdir()
    models = pycolmap.incremental_mapping(database, images, "models", options)
    if not models:
        sys.exit("COLMAP found no model: too few features match")
    best = max(models.values(), key=lambda model: model.num_reg_images())
    print(f"{best.num_reg_images()} of {len(names)} photos, {best.num_points3D()} points, {best.compute_mean_reprojection_error():.2f} px")
    best.write_text(out)
    # Rigs and frames, which newer versions write, hold one camera each here.
    for more in ("rigs.txt", "frames.txt"):
        (out / more).unlink(missing_ok=True)
    progress(1.0)


main()
