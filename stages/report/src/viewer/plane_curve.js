// Where a plane cuts a surface, and lengths of closed curves in a plane: as the program's own (room measure, folder geometry).
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const plus = (a, b, k) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const crossed = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => { const n = Math.hypot(...a); return a.map((x) => x / n); };
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
// A surface whose equal vertices are one, for atlases split them: points, corners, mean length of its edges.
const welded = (m) => {
  const known = new Map(), points = [], names = new Uint32Array(m.at.length / 3);
  for (let v = 0; v < names.length; v++) {
    const p = [m.at[3 * v], m.at[3 * v + 1], m.at[3 * v + 2]], key = p.join();
    let name = known.get(key);
    if (name === undefined) { name = points.length; known.set(key, name); points.push(p); }
    names[v] = name;
  }
  const index = Uint32Array.from(m.index, (v) => names[v]);
  let sum = 0;
  for (let i = 0; i < index.length; i += 3) for (let k = 0; k < 3; k++) sum += distance(points[index[i + k]], points[index[i + (k + 1) % 3]]);
  return { points, index, edge: sum / Math.max(1, index.length) };
};
// The least-squares plane: its normal belongs to the least eigenvalue of the spread (Jacobi's rotations).
const fittedPlane = (points) => {
  if (points.length < 3) return null;
  const middle = points.reduce((s, p) => plus(s, p, 1 / points.length), [0, 0, 0]);
  const a = [[0, 0, 0], [0, 0, 0], [0, 0, 0]], v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (const p of points) { const d = minus(p, middle); for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) a[i][j] += d[i] * d[j]; }
  for (let sweep = 0; sweep < 30; sweep++) for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
    if (Math.abs(a[p][q]) < 1e-300) continue;
    const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]), t = (theta < 0 ? -1 : 1) / (Math.abs(theta) + Math.hypot(theta, 1)), c = 1 / Math.hypot(t, 1), s = t * c;
    for (let k = 0; k < 3; k++) { const [x, y] = [a[k][p], a[k][q]]; a[k][p] = c * x - s * y; a[k][q] = s * x + c * y; }
    for (let k = 0; k < 3; k++) { const [x, y] = [a[p][k], a[q][k]]; a[p][k] = c * x - s * y; a[q][k] = s * x + c * y; }
    for (let k = 0; k < 3; k++) { const [x, y] = [v[k][p], v[k][q]]; v[k][p] = c * x - s * y; v[k][q] = s * x + c * y; }
  }
  const least = [0, 1, 2].reduce((l, i) => (a[i][i] < a[l][l] ? i : l), 0);
  return { point: middle, normal: unit([v[0][least], v[1][least], v[2][least]]) };
};
// Two directions that span a plane, and points in them.
const axesOf = (plane) => {
  const n = plane.normal, other = Math.abs(n[2]) > 0.9 ? [1, 0, 0] : [0, 0, 1], u = unit(plus(other, n, -dot(n, other)));
  return [u, crossed(n, u)];
};
const flattened = (curve, plane, from) => { const [u, v] = axesOf(plane); return curve.map((x) => [dot(u, minus(x, from)), dot(v, minus(x, from))]); };
// The closed curves in which a plane cuts a surface. A vertex in the plane counts as above it.
const section = (s, plane) => {
  const height = s.points.map((p) => dot(plane.normal, minus(p, plane.point))), next = new Map(), n = s.points.length;
  for (let i = 0; i < s.index.length; i += 3) {
    let enters = null, leaves = null;
    for (let k = 0; k < 3; k++) {
      const a = s.index[i + k], b = s.index[i + (k + 1) % 3], up = height[a] >= 0;
      if (up === height[b] >= 0) continue;
      const edge = Math.min(a, b) * n + Math.max(a, b);
      if (up) leaves = edge; else enters = edge;
    }
    if (leaves !== null && enters !== null) next.set(leaves, enters);
  }
  const place = (edge) => { const a = Math.floor(edge / n), b = edge % n, pa = s.points[a]; return plus(pa, minus(s.points[b], pa), height[a] / (height[a] - height[b])); };
  const loops = [];
  for (const start of [...next.keys()]) {
    const curve = [];
    let at = start;
    while (next.has(at)) { const to = next.get(at); next.delete(at); curve.push(place(at)); at = to; }
    if (at === start && curve.length > 2) loops.push(curve);
  }
  return loops;
};
const around2 = (points, f) => points.reduce((sum, p, i) => sum + f(p, points[(i + 1) % points.length]), 0);
const lengthOf = (points) => around2(points, (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]));
const areaOf = (points) => Math.abs(around2(points, (a, b) => a[0] * b[1] - b[0] * a[1]) / 2);
// The convex hull (Andrew 1979): the tape; as places in the list.
const hullOf = (points) => {
  const order = points.map((_, i) => i).sort((i, j) => points[i][0] - points[j][0] || points[i][1] - points[j][1]);
  const turns = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const chain = (list) => {
    const kept = [];
    for (const i of list) { while (kept.length > 1 && turns(points[kept[kept.length - 2]], points[kept[kept.length - 1]], points[i]) <= 0) kept.pop(); kept.push(i); }
    kept.pop();
    return kept;
  };
  return [...chain(order), ...chain([...order].reverse())];
};
