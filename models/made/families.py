"""What bodies each family holds: shape and pose, drawn from a seed of the family and the body's number."""
import numpy as np

SEEDS = {"range": 1101, "survey": 1102, "poses": 1103, "reach": 1104, "again": 1105}
COUNTS = {"range": 400, "survey": 400, "poses": 76, "reach": 60}

# Local changes of both sides together or of the middle: name -> spread (1 is anny's own end).
MIDDLE = {
    "torso-scale-depth-incr": 0.3,
    "torso-scale-horiz-incr": 0.3,
    "torso-scale-vert-incr": 0.3,
    "torso-vshape-incr": 0.3,
    "torso-muscle-pectoral-incr": 0.3,
    "torso-muscle-dorsi-incr": 0.3,
    "measure-underbust-circ-incr": 0.25,
    "measure-bust-circ-incr": 0.25,
    "measure-waist-circ-incr": 0.3,
    "measure-hips-circ-incr": 0.25,
    "measure-napetowaist-dist-incr": 0.25,
    "measure-waisttohip-dist-incr": 0.25,
    "measure-shoulder-dist-incr": 0.25,
    "measure-frontchest-dist-incr": 0.25,
    "stomach-tone-incr": 0.4,
    "stomach-navel-up": 0.3,
    "stomach-pregnant-incr": 0.12,
    "pelvis-tone-incr": 0.3,
    "buttocks-volume-incr": 0.4,
    "hip-scale-horiz-incr": 0.3,
    "hip-scale-depth-incr": 0.3,
    "hip-scale-vert-incr": 0.25,
    "hip-waist-up": 0.3,
    "breast-trans-up": 0.3,
    "breast-dist-incr": 0.3,
    "breast-volume-vert-up": 0.3,
    "neck-scale-depth-incr": 0.35,
    "neck-scale-horiz-incr": 0.35,
    "neck-scale-vert-incr": 0.35,
    "neck-double-incr": 0.35,
    "neck-trans-forward": 0.25,
    "neck-back-scale-depth-incr": 0.3,
    "measure-neck-circ-incr": 0.25,
    "measure-neck-height-incr": 0.3,
    "chin-jaw-drop-incr": 0.3,
    "chin-height-incr": 0.3,
    "chin-prominent-incr": 0.3,
    "head-fat-incr": 0.25,
    "head-scale-depth-incr": 0.2,
    "head-scale-horiz-incr": 0.2,
    "measure-upperarm-length-incr": 0.25,
    "measure-lowerarm-length-incr": 0.25,
    "measure-upperleg-height-incr": 0.25,
    "measure-lowerleg-height-incr": 0.25,
    "measure-thigh-circ-incr": 0.2,
    "measure-calf-circ-incr": 0.2,
    "measure-upperarm-circ-incr": 0.2,
}
SIDES = {
    "upperarm-fat-incr": 0.3,
    "upperarm-muscle-incr": 0.3,
    "upperarm-shoulder-muscle-incr": 0.3,
    "upperarm-scale-horiz-incr": 0.2,
    "lowerarm-fat-incr": 0.25,
    "lowerarm-muscle-incr": 0.25,
    "upperleg-fat-incr": 0.3,
    "upperleg-muscle-incr": 0.3,
    "upperleg-scale-depth-incr": 0.2,
    "upperleg-scale-horiz-incr": 0.2,
    "lowerleg-fat-incr": 0.3,
    "lowerleg-muscle-incr": 0.3,
    "leg-valgus-incr": 0.25,
}
UNEVEN = 0.08


def stream(family, number):
    """The body's own random numbers, whatever other bodies are made."""
    return np.random.default_rng([SEEDS[family], number])


def phenotype(body, rng, children=0.25):
    """anny's own distribution over age, height and weight; sex continuous, cup, firmness and races even."""
    import torch
    from anny.shape_distribution import SimpleShapeDistribution

    torch.manual_seed(int(rng.integers(2**31)))
    shapes = SimpleShapeDistribution(body.anny)
    years = rng.uniform(1.0, 18.0) if rng.random() < children else rng.uniform(18.0, 85.0)
    shapes.morphological_age_distribution = torch.distributions.Uniform(
        torch.tensor(years - 1e-3, dtype=torch.float64), torch.tensor(years + 1e-3, dtype=torch.float64)
    )
    _, kwargs = shapes.sample(1)
    out = {k: float(x[0]) for k, x in kwargs.items()}
    # Half of the bodies are plainly women or men, half lie between.
    if rng.random() < 0.5:
        out["gender"] = float(rng.random() < 0.5)
    return years, out


def local_changes(rng, scale=1.0):
    out = {n: clipped(rng, s * scale) for n, s in MIDDLE.items()}
    out["stomach-pregnant-incr"] = abs(out["stomach-pregnant-incr"])
    for n, s in SIDES.items():
        both = clipped(rng, s * scale)
        out["l-" + n] = both + clipped(rng, UNEVEN)
        out["r-" + n] = both + clipped(rng, UNEVEN)
    return out


def clipped(rng, s):
    return float(np.clip(rng.normal(0.0, s), -2.0 * s, 2.0 * s))


def stance(rng, stature, arms=(15.0, 60.0), elbows=(0.0, 25.0)):
    """A standing pose: arms within a range, moderately unlike each other, feet apart, a little lean and nod."""
    arm, elbow = rng.uniform(*arms), rng.uniform(*elbows)
    return {
        "arm_l": float(np.clip(arm + rng.normal(0, 3), arms[0] - 2, arms[1] + 5)),
        "arm_r": float(np.clip(arm + rng.normal(0, 3), arms[0] - 2, arms[1] + 5)),
        "elbow_l": float(np.clip(elbow + rng.normal(0, 4), 0, elbows[1] + 8)),
        "elbow_r": float(np.clip(elbow + rng.normal(0, 4), 0, elbows[1] + 8)),
        "swing_l": float(rng.normal(0, 4)),
        "swing_r": float(rng.normal(0, 4)),
        "feet": float(rng.uniform(0.10, 0.24) * stature),
        "knee": float(abs(rng.normal(0, 3))),
        "lean": float(rng.normal(0, 1.0)),
        "turn": float(rng.normal(0, 1.5)),
        "nod": float(rng.normal(0, 4.0)),
    }


def pose_grid():
    """Each made person of the family `poses`: arms x elbows with straight knees, then knees and feet."""
    out = []
    for sex in (1.0, 0.0):
        for k, arm in enumerate((15, 30, 45, 60, 75, 90)):
            for e, elbow in enumerate((0, 40, 80)):
                for knee in (0, 20) if elbow != 40 else (0,):
                    feet = (100, 150, 200, 250, 300)[(k + 2 * e + knee // 20) % 5]
                    out.append((sex, even(arm, elbow, knee, feet)))
        for feet in (100, 160, 220, 300):
            for knee in (0, 20):
                out.append((sex, even(45, 10, knee, feet)))
    return out


def even(arm, elbow, knee, feet):
    return {"arm_l": arm, "arm_r": arm, "elbow_l": elbow, "elbow_r": elbow, "knee": knee, "feet": feet}
