"""Puts a body in a pose: limbs to given directions, soles flat on the ground, by linear blend skinning.

A pose names angles in degrees: `arm_l`, `arm_r` (upper arm from straight down, in the frontal plane), `elbow_l`,
`elbow_r` (0 is straight), `roll_l`, `roll_r` (forearm about the upper arm, inward), `swing_l`, `swing_r` (upper arm
forward), `knee` (flexion, both), `knee_l`, `knee_r`, `step_l`, `step_r` (leg forward), `lean`, `turn`, `nod`; and `feet`, the
distance between the ankles in millimetres.
"""
import numpy as np
from scipy.spatial.transform import Rotation

NEUTRAL = {"feet": 200.0, "knee": 0.0, "lean": 0.0, "turn": 0.0, "nod": 0.0}


def unit(v):
    return v / np.linalg.norm(v)


def between(a, b):
    """The smallest rotation that brings direction a to b."""
    a, b = unit(a), unit(b)
    axis = np.cross(a, b)
    s = np.linalg.norm(axis)
    if s < 1e-9:
        return np.eye(3)
    return Rotation.from_rotvec(axis / s * np.arctan2(s, a @ b)).as_matrix()


def about(axis, degrees):
    return Rotation.from_rotvec(np.radians(degrees) * unit(np.asarray(axis, dtype=float))).as_matrix()


def rotations(body, heads, pose):
    """World rotation of every bone that is set; the others follow their parent."""
    pose = {**NEUTRAL, **pose}
    turned = {}
    trunk = about([1, 0, 0], pose["lean"]) @ about([0, 0, 1], pose["turn"])
    turned["spine05"] = trunk
    turned["neck01"] = about([1, 0, 0], pose["nod"] / 2) @ trunk
    turned["head"] = about([1, 0, 0], pose["nod"]) @ trunk
    for side, s in (("L", 1.0), ("R", -1.0)):
        low = side.lower()
        at = {n: heads[body.bone(f"{n}.{side}")] for n in ("upperarm01", "lowerarm01", "wrist", "upperleg01", "foot")}
        upper, fore = at["lowerarm01"] - at["upperarm01"], at["wrist"] - at["lowerarm01"]
        rest = np.degrees(np.arctan2(s * upper[0], -upper[2]))
        more = pose[f"arm_{low}"] - rest
        # The girdle takes part: a tenth of the way by the clavicle above the rest pose, a fifth by the shoulder.
        turned[f"clavicle.{side}"] = about([0, -s, 0], 0.1 * max(more, 0.0)) @ trunk
        turned[f"shoulder01.{side}"] = about([0, -s, 0], 0.1 * max(more, 0.0) + 0.15 * more) @ trunk
        a, w = np.radians(pose[f"arm_{low}"]), np.radians(pose.get(f"swing_{low}", 0.0))
        goal = np.array([s * np.sin(a), -np.sin(w) * np.cos(a), -np.cos(w) * np.cos(a)])
        first = about([0, -s, 0], more)
        raised = between(first @ upper, goal) @ first
        turned[f"upperarm01.{side}"] = raised
        hinge = unit(np.cross(raised @ upper, raised @ fore))
        bent = about(-s * goal, pose.get(f"roll_{low}", 0.0)) @ about(hinge, pose[f"elbow_{low}"]) @ goal
        turned[f"lowerarm01.{side}"] = between(raised @ fore, bent) @ raised
        leg = at["foot"] - at["upperleg01"]
        wanted = np.arcsin(np.clip((pose["feet"] / 2 - s * at["upperleg01"][0]) / np.linalg.norm(leg), -0.9, 0.9))
        has = np.arctan2(s * leg[0], -leg[2])
        side_step = about([0, -s, 0], np.degrees(wanted - has))
        k, step = pose.get(f"knee_{low}", pose["knee"]), pose.get(f"step_{low}", 0.0)
        turned[f"upperleg01.{side}"] = side_step @ about([1, 0, 0], -k / 2 - step)
        turned[f"lowerleg01.{side}"] = side_step @ about([1, 0, 0], k / 2 - step)
        turned[f"foot.{side}"] = np.eye(3)
    return {body.bone(n): r for n, r in turned.items()}


def carried(body, heads, turned):
    """World rotation and place of every bone."""
    rot, place = [None] * len(heads), np.array(heads)
    for b, p in enumerate(body.parents):
        parent = np.eye(3) if p < 0 else rot[p]
        rot[b] = turned.get(b, parent)
        if p >= 0:
            place[b] = place[p] + parent @ (heads[b] - heads[p])
    return np.array(rot), place


def skinned(body, v, heads, turned):
    """Vertices and bone heads, posed, the soles at z = 0 and the pelvis above the middle."""
    rot, place = carried(body, heads, turned)
    shift = place - np.einsum("bij,bj->bi", rot, heads)
    blended = (body.weights @ rot.reshape(-1, 9)).reshape(-1, 3, 3)
    out = np.einsum("vij,vj->vi", blended, v) + body.weights @ shift
    root = place[body.bone("root")] * [1, 1, 0] + [0, 0, out[:, 2].min()]
    return out - root, place - root


def posed(body, v, heads, pose):
    return skinned(body, v, heads, rotations(body, heads, pose))
