"""All solutions of an arm of DH rows by Newton's method from many starts at once; imports nothing of ours."""

import numpy as np
from scipy.ndimage import label
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components


def link(kind, a, alpha, d, theta, q):
    """A(q) of many q, (k, 4, 4): Rot_z(θ) Trans_z(d) Trans_x(a) Rot_x(α)."""
    angle = theta + (q if kind == "R" else 0.0) + 0 * q
    height = d + (q if kind == "P" else 0.0) + 0 * q
    c, s, ca, sa, zero = np.cos(angle), np.sin(angle), np.cos(alpha), np.sin(alpha), 0 * q
    rows = [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [zero, zero + sa, zero + ca, height]]
    A = np.zeros((len(q), 4, 4))
    A[:, :3] = np.array(rows).transpose(2, 0, 1)
    A[:, 3, 3] = 1.0
    return A


def pose_and_jacobian(rows, q, tool):
    """The pose (k, 4, 4) of a point `tool` (3,) in the last frame, and its geometric Jacobian (k, 6, n)."""
    T = np.broadcast_to(np.eye(4), (len(q), 4, 4))
    frames = [T]
    for i, row in enumerate(rows):
        T = T @ link(*row, q[:, i])
        frames.append(T)
    end = T.copy()
    end[:, :3, 3] += T[:, :3, :3] @ tool
    J = np.zeros((len(q), 6, len(rows)))
    for i, row in enumerate(rows):
        z, o = frames[i][:, :3, 2], frames[i][:, :3, 3]
        J[:, :3, i] = np.cross(z, end[:, :3, 3] - o) if row[0] == "R" else z
        J[:, 3:, i] = z if row[0] == "R" else 0.0
    return end, J


def rotation_vector(M):
    """log3 of many rotations, (k, 3), good where they are small."""
    axis = 0.5 * np.stack([M[:, 2, 1] - M[:, 1, 2], M[:, 0, 2] - M[:, 2, 0], M[:, 1, 0] - M[:, 0, 1]], axis=1)
    sine, cosine = np.linalg.norm(axis, axis=1), 0.5 * (np.trace(M, axis1=1, axis2=2) - 1)
    return axis * (np.arctan2(sine, cosine) / np.maximum(sine, 1e-12))[:, None]


def apart(kinds, p, q):
    """max |p − q|, angles the short way round."""
    return np.abs(np.where(np.array(list(kinds)) == "R", np.angle(np.exp(1j * (p - q))), p - q)).max(axis=-1)


def all_solutions(rows, target, which, *, tool=(0, 0, 0), starts=400, seed=0, reach=3.0, steps=60):
    """The q, (k, n), at which the rows `which` of the pose of the tool are those of the target (4, 4)."""
    rng, kinds = np.random.default_rng(seed), [row[0] for row in rows]
    spread = np.where(np.array(kinds) == "R", np.pi, reach)
    q = rng.uniform(-1, 1, (starts, len(rows))) * spread
    for _ in range(steps):
        T, J = pose_and_jacobian(rows, q, np.array(tool, dtype=float))
        turn = rotation_vector(target[:3, :3] @ T[:, :3, :3].transpose(0, 2, 1))
        e = np.concatenate([target[:3, 3] - T[:, :3, 3], turn], axis=1)[:, which]
        A = J[:, which]
        damping = 1e-3 * np.minimum(1.0, (e**2).sum(axis=1))[:, None, None] + 1e-24
        H = A @ A.transpose(0, 2, 1) + damping * np.eye(len(which))
        step = (A.transpose(0, 2, 1) @ (np.linalg.pinv(H, hermitian=True) @ e[..., None]))[..., 0]
        q = q + step / np.maximum(1.0, np.abs(step / spread).max(axis=1, keepdims=True))
    reached = q[np.abs(e).max(axis=1) < 1e-9]
    found = []
    for p in reached:
        if all(apart(kinds, p, other) > 1e-5 for other in found):
            found.append(p)
    return np.array(found).reshape(-1, len(rows))


def curves_of_equal(first, second):
    """The number of closed curves first(x) = second(y) on a torus, from values at points all around: a flood fill."""
    above = first[:, None] > second
    x_changes, y_changes = above != np.roll(above, 1, 0), above != np.roll(above, 1, 1)
    crossed = x_changes | y_changes | np.roll(x_changes, 1, 1) | np.roll(y_changes, 1, 0)
    parts, count = label(crossed, np.ones((3, 3)))
    seams = [(a, np.roll(b, s)) for a, b in ((parts[0], parts[-1]), (parts[:, 0], parts[:, -1])) for s in (-1, 0, 1)]
    joined = np.array([(i, j) for a, b in seams for i, j in zip(a, b, strict=True) if i and j]).reshape(-1, 2) - 1
    graph = coo_array((np.ones(len(joined)), joined.T), shape=(count, count))
    return connected_components(graph, directed=False)[0]
