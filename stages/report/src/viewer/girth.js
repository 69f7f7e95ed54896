// The paper's girth through picked points (section III-E): plane, more points (eq. 8), closed spline; and the tape. As `measure::picked` has it.
// Points of a surface in the box of a curve, three mean edges larger.
const beside = (s, curve) => {
  const lo = [0, 1, 2].map((k) => Math.min(...curve.map((p) => p[k])) - 3 * s.edge), hi = [0, 1, 2].map((k) => Math.max(...curve.map((p) => p[k])) + 3 * s.edge);
  return s.points.filter((p) => p.every((x, k) => x >= lo[k] && x <= hi[k]));
};
// The plane through a curve, fitted again to the points within a mean edge of it until it stands still.
const settled = (near, threshold, curve) => {
  let plane = fittedPlane(curve), points = [];
  for (let i = 0; i < 20 && plane; i++) {
    const old = plane;
    points = near.filter((x) => Math.abs(dot(old.normal, minus(x, old.point))) <= threshold);
    plane = fittedPlane(points);
    if (!plane) return null;
    const turned = Math.hypot(...crossed(old.normal, plane.normal)), moved = Math.abs(dot(old.normal, minus(plane.point, old.point)));
    if (turned < 1e-6 && moved < 1e-4 * threshold) break;
  }
  return plane && { plane, points };
};
// Solves a dense system for several right sides at once; null if it has no solution.
const solved = (a, right) => {
  const n = a.length;
  for (let i = 0; i < n; i++) {
    let best = i;
    for (let r = i + 1; r < n; r++) if (Math.abs(a[r][i]) > Math.abs(a[best][i])) best = r;
    if (a[best][i] === 0) return null;
    for (const list of [a, ...right]) [list[i], list[best]] = [list[best], list[i]];
    for (let r = i + 1; r < n; r++) {
      const k = a[r][i] / a[i][i];
      if (k === 0) continue;
      for (let c = i; c < n; c++) a[r][c] -= k * a[i][c];
      for (const x of right) x[r] -= k * x[i];
    }
  }
  for (const x of right) for (let i = n - 1; i >= 0; i--) { for (let c = i + 1; c < n; c++) x[i] -= a[i][c] * x[c]; x[i] /= a[i][i]; }
  return right;
};
// Length of the closed cubic spline through knots, parametrised by chords; Simpson's rule over eight parts a piece.
const closedSpline = (knots) => {
  const n = knots.length, h = knots.map((k, i) => Math.hypot(knots[(i + 1) % n][0] - k[0], knots[(i + 1) % n][1] - k[1]));
  if (n < 4 || h.some((x) => x < 1e-9)) return null;
  const a = knots.map(() => new Array(n).fill(0)), right = [new Array(n).fill(0), new Array(n).fill(0)];
  for (let i = 0; i < n; i++) {
    const before = (i + n - 1) % n, after = (i + 1) % n;
    a[i][before] += h[before]; a[i][i] += 2 * (h[before] + h[i]); a[i][after] += h[i];
    for (const c of [0, 1]) right[c][i] = 6 * ((knots[after][c] - knots[i][c]) / h[i] - (knots[i][c] - knots[before][c]) / h[before]);
  }
  const second = solved(a, right);
  if (!second) return null;
  let total = 0;
  for (let i = 0; i < n; i++) {
    const after = (i + 1) % n, speed = (t) => Math.hypot(...[0, 1].map((c) => {
      const m0 = second[c][i], m1 = second[c][after];
      return (knots[after][c] - knots[i][c]) / h[i] - h[i] / 6 * (m1 - m0) + (m1 * t * t - m0 * (1 - t) * (1 - t)) * h[i] / 2;
    }));
    for (let k = 0; k < 8; k++) total += (speed(k / 8) + 4 * speed(k / 8 + 1 / 16) + speed(k / 8 + 1 / 8)) / 48 * h[i];
  }
  return total;
};
// Points in turn around their middle, gathered in bins of the angle, joined by a spline.
const splineLength = (points, plane) => {
  const count = Math.min(72, Math.max(36, Math.floor(points.length / 4)));
  const middle = points.reduce((s, p) => plus(s, p, 1 / points.length), [0, 0, 0]), bins = Array.from({ length: count }, () => [0, 0, 0]);
  for (const [x, y] of flattened(points, plane, middle)) {
    const turn = Math.atan2(y, x) / (2 * Math.PI), bin = bins[Math.min(count - 1, Math.floor((turn < 0 ? turn + 1 : turn) * count))];
    bin[0] += x; bin[1] += y; bin[2]++;
  }
  return closedSpline(bins.filter((b) => b[2]).map((b) => [b[0] / b[2], b[1] / b[2]]));
};
// The spline's length for a curve of the surface: only points near the curve are added.
const paperGirth = (s, curve) => {
  const n = curve.length, reach = 1.5 * s.edge;
  const close = (p) => curve.some((a, i) => {
    const along = minus(curve[(i + 1) % n], a), t = Math.max(0, Math.min(1, dot(along, minus(p, a)) / Math.max(1e-12, dot(along, along))));
    return distance(p, plus(a, along, t)) < reach;
  });
  const grown = settled(beside(s, curve).filter(close), s.edge, curve);
  return grown && splineLength(grown.points, grown.plane);
};
// Tape, contour and spline [mm] through points, and the tape's own points; or why there is none.
const girthThrough = (s, points) => {
  const first = fittedPlane(points), middle = first.point;
  const wide = Math.max(...points.map((p) => Math.hypot(...crossed(minus(p, middle), minus(points[0], middle)))));
  if (wide < 1) return { why: "these points lie on one line: pick around the body" };
  const grown = settled(beside(s, points), s.edge, points), none = { why: "the plane through these points meets no closed section near them: pick around one limb, or around the trunk" };
  if (!grown) return none;
  const reach = Math.max(...points.map((p) => distance(p, middle))), plane = grown.plane;
  const rings = section(s, plane).map((curve) => ({ curve, flat: flattened(curve, plane, plane.point) })).map((r) => ({ ...r, area: areaOf(r.flat) }));
  const least = 0.01 * Math.max(...rings.map((r) => r.area)), off = (curve) => Math.max(...points.map((p) => Math.min(...curve.map((c) => distance(c, p)))));
  // The ring that the picked points lie on; the larger one of two as near.
  const ring = rings.filter((r) => r.area >= least).sort((a, b) => b.area - a.area).map((r) => ({ ...r, off: off(r.curve) })).reduce((a, b) => (a && a.off <= b.off ? a : b), null);
  if (!ring || ring.off >= 0.5 * reach) return none;
  const spline = paperGirth(s, ring.curve), tape = hullOf(ring.flat);
  if (spline === null) return none;
  return { tape: lengthOf(tape.map((i) => ring.flat[i])), contour: lengthOf(ring.flat), spline, normal: plane.normal, around: tape.flatMap((i) => ring.curve[i]) };
};
