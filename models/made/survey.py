"""The family `survey`: anny driven to the heights, girths and breadths of single persons of ANSUR II.

Gauss-Newton on anny's phenotype and local changes. The person stands as the survey's do (arms hanging, feet near), for
which the whole blend basis is skinned once, so that every measure is a function of a linear surface and its derivative
is exact. What the survey measured and what the body has in its place stand in the row as `target` and `achieved`.
"""
import csv

import numpy as np
import torch
from anny.shape_distribution import SimpleShapeDistribution
from scipy.spatial import ConvexHull

import families
from template import JOINTS
from pose import rotations, unit
from truth import ARM_L, LEG_L, NO_ARMS

PERSONS = 400
HANGING = families.even(14, 8, 0, 180)
PHENOTYPE = ["muscle", "weight", "height", "proportions", "cupsize", "firmness"]
# Spread that is held likely: phenotype around its middle, local changes as a share of their spread in `families`.
SPREAD_PHENOTYPE, SPREAD_LOCAL, LOCAL_END = 0.3, 1.6, 1.0
# How near each measure is wanted, mm.
WANTED = {
    "stature": 2, "crotchheight": 5, "buttockheight": 8, "axillaheight": 8, "acromialheight": 6, "cervicaleheight": 5,
    "suprasternaleheight": 6, "chestheight": 6, "waistheightomphalion": 8, "kneeheightmidpatella": 10,
    "acromionradialelength": 6, "radialestylionlength": 8, "biacromialbreadth": 8,
    "neckfront": 6, "waistcircumference": 6, "buttockcircumference": 6, "chestcircumference": 7, "neckcircumference": 4,
    "thighcircumference": 6, "calfcircumference": 5, "upperarm": 10,
    # Calipers press, and a chest's breadth and depth make no ellipse of its girth: girths go before.
    "chestbreadth": 40, "waistbreadth": 15, "hipbreadth": 15, "chestdepth": 15, "waistdepth": 15, "buttockdepth": 15,
}
# A relaxed upper arm of a flexed biceps' girth: roughly, and so weighed little.
RELAXED = 0.92
# The survey does not hold how high the larynx lies over the breastbone: anny's mean, as a share of stature.
NECK_FRONT = 0.034
HEIGHTS = {
    "axillaheight": ["axilla_l", "axilla_r"], "acromialheight": ["acromion_l", "acromion_r"],
    "cervicaleheight": ["cervicale"], "suprasternaleheight": ["suprasternale"], "chestheight": ["nipple_l", "nipple_r"],
    "waistheightomphalion": ["navel"],
}


def edges(f):
    return np.unique(np.sort(np.vstack([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]]), axis=1), axis=0)


class Linear:
    """A surface as a linear function of blend coefficients, in one pose: points = base + coefficients @ basis."""

    def __init__(self, body, rows, turned):
        w = body.weights
        rot = [None] * len(body.bones)
        for b, p in enumerate(body.parents):
            rot[b] = turned.get(b, np.eye(3) if p < 0 else rot[p])
        rot = np.array(rot)
        blended = (w @ rot.reshape(-1, 9)).reshape(-1, 3, 3)

        def skin(v, h):
            place = np.array(h)
            for b, p in enumerate(body.parents):
                if p >= 0:
                    place[b] = place[p] + rot[p] @ (h[b] - h[p])
            shift = place - np.einsum("bij,bj->bi", rot, h)
            return np.vstack([np.einsum("vij,vj->vi", blended, v) + w @ shift, place])

        self.base = skin(body.base_v, body.base_h)
        basis = [skin(1000.0 * body.blend_v[k], 1000.0 * body.blend_h[k]) for k in rows]
        self.basis = np.array(basis, dtype=np.float32).reshape(len(rows), -1)
        self.by_point = np.ascontiguousarray(self.basis.reshape(len(rows), -1, 3).transpose(1, 0, 2))

    def points(self, c):
        return self.base + (c.astype(np.float32) @ self.basis).reshape(-1, 3)

    def pull(self, at, weight):
        """Derivative by the coefficients of sum(weight[i] . point[at[i]])."""
        return np.einsum("ikj,ij->k", self.by_point[at], weight.astype(np.float32))


class Survey:
    def __init__(self, body, path):
        self.body = body
        with open(path) as f:
            people = list(csv.DictReader(f))
        rng = np.random.default_rng(families.SEEDS["survey"])
        women, men = ([k for k, p in enumerate(people) if p["sex"] == s] for s in "fm")
        half = PERSONS // 2
        pick = np.column_stack([rng.permutation(women)[:half], rng.permutation(men)[:half]]).ravel()
        self.people = [(int(k), people[k]) for k in pick]
        self.names = list(families.MIDDLE) + list(families.SIDES)
        self.spread = np.array([*[SPREAD_PHENOTYPE] * len(PHENOTYPE),
                                *[SPREAD_LOCAL * s for s in [*families.MIDDLE.values(), *families.SIDES.values()]]])
        first = len(body.blend_v) - 2 * len(body.locals)
        used = [n for n in body.locals if n in self.names or n[2:] in families.SIDES]
        own = sorted(first + 2 * body.locals.index(n) + k for n in used for k in (0, 1))
        self.rows = np.array([*range(first), *own])
        v, heads = body.shape({"age": 2 / 3})
        self.linear = Linear(body, self.rows, rotations(body, heads, HANGING))
        self.ages = SimpleShapeDistribution(body.anny).morphological_age_mapping
        faces, part = body.faces, body.face_part
        whole = (faces < len(body.base_v)).all(axis=1)
        self.edges = {p: edges(faces[whole & np.isin(part, p)]) for p in (NO_ARMS, (ARM_L,), (LEG_L,))}

    def coefficients(self, theta, fixed):
        """Rows of blend coefficients for rows of parameters."""
        theta = np.atleast_2d(theta)
        n = len(PHENOTYPE)
        phenotype = {k: torch.tensor(theta[:, i]) for i, k in enumerate(PHENOTYPE)}
        c = self.body.coefficients({**fixed, **phenotype}, self.local(theta[:, n:].T))
        return c.numpy()[:, self.rows]

    def local(self, values):
        out = {}
        for name, x in zip(self.names, values):
            x = torch.tensor(x) if np.ndim(x) else float(x)
            sides = ("l-", "r-") if name in families.SIDES else ("",)
            out.update({s + name: x for s in sides})
        return out

    def measures(self, c):
        """Name -> (value, derivative by the coefficients)."""
        p = self.linear.points(c)
        body, n = self.body, len(self.body.base_v)
        up = np.array([0.0, 0.0, 1.0])
        joint = {j: n + body.bone(JOINTS[j] + ".L") for j in JOINTS}
        v = p[:n]
        sole, top = int(v[:, 2].argmin()), int(v[:, 2].argmax())
        out = {}

        def height(at):
            at = np.atleast_1d(at)
            weight = np.vstack([np.tile(up / len(at), (len(at), 1)), -up])
            at = np.append(at, sole)
            return float((p[at] * weight).sum()), self.linear.pull(at, weight)

        def apart(a, b):
            a, b = np.atleast_1d(a), np.atleast_1d(b)
            d = p[a].mean(axis=0) - p[b].mean(axis=0)
            u = unit(d)
            weight = np.vstack([np.tile(u / len(a), (len(a), 1)), np.tile(-u / len(b), (len(b), 1))])
            return float(np.linalg.norm(d)), self.linear.pull(np.concatenate([a, b]), weight)

        marks = body.marks
        crotch = min(marks["crotch"], key=lambda i: v[i, 2])
        trunk = np.flatnonzero((body.part[:n] != 1) & (body.part[:n] != 2))
        back = trunk[(v[trunk, 2] > v[crotch, 2] - 20) & (v[trunk, 2] < v[body.waist_ring, 2].mean())]
        back = int(back[v[back, 1].argmax()])
        out["stature"] = height(top)
        out["crotchheight"], out["buttockheight"] = height(crotch), height(back)
        out["kneeheightmidpatella"] = height(joint["knee"])
        for name, own in HEIGHTS.items():
            out[name] = height(np.concatenate([marks[m] for m in own]))
        out["acromionradialelength"] = apart(marks["acromion_l"], joint["elbow"])
        out["radialestylionlength"] = apart(joint["elbow"], joint["wrist"])
        out["biacromialbreadth"] = apart(marks["acromion_l"], marks["acromion_r"])
        out["neckfront"] = apart(marks["larynx"], marks["suprasternale"])
        nipples = marks["nipple_l"] + marks["nipple_r"]
        stature = out["stature"][0]
        for name, at in (("waist", marks["navel"]), ("buttock", [back]), ("chest", nipples)):
            tape, breadth, depth = self.section(p, NO_ARMS, at, up, np.zeros(3))
            out[name + "circumference"] = tape
            out[{"buttock": "hip"}.get(name, name) + "breadth"], out[name + "depth"] = breadth, depth
        head, neck = n + body.bone("head"), n + body.bone("neck01")
        axis = unit(p[head] - p[neck])
        out["neckcircumference"] = self.section(p, NO_ARMS, marks["larynx"], axis, np.zeros(3), 0.06 * stature)[0]
        under = -0.012 * stature * up
        out["thighcircumference"] = self.section(p, (LEG_L,), [crotch], up, under)[0]
        shank = p[joint["ankle"]] - p[joint["knee"]]
        out["calfcircumference"] = self.section(p, (LEG_L,), [joint["knee"]], unit(shank), 0.3 * shank)[0]
        arm = p[joint["elbow"]] - p[joint["shoulder"]]
        out["upperarm"] = self.section(p, (ARM_L,), [joint["shoulder"]], unit(arm), 0.5 * arm)[0]
        return out

    def section(self, p, parts, at, normal, shift, reach=None):
        """Tape, breadth and depth (value, derivative) where the plane through the mean of points `at`, moved by `shift`,
        cuts the parts; `reach`: only what lies as near as this to the point."""
        e = self.edges[parts]
        point = p[at].mean(axis=0) + shift
        d = (p - point) @ normal
        e = e[(d[e[:, 0]] > 0) != (d[e[:, 1]] > 0)]
        a, b = e[:, 0], e[:, 1]
        t = (d[a] / (d[a] - d[b]))[:, None]
        q = p[a] * (1 - t) + p[b] * t
        if reach is not None:
            # The plane through the larynx meets the neck behind it, and else only the shoulders at either side.
            near = np.abs(q[:, 0] - point[0]) < reach
            a, b, t, q = a[near], b[near], t[near], q[near]
        x = unit(np.cross(normal, [0.0, 1.0, 0.0]) * -1 if abs(normal[1]) < 0.9 else np.cross(normal, [1.0, 0.0, 0.0]))
        y = np.cross(normal, x)
        hull = ConvexHull(np.column_stack([q @ x, q @ y])).vertices
        side = np.roll(q[hull], -1, axis=0) - q[hull]
        long = np.linalg.norm(side, axis=1)
        u = side / long[:, None]
        wide = (hull[(q[hull] @ x).argmax()], hull[(q[hull] @ x).argmin()])
        deep = (hull[(q[hull] @ y).argmax()], hull[(q[hull] @ y).argmin()])

        def through(which, pull):
            """Carries pulls on section points to pulls on the ends of their edges and on the plane's points."""
            s, ea, eb = t[which], p[a[which]], p[b[which]]
            run = (pull * (eb - ea)).sum(axis=1) / ((eb - ea) @ normal)
            on_edge = pull - run[:, None] * normal
            weight = np.vstack([on_edge * (1 - s), on_edge * s, np.tile(run.sum() * normal / len(at), (len(at), 1))])
            return self.linear.pull(np.concatenate([a[which], b[which], at]), weight)

        tape = float(long.sum()), through(hull, np.roll(u, 1, axis=0) - u)
        breadth, depth = (
            (float((q[i] - q[j]) @ w), through(np.array([i, j]), np.array([w, -w]))) for (i, j), w in ((wide, x), (deep, y))
        )
        return tape, breadth, depth

    def fitted(self, person, fixed):
        """Parameters of the body nearest to the person, and its measures."""
        n = len(PHENOTYPE)
        start = np.array([0.5] * n + [0.0] * len(self.names))
        low, high = np.array([0.0] * n + [-LOCAL_END] * len(self.names)), np.full(len(start), LOCAL_END)
        want = {k: float(person[k]) for k in WANTED if k in person}
        want["neckfront"] = NECK_FRONT * want["stature"]
        want["upperarm"] = RELAXED * float(person["bicepscircumferenceflexed"])
        sigma = np.array(list(WANTED.values()), dtype=float)
        prior = 1.0 / self.spread**2

        def cost(x, c):
            got = self.measures(c)
            miss = np.array([want[k] - got[k][0] for k in WANTED]) / sigma
            return float(miss @ miss + prior @ (x - start) ** 2), miss, got

        theta = start.copy()
        now = cost(theta, self.coefficients(theta, fixed)[0])
        for _ in range(12):
            step = 1e-3 * np.where(theta > 0.5, -1.0, 1.0)
            c = self.coefficients(np.vstack([theta, theta + np.diag(step)]), fixed)
            slope = (c[1:] - c[0]) / step[:, None]
            total, miss, got = now
            jac = np.array([slope @ got[k][1] for k in WANTED]) / sigma[:, None]
            move = np.linalg.solve(jac.T @ jac + np.diag(prior), jac.T @ miss - prior * (theta - start))
            for part in (1.0, 0.5, 0.25, 0.1, 0.03):
                to = np.clip(theta + part * move, low, high)
                then = cost(to, self.coefficients(to, fixed)[0])
                if then[0] < total:
                    break
            else:
                break
            theta, now = to, then
            if total - now[0] < 0.1:
                break
        got = self.measures(self.coefficients(theta, fixed)[0])
        return theta, want, {k: got[k][0] for k in WANTED}

    def body_of(self, number):
        """What `make_bodies.make` needs of one person."""
        line, person = self.people[number]
        rng = families.stream("survey", number)
        age = self.ages.morphological_to_anny_age(torch.tensor([float(person["age"])], dtype=torch.float64))
        races = rng.dirichlet([1.0, 1.0, 1.0])
        fixed = {"gender": float(person["sex"] == "f"), "age": float(age[0]),
                 **dict(zip(("african", "asian", "caucasian"), map(float, races)))}
        theta, want, got = self.fitted(person, fixed)
        phenotype = {**fixed, **dict(zip(PHENOTYPE, map(float, theta)))}
        local = self.local(theta[len(PHENOTYPE):])
        v, heads = self.body.shape(phenotype, local)
        pose = families.stance(rng, np.ptp(v[:, 2]), arms=(12.0, 50.0), elbows=(0.0, 20.0))
        about = {"years": int(person["age"]), "line": line, "phenotype": phenotype, "local": local,
                 "target": want, "achieved": got,
                 "person": {k: float(x) for k, x in person.items() if k != "sex"}}
        return v, heads, pose, about, lambda marks: self.levels(person, marks)

    @staticmethod
    def levels(person, marks):
        """The person's waist, rib and iliac crest on the body: linear between what lies below (crotch, buttock) and
        above (cervicale, suprasternale) on both."""
        x = {k: float(y) for k, y in person.items() if k != "sex"}
        low = (x["crotchheight"] + x["buttockheight"]) / 2, (marks["crotch"][2] + marks["buttock"][2]) / 2
        high = (x["cervicaleheight"] + x["suprasternaleheight"]) / 2, (marks["cervicale"][2] + marks["suprasternale"][2]) / 2
        rib, crest = x["tenthribheight"], x["iliocristaleheight"]
        scale = (high[1] - low[1]) / (high[0] - low[0])
        return {n: float(low[1] + (z - low[0]) * scale) for n, z in
                (("waist", (rib + crest) / 2), ("rib", rib), ("crest", crest))}
