"""The truth of a posed body: landmarks from carried template vertices, planes, and tapes of the right part alone.

A tape is the perimeter of the convex hull of a section, in its plane. Parts: see `Body.part`. Nothing here looks for a
feature on the surface but extremes that definitions name (fullest thigh, calf, buttock).
"""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull

from template import JOINTS
from pose import unit

TRUNK, ARM_L, ARM_R, LEG_L, LEG_R = range(5)
NO_ARMS = (TRUNK, LEG_L, LEG_R)


class Surface:
    """Vertices, faces and the part of each face."""

    def __init__(self, v, f, part):
        self.v, self.f, self.part, self.own = v, f, part, {}

    def faces(self, parts):
        """The faces of some parts, looked up once."""
        if parts not in self.own:
            self.own[parts] = self.f[np.isin(self.part, parts)]
        return self.own[parts]

    def section(self, point, normal, parts, near=None):
        """Points (n x 3) where the plane cuts the parts; with `near`, of the one piece whose middle is nearest to it."""
        d = (self.v - point) @ normal
        d = np.where(np.abs(d) < 1e-9, 1e-9, d)
        f = self.faces(parts)
        s = d[f] > 0
        f = f[s.any(axis=1) & ~s.all(axis=1)]
        if len(f) < 3:
            return np.zeros((0, 3))
        e = np.sort(np.vstack([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]]), axis=1)
        cut = (d[e[:, 0]] > 0) != (d[e[:, 1]] > 0)
        face = np.tile(np.arange(len(f)), 3)[cut]
        e, at = np.unique(e[cut], axis=0, return_inverse=True)
        t = (d[e[:, 0]] / (d[e[:, 0]] - d[e[:, 1]]))[:, None]
        p = self.v[e[:, 0]] * (1 - t) + self.v[e[:, 1]] * t
        if near is None:
            return p
        link = coo_matrix((np.ones(len(face)), (face, at.ravel())), shape=(len(f), len(e)))
        _, piece = connected_components(link.T @ link, directed=False)
        best, gap = None, np.inf
        for k in range(piece.max() + 1):
            q = p[piece == k]
            away = np.linalg.norm((q.min(axis=0) + q.max(axis=0)) / 2 - near)
            if len(q) > 5 and away < gap:
                best, gap = q, away
        return np.zeros((0, 3)) if best is None else best

    def tape(self, point, normal, parts, near=None):
        """Perimeter of the hull of the section; None where the plane misses."""
        p = self.section(np.asarray(point), unit(np.asarray(normal, dtype=float)), parts, near)
        if len(p) < 6:
            return None
        return hull_length(p, normal)

    def level(self, z, parts=NO_ARMS):
        return self.tape([0, 0, z], [0, 0, 1], parts)


def hull_length(p, normal):
    n = unit(np.asarray(normal, dtype=float))
    a = unit(np.cross(n, [1, 0, 0] if abs(n[0]) < 0.9 else [0, 1, 0]))
    q = np.column_stack([p @ a, p @ np.cross(n, a)])
    hull = q[ConvexHull(q).vertices]
    return float(np.linalg.norm(hull - np.roll(hull, 1, axis=0), axis=1).sum())


def landmarks(body, v, heads):
    """Name -> place: landmarks and joints."""
    out = {n: v[i].mean(axis=0) for n, i in body.marks.items() if n != "crotch"}
    crotch = body.marks["crotch"]
    out["crotch"] = v[crotch[int(v[crotch, 2].argmin())]]
    for joint, bone in JOINTS.items():
        for side in "lr":
            out[f"joint_{joint}_{side}"] = heads[body.bone(f"{bone}.{side.upper()}")]
    out["joint_neck"], out["joint_head"] = heads[body.bone("neck01")], heads[body.bone("head")]
    out["waist_rig"] = v[body.waist_ring].mean(axis=0)
    trunk = np.flatnonzero(np.isin(body.part[: len(v)], NO_ARMS))
    low, high = out["crotch"][2] - 20, out["waist_rig"][2]
    own = trunk[(v[trunk, 2] > low) & (v[trunk, 2] < high)]
    out["buttock"] = v[own[v[own, 1].argmax()]]
    return out


def planes(marks, stature):
    """Name -> (point, normal, parts, near or None) of every girth with one plane."""
    up = np.array([0.0, 0.0, 1.0])
    out = {
        "hip": (marks["buttock"], up, NO_ARMS, None),
        "waist_rig": (marks["waist_rig"], up, NO_ARMS, None),
        "navel": (marks["navel"], up, NO_ARMS, None),
        "chest": ((marks["nipple_l"] + marks["nipple_r"]) / 2, up, NO_ARMS, None),
    }
    axis = unit(marks["joint_head"] - marks["joint_neck"])
    centre = marks["joint_neck"] + axis * ((marks["larynx"] - marks["joint_neck"]) @ axis)
    out["neck"] = (marks["larynx"], axis, NO_ARMS, centre)
    for side, part in (("l", ARM_L), ("r", ARM_R)):
        a, b = marks[f"joint_shoulder_{side}"], marks[f"joint_elbow_{side}"]
        axis = unit(b - a)
        along = [(marks[f"{n}_{side}"] - a) @ axis for n in ("acromion", "elbow_tip")]
        point = a + axis * (sum(along) / 2)
        out[f"upper_arm_{side}"] = (point, axis, (part,), point)
    return out


def fullest(surface, marks, stature):
    """Thighs (horizontal, under the gluteal fold) and calves (square to the shank), where each is fullest."""
    out = {}
    for side, part in (("l", LEG_L), ("r", LEG_R)):
        crotch, knee = marks["crotch"][2], marks[f"joint_knee_{side}"]
        hip, up = marks[f"joint_hip_{side}"], np.array([0.0, 0.0, 1.0])
        # The ring about the bone, whosever its faces: the rig counts low buttocks, and some skin of the groin, as trunk.
        ring = lambda z: (hip + (hip[2] - z) / (hip[2] - knee[2]) * (knee - hip), up, (TRUNK, part))
        levels = crotch - np.linspace(0.012, 0.06, 9) * stature
        best = max((surface.tape(*ring(z), ring(z)[0]) or 0.0, z) for z in levels)[1]
        out[f"thigh_{side}"] = (*ring(best), ring(best)[0])
        shank = marks[f"joint_ankle_{side}"] - knee
        at = np.linspace(0.12, 0.6, 25)
        girths = np.array([surface.tape(knee + t * shank, shank, (part,), knee + t * shank) or 0.0 for t in at])
        # The knee's own girth is none of the calf's: the fullest of the levels fuller than both neighbours.
        peaks = 1 + np.flatnonzero((girths[1:-1] >= girths[:-2]) & (girths[1:-1] > girths[2:]))
        best = peaks[girths[peaks].argmax()] if len(peaks) else int(np.searchsorted(at, 0.3))
        point = knee + at[best] * shank
        out[f"calf_{side}"] = (point, unit(shank), (part,), point)
    return out


def rounded(values, digits=2):
    return [round(float(x), digits) for x in values]


def truth(body, v, heads, more_levels=None):
    """All of it as plain values: `stature`, `marks`, `planes` (point, normal, tape). `more_levels`: name -> z."""
    full = body.with_caps(v)
    surface = Surface(full, body.faces, body.face_part)
    stature = float(v[body.used[body.used < len(v)], 2].max())
    marks = landmarks(body, v, heads)
    all_planes = {**planes(marks, stature), **fullest(surface, marks, stature)}
    for name, z in (more_levels or {}).items():
        all_planes[name] = (np.array([0.0, 0.0, z]), np.array([0.0, 0.0, 1.0]), NO_ARMS, None)
    return surface, stature, marks, all_planes


def row(surface, written, stature, marks, all_planes):
    """The JSON row; `written` is the surface as written (remeshed or not), on which `tape` is taken."""
    rows = {}
    for name, (point, normal, parts, near) in all_planes.items():
        rows[name] = {
            "point": rounded(point),
            "normal": rounded(normal, 5),
            "tape": none_or(written.tape(point, normal, parts, near)),
            "tape_clean": none_or(surface.tape(point, normal, parts, near)),
        }
    return {
        "stature": round(stature, 2),
        "marks": {n: rounded(p) for n, p in marks.items()},
        "planes": rows,
    }


def none_or(x):
    return None if x is None else round(x, 2)
