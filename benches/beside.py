#!/usr/bin/env python3
"""Beside `cargo bench -p silhouette -p hull`: the same work by PyMaxflow, OpenCV and scikit-image.

Needs numpy, PyMaxflow, opencv-python-headless, scikit-image. The least of several runs, one thread.
"""
import time

import cv2
import maxflow
import numpy as np
from skimage.measure import marching_cubes

cv2.setNumThreads(1)


def least(times, make, run):
    best = 1e9
    for _ in range(times):
        made = make()
        start = time.perf_counter()
        told = run(made)
        best = min(best, time.perf_counter() - start)
    return best * 1e3, told


def thrown(i):
    h = i.astype(np.uint64) * 2654435761 % 2**32
    h = (h ^ (h >> 15)) * 2246822519 % 2**32
    return (h >> 24).astype(np.int64)


def disc(n):
    y, x = np.mgrid[:n, :n]
    inside = np.hypot(x - n / 2, y - n / 2) < 0.3 * n
    level = np.where(inside, 160, 90) + ((thrown(y * n + x) - 128) / 2).astype(np.int64)
    graph = maxflow.GraphInt(n * n, 4 * n * n)
    nodes = graph.add_grid_nodes((n, n))
    even, lean = np.array([[0, 0, 0], [0, 0, 60], [0, 60, 0]]), np.array([[0, 0, 0], [0, 0, 0], [42, 0, 42]])
    graph.add_grid_edges(nodes, structure=even, symmetric=True)
    graph.add_grid_edges(nodes, structure=lean, symmetric=True)
    graph.add_grid_tedges(nodes, np.maximum(level, 0), np.maximum(250 - level, 0))
    return graph


def photo():
    y, x = np.mgrid[:2400, :1600]
    square = thrown(x // 150 * 31 + y // 150 * 977)
    image = np.stack([70 + (square + 40 * c) % 110 for c in range(3)], 2).astype(np.uint8)
    inside = ((x - 800) / 300) ** 2 + ((y - 1200) / 950) ** 2 < 1
    shade = 20 * np.sin((x - 800) / 90)
    body = np.stack([c + shade for c in (205, 165, 140)], 2).astype(np.uint8)
    image[inside] = body[inside]
    return image + (thrown(y * 1600 + x) % 4).astype(np.uint8)[..., None]


for n in (512, 1024, 2048):
    took, flow = least(5, lambda: disc(n), lambda g: g.maxflow())
    print(f"PyMaxflow {n}²: {took:7.1f} ms, flow {flow}")

image = photo()


def grabcut(_):
    mask, back, fore = np.zeros(image.shape[:2], np.uint8), np.zeros((1, 65)), np.zeros((1, 65))
    cv2.grabCut(image, mask, (480, 220, 640, 1960), back, fore, 2, cv2.GC_INIT_WITH_RECT)
    return int(((mask == 1) | (mask == 3)).sum())


took, area = least(1, lambda: None, grabcut)
print(f"OpenCV GrabCut, two rounds, a rectangle, 1600×2400: {took:.0f} ms, {area} pixels")

for cell in (8, 4, 2):
    z, y, x = (a.astype(np.float32) for a in np.ogrid[-60:2060:cell, -500:500:cell, -250:250:cell])
    field = 140 - np.sqrt(x * x + y * y + (z - np.clip(z, 900, 1860)) ** 2)
    took, told = least(1, lambda: field, lambda f: marching_cubes(f, 0.0))
    print(f"scikit-image marching cubes, {cell} mm ({field.size / 1e6:.1f} million cells, no carving): {took:.0f} ms, {len(told[1])} faces")
