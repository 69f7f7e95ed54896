"""Surfaces as written: midpoint subdivision with smoothing, voxel remesh, binary PLY."""
import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree


def subdivided(v, f):
    """One step of Loop's subdivision of a closed mesh, drawn back so that the old vertices stay where they were."""
    e = np.sort(np.vstack([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]]), axis=1)
    far = np.concatenate([f[:, 2], f[:, 0], f[:, 1]])
    u, at = np.unique(e, axis=0, return_inverse=True)
    at = at.ravel()
    opposite = np.zeros((len(u), 3))
    np.add.at(opposite, at, v[far])
    mid = 0.375 * (v[u[:, 0]] + v[u[:, 1]]) + 0.125 * opposite
    count = np.bincount(u.ravel(), minlength=len(v))
    around = np.zeros_like(v)
    np.add.at(around, u[:, 0], v[u[:, 1]])
    np.add.at(around, u[:, 1], v[u[:, 0]])
    n = np.maximum(count, 3)
    beta = (0.625 - (0.375 + 0.25 * np.cos(2 * np.pi / n)) ** 2) / n
    old = v * (1 - n * beta)[:, None] + around * beta[:, None]
    back = v - old
    mid += (back[u[:, 0]] + back[u[:, 1]]) / 2
    m = len(f)
    a, b, c = (at[:m] + len(v), at[m : 2 * m] + len(v), at[2 * m :] + len(v))
    faces = np.vstack(
        [
            np.column_stack([f[:, 0], a, c]),
            np.column_stack([f[:, 1], b, a]),
            np.column_stack([f[:, 2], c, b]),
            np.column_stack([a, b, c]),
        ]
    )
    return np.vstack([v, mid]), faces


def columns_inside(v, f, lo, step, shape):
    """Inside by winding number along z: each column through voxel centres counts signed crossings."""
    wind = np.zeros((shape[0], shape[1], shape[2] + 1), dtype=np.int16)
    g = (v - lo) / step
    a, b, c = g[f[:, 0]], g[f[:, 1]], g[f[:, 2]]
    up = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    keep = np.abs(up) > 1e-12
    a, b, c, up = a[keep], b[keep], c[keep], up[keep]
    xlo = np.ceil(np.minimum(np.minimum(a[:, 0], b[:, 0]), c[:, 0])).astype(int)
    xhi = np.floor(np.maximum(np.maximum(a[:, 0], b[:, 0]), c[:, 0])).astype(int)
    ylo = np.ceil(np.minimum(np.minimum(a[:, 1], b[:, 1]), c[:, 1])).astype(int)
    yhi = np.floor(np.maximum(np.maximum(a[:, 1], b[:, 1]), c[:, 1])).astype(int)
    nx, ny = np.maximum(xhi - xlo + 1, 0), np.maximum(yhi - ylo + 1, 0)
    n = nx * ny
    tri = np.repeat(np.arange(len(n)), n)
    k = np.arange(len(tri)) - np.repeat(np.cumsum(n) - n, n)
    x, y = xlo[tri] + k // ny[tri], ylo[tri] + k % ny[tri]
    a, b, c, up = a[tri], b[tri], c[tri], up[tri]
    wb = ((x - a[:, 0]) * (c[:, 1] - a[:, 1]) - (y - a[:, 1]) * (c[:, 0] - a[:, 0])) / up
    wc = ((b[:, 0] - a[:, 0]) * (y - a[:, 1]) - (b[:, 1] - a[:, 1]) * (x - a[:, 0])) / up
    hit = (wb >= 0) & (wc >= 0) & (wb + wc <= 1)
    z = a[:, 2] + wb * (b[:, 2] - a[:, 2]) + wc * (c[:, 2] - a[:, 2])
    x, y, z, s = x[hit], y[hit], np.ceil(z[hit]).astype(int), np.where(up[hit] > 0, -1, 1)
    np.add.at(wind, (x, y, np.clip(z, 0, shape[2])), s)
    return np.cumsum(wind, axis=2)[:, :, :-1] > 0


def remeshed(v, f, step, web, box):
    """One closed outer surface on voxels of `step` mm; within the box (low, high corner) gaps up to `web` mm are filled,
    as visual hulls and smoothing reconstructions fill armpits and the crotch."""
    from skimage import measure

    pad = 4
    # A shift off the grid keeps columns from running through vertices.
    lo = v.min(axis=0) - pad * step + [0.0131, 0.0173, 0.0]
    shape = np.ceil((v.max(axis=0) - lo) / step).astype(int) + pad
    inside = columns_inside(v, f, lo, step, shape)
    if web > step:
        cut = tuple(
            slice(max(int(a), 0), int(b)) for a, b in zip((np.array(box[0]) - lo) / step, (np.array(box[1]) - lo) / step)
        )
        r = web / 2 / step
        grown = ndimage.distance_transform_edt(~inside[cut]) <= r
        inside[cut] |= ndimage.distance_transform_edt(grown) > r
    inside = ndimage.binary_fill_holes(inside)
    field = ndimage.gaussian_filter(inside.astype(np.float32), 0.8)
    w, g, _, _ = measure.marching_cubes(field, 0.5, gradient_direction="ascent")
    w, g = largest(w * step + lo, g)
    return onto(w, g, v, f, step)


def largest(w, g):
    """The largest connected piece, its vertices renumbered."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    e = np.vstack([g[:, [0, 1]], g[:, [1, 2]]])
    _, piece = connected_components(coo_matrix((np.ones(len(e)), e.T), shape=(len(w), len(w))), directed=False)
    own = piece == np.bincount(piece).argmax()
    at = np.cumsum(own) - 1
    return w[own], at[g[own[g[:, 0]]]]


def onto(w, g, v, f, step):
    """Takes the voxels' bias back: the mean signed distance to the source, along normals, is removed."""
    n = vertex_normals(w, g)
    src = v[f].mean(axis=1)
    fn = np.cross(v[f[:, 1]] - v[f[:, 0]], v[f[:, 2]] - v[f[:, 0]])
    fn /= np.maximum(np.linalg.norm(fn, axis=1), 1e-12)[:, None]
    _, i = cKDTree(src).query(w)
    d = np.einsum("ij,ij->i", src[i] - w, fn[i])
    facing = (np.einsum("ij,ij->i", n, fn[i]) > 0.8) & (np.abs(d) < 2 * step)
    w = w + n * float(np.median(d[facing]))
    w[:, 2] -= w[:, 2].min()
    return w, g


def vertex_normals(v, f):
    n = np.zeros_like(v)
    c = np.cross(v[f[:, 1]] - v[f[:, 0]], v[f[:, 2]] - v[f[:, 0]])
    for k in range(3):
        np.add.at(n, f[:, k], c)
    return n / np.maximum(np.linalg.norm(n, axis=1), 1e-12)[:, None]


def parts_from(w, g, v, f, face_part):
    """Part of each face of (w, g) from the nearest face of (v, f)."""
    _, i = cKDTree(v[f].mean(axis=1)).query(w[g].mean(axis=1))
    return face_part[i]


def write_ply(path, v, f):
    """Binary little-endian PLY, float32 vertices and int32 triangles."""
    head = (
        "ply\nformat binary_little_endian 1.0\ncomment millimetres, z up\n"
        f"element vertex {len(v)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(f)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.zeros(len(f), dtype=[("n", "u1"), ("i", "<i4", (3,))])
    rows["n"], rows["i"] = 3, f
    path.write_bytes(head.encode() + v.astype("<f4").tobytes() + rows.tobytes())


def written(body, clean, how, marks):
    """The surface as written and the part of each face."""
    f, v = body.compact[body.faces], clean.v[body.used]
    if "voxel" in how:
        half = 1.1 * max(abs(marks["acromion_l"][0]), abs(marks["acromion_r"][0]))
        box = ([-half, -1e3, marks["crotch"][2] - 150], [half, 1e3, marks["acromion_l"][2]])
        w, g = remeshed(v, f, how["voxel"], how["web"], box)
        return w, g, parts_from(w, g, v, f, body.face_part)
    if "subdivide" in how:
        w, g = subdivided(v, f)
        return w, g, np.tile(body.face_part, 4)
    return v, f, body.face_part
