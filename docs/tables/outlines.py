#!/usr/bin/env python3
"""Fits how far the outlines of masks are off by how much colours differ beside them (`SHOWN`, `HIDDEN`, `SHOWN_LEVELS` of `shape`).

    docs/tables/outlines.py WORK CAPTURE...

WORK is a folder that rooms.py has filled; a CAPTURE is one of its scenes, as `scene-091-plate`. Photos and masks are reduced as
`Outline::of` reduces them. For each pixel of an outline: by how much the mean colours of its two sides differ, and how far the mask's
outline is off the true one at full size, as a share of the body's height. Written are the likeliest numbers of the law
SHOWN² + HIDDEN² exp(−(levels / SHOWN_LEVELS)²) of all captures together, and of each capture and all the deviation by differences,
found and by the law. Wants numpy, scipy and Pillow.
"""

import pathlib
import sys

import numpy as np
from PIL import Image
from scipy.ndimage import distance_transform_edt, uniform_filter
from scipy.optimize import minimize

LONGEST, ALONG = 800, 7
BINS = [0, 4, 8, 12, 16, 20, 25, 30, 40, 60, 256]


def signed(mask):
    """The signed distance to a mask's border, positive inside. [px]"""
    return np.where(mask, distance_transform_edt(mask) - 0.5, 0.5 - distance_transform_edt(~mask))


def reduced(image, by):
    """Means of blocks."""
    rows, columns = (n // by * by for n in image.shape[:2])
    return image[:rows, :columns].reshape(rows // by, by, columns // by, by, -1).mean((1, 3))


def outline(photo, found, true):
    """Of one photo: differences of colour along the outline [levels], and how far it is off, as shares of the body's height."""
    by = -(-max(found.shape) // LONGEST)
    small, depth = np.floor(reduced(photo, by) + 0.5), signed(reduced(found, by)[..., 0] > 127.5)
    rows, columns = np.nonzero((depth > 0) & (depth <= 1))
    inner = (np.minimum(rows, columns) > 4) & (rows < depth.shape[0] - 5) & (columns < depth.shape[1] - 5)
    rows, columns = rows[inner], columns[inner]
    sides = [(depth >= -3) & (depth <= -1), (depth >= 1) & (depth <= 3)]
    count = [uniform_filter(side * 1.0, ALONG)[rows, columns] for side in sides]
    color = [[uniform_filter(small[..., c] * side, ALONG)[rows, columns] / np.maximum(n, 1e-9) for c in range(3)]
             for side, n in zip(sides, count)]
    differ = np.max([abs(out - own) for out, own in zip(*color)], 0)
    # The nearest pixel of the outline at full size, and where the true one is from there.
    fine = signed(found > 127.5)
    at = distance_transform_edt(~((fine > 0) & (fine <= 1)), return_distances=False, return_indices=True)
    full = [np.minimum(n * by + by // 2, most - 1) for n, most in zip((rows, columns), found.shape)]
    off = signed(true > 127.5)[at[0][tuple(full)], at[1][tuple(full)]] - 0.5
    asked = (count[0] > 1e-6) & (count[1] > 1e-6)
    return differ[asked], off[asked] / (np.ptp(rows) * by)


def capture(work, name):
    """All outlines of a capture."""
    read = lambda path, mode: np.array(Image.open(path).convert(mode)).astype(float)
    photos = sorted((work / name / "images").glob("*.jpg"))
    true = work / name.replace("-plate", "-moved").replace("-none", "-moved")
    each = zip(photos, sorted((work / "out" / name / "masks").glob("*.png")), sorted(true.glob("*.png")), strict=True)
    both = [outline(read(photo, "RGB"), read(mask, "L"), read(moved, "L")) for photo, mask, moved in each]
    return [np.concatenate(values) for values in zip(*both)]


def law(numbers, differ):
    """The variance of an outline."""
    shown, hidden, levels = np.exp(numbers)
    return shown**2 + hidden**2 * np.exp(-((differ / levels) ** 2))


def main(work, *names):
    """The law, and what was found."""
    found = {name: capture(pathlib.Path(work), name) for name in names}
    found["all"] = [np.concatenate(values) for values in zip(*found.values())]
    differ, off = found["all"]
    cost = lambda numbers: (np.log(law(numbers, differ)) + off**2 / law(numbers, differ)).mean()
    best = minimize(cost, np.log([7e-4, 4e-3, 20]), method="Nelder-Mead").x
    print("SHOWN, HIDDEN, SHOWN_LEVELS:", *np.exp(best).round(5))
    for name, (differ, off) in found.items():
        print(name)
        for low, high in zip(BINS, BINS[1:]):
            at = (differ >= low) & (differ < high)
            if at.any():
                here = [1e4 * np.sqrt(np.mean(v[at])) for v in (off**2, law(np.log([7e-4, 43e-4, 18]), differ))]
                print(f"  {low:3} to {high:3} levels: {at.sum():6} pixels, {here[0]:5.1f}, by the law {here[1]:5.1f} (10⁻⁴ of the height)")


if __name__ == "__main__":
    main(*sys.argv[1:])
