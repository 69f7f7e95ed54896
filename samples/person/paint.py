"""What the sample's man wears: colours of every vertex as a formula of its place at rest. Levels are sRGB."""
import numpy as np

SKIN, LIP, HAIR, BROW = (201, 156, 130), (176, 112, 100), (58, 42, 32), (74, 54, 42)
WHITE, IRIS = (222, 216, 210), (62, 48, 38)
SHIRT, STRIPE, SHORTS, HEM = (104, 132, 158), (66, 88, 116), (48, 50, 58), (84, 88, 98)


def painted(body, at, heads):
    """Colours of the places `at` [mm, at rest] of a body whose bones begin at `heads`."""
    marks = {n: body.base_v[i].mean(axis=0) for n, i in body.marks.items()}
    levels = np.empty((len(at), 3))
    levels[:] = SKIN
    head(levels, at, body, marks)
    neck, skull = (heads[body.bone(n)] for n in ("neck01", "head"))
    axis = (skull - neck) / np.linalg.norm(skull - neck)
    crotch, knee = marks["crotch"][2], heads[body.bone("lowerleg01.L")][2]
    waist = marks["navel"][2] - 45.0
    arms = [along(at, heads[body.bone(f"upperarm01.{s}")], heads[body.bone(f"lowerarm01.{s}")], s) for s in "LR"]
    arm = np.where(at[:, 0] > 0, *arms)
    trunk = np.isnan(arm)
    shirt = (at[:, 2] > waist) & np.where(trunk, (at - neck) @ axis < 6.0, arm < 0.48)
    wave = np.sin(at[:, 2] / 34.0 * 2 * np.pi)
    levels[shirt] = SHIRT
    levels[shirt & (wave > 0.45)] = STRIPE
    levels[shirt & ~trunk & (arm > 0.45)] = STRIPE
    shorts = trunk & (at[:, 2] <= waist) & (at[:, 2] > crotch - 0.5 * (crotch - knee))
    levels[shorts] = SHORTS
    levels[shorts & (at[:, 2] > waist - 28.0)] = HEM
    seam = np.abs(at[:, 1] - marks["crotch"][1] - 10.0) < 7.0
    levels[shorts & seam & (np.abs(at[:, 0]) > 90.0)] = HEM
    return levels.round().astype(np.uint8)


def along(at, shoulder, elbow, side):
    """How far down the upper arm a place lies, as a share of it; not a number where it is no arm's."""
    way = elbow - shoulder
    share = (at - shoulder) @ way / (way @ way)
    # Arms hang by 40 degrees at rest: what is farther out than the shoulder, the more the farther down, is theirs.
    reach = abs(shoulder[0]) - 5.0 + 0.3 * np.maximum(shoulder[2] - at[:, 2] - 150.0, 0.0)
    outside = (at[:, 0] * (1 if side == "L" else -1) > reach) & (at[:, 2] < shoulder[2] + 90.0)
    return np.where(outside, share, np.nan)


def head(levels, at, body, marks):
    """Hair, brows, eyes and lips, about the holes of eyes and mouth."""
    mouth, *eyes = (body.base_v[loop] for loop in body.loops)
    level = np.mean([eye.mean(axis=0) for eye in eyes], axis=0)
    front = at[:, 1] < level[1] + 30.0
    back = np.clip((at[:, 1] - level[1] + 12.0) / 150.0, 0.0, 1.0)
    ears = (np.abs(at[:, 0]) > 73.0) & (at[:, 2] < level[2] + 38.0)
    sides = (np.abs(at[:, 0]) > 48.0) & front
    levels[(at[:, 2] > level[2] + 66.0 - 118.0 * back - 14.0 * sides) & ~ears] = HAIR
    for eye in eyes:
        middle, wide = eye.mean(axis=0), np.ptp(eye[:, 0]) / 2
        off = np.abs(at - middle)
        brow = (off[:, 0] < wide + 8.0) & (np.abs(at[:, 2] - middle[2] - 21.0 + off[:, 0] * 0.12) < 3.2) & front
        levels[brow] = BROW
        levels[(off[:, 0] < wide) & (off[:, 2] < np.ptp(eye[:, 2]) / 2) & (off[:, 1] < 12.0)] = WHITE
        levels[np.hypot(off[:, 0], off[:, 2]) + (off[:, 1] > 12.0) * 99 < 5.5] = IRIS
    off = np.abs(at - mouth.mean(axis=0))
    lips = (off[:, 0] / (np.ptp(mouth[:, 0]) / 2 + 3)) ** 2 + (off[:, 2] / 9.0) ** 2 < 1
    levels[lips & (off[:, 1] < 28.0)] = LIP
