"""The right-hand side of the model in numba: slices or Gauss nodes, as a careful user would write it.

Compiled loops over scalars, nothing allocated inside, balls that touch nothing cost a comparison, and of the
slices only those are visited that can touch: ball and groove are two circles in the meridional plane, whose cuts
end the zone; Gauss nodes lie between these. In a contact the local frame (n, t, z) keeps a slice short. It
covers what the preset ``wheel_bearing`` needs: the ISO law, Hunt-Crossley damping, Coulomb friction, cage,
supports of the rings, constant loads, a given speed, and one defect of constant width and two edge circles a row
on the outer race.

Symbols are those of the package's own documentation: d distance of ball and ring axis, s penetration,
zeta and rho place and radius of a slice, n_e the in-plane unit vector out of the ball.
"""

# ruff: noqa: PLR0912, PLR0915, PLR0917  compiled functions are flat and take what they need one by one

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import numba
import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    import ballrace as br

__all__ = ["Bearing", "repeat", "rhs"]

GROOVE = np.dtype([(name, "f8") for name in ("sigma", "a", "z", "r")])
"""Race of a ring under a row: side, groove centre (radius and axial place) and groove radius [m]."""
DEFECT = np.dtype([(n, "f8") for n in ("angle", "z", "half_length", "width", "edge_radius")])
"""Defect on the outer race of a row; a negative half length means none."""
COMMON = np.dtype(
    [
        *((name, "i8") for name in ("rows", "count")),
        *((name, "f8") for name in ("radius", "stiffness", "damping", "friction", "slip_speed")),
        *((name, "f8") for name in ("cage_stiffness", "cage_damping", "cage_distance")),
    ]
)
"""What is the same for all rows. `stiffness` is that of a slice, c_s [N/m^(10/9)], for Gauss nodes of a metre."""

# Not cached: numba does not notice that a function changed which a cached one has taken in.
compiled = numba.njit(fastmath=True, error_model="numpy")


@compiled
def add(force: Any, ball: int, ring: int, fx: float, fy: float, fz: float) -> None:
    """Add a force on a ball, and its opposite to a ring."""
    force[ball, 0] += fx
    force[ball, 1] += fy
    force[ball, 2] += fz
    force[ring, 0] -= fx
    force[ring, 1] -= fy
    force[ring, 2] -= fz


@compiled
def press(
    force: Any,
    q: Any,
    v: Any,
    ball: int,
    ring: int,
    elastic: float,
    normal: tuple[float, float],
    point: tuple[float, float],
    angles: tuple[float, float, float],
    common: Any,
) -> None:
    """Damp and rub one element that carries `elastic` on the in-plane normal `n_e` at a point."""
    nx, ny = normal
    bx, by = point[0] - q[ball, 0], point[1] - q[ball, 1]
    rx, ry = point[0] - q[ring, 0], point[1] - q[ring, 1]
    tan, sin, cos = angles
    vx = v[ball, 0] - v[ball, 3] * by - v[ring, 0] + v[ring, 3] * ry
    vy = v[ball, 1] + v[ball, 3] * bx - v[ring, 1] - v[ring, 3] * rx
    vz = v[ball, 2] - v[ring, 2]
    approach = vx * nx + vy * ny
    F = elastic * (1.0 + 1.5 * common.damping * (approach + vz * tan))
    if F <= 0.0:
        return
    u_t = vy * nx - vx * ny
    u_m = vz * cos - approach * sin
    rub = common.friction * F / math.sqrt(u_t * u_t + u_m * u_m + common.slip_speed**2)
    along = -F + rub * u_m * sin
    fx, fy = along * nx + rub * u_t * ny, along * ny - rub * u_t * nx
    add(force, ball, ring, fx, fy, -F * tan - rub * u_m * cos)
    force[ball, 3] += bx * fy - by * fx
    force[ring, 3] -= rx * fy - ry * fx


@compiled
def open_slice(
    force: Any,
    q: Any,
    v: Any,
    ball: int,
    n: tuple[float, float],
    radius: float,
    s_race: float,
    rho: float,
    angles: tuple[float, float, float],
    beta: float,
    stiffness: float,
    defect: Any,
    common: Any,
) -> None:
    """One slice inside the outer race's defect: two edge circles and the narrow rule (the race at s12)."""
    s_1, s_2, x_1, y_1, x_2, y_2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for side in (-1.0, 1.0):
        phi = defect.angle + side * beta + q[0, 3]
        arm = radius + defect.edge_radius
        x = q[0, 0] + arm * math.cos(phi) - q[ball, 0]
        y = q[0, 1] + arm * math.sin(phi) - q[ball, 1]
        s = rho + defect.edge_radius - math.sqrt(x * x + y * y)
        if side < 0.0:
            s_1, x_1, y_1 = s, x, y
        else:
            s_2, x_2, y_2 = s, x, y
    shared = stiffness * max(s_1 + s_2 - s_race, 0.0) ** (10.0 / 9.0)
    if shared > 0.0:
        p = (q[0, 0] + radius * n[0], q[0, 1] + radius * n[1])
        press(force, q, v, ball, 0, shared, n, p, angles, common)
    for s, x, y in ((s_1, x_1, y_1), (s_2, x_2, y_2)):
        elastic = stiffness * max(s, 0.0) ** (10.0 / 9.0) - shared
        if elastic > 0.0:
            far = math.sqrt(x * x + y * y)
            reach = (far - defect.edge_radius) / far
            p = (q[ball, 0] + reach * x, q[ball, 1] + reach * y)
            press(force, q, v, ball, 0, elastic, (x / far, y / far), p, angles, common)


@compiled
def contact(
    force: Any,
    q: Any,
    v: Any,
    ball: int,
    ring: int,
    groove: Any,
    defect: Any,
    slices: Any,
    common: Any,
) -> None:
    """All slices of one ball on one race, or Gauss nodes: `slices` holds these on [-1, 1], and weights."""
    dx, dy = q[ball, 0] - q[ring, 0], q[ball, 1] - q[ring, 1]
    d = math.sqrt(dx * dx + dy * dy)
    # The two circles of the meridional plane.
    away = groove.sigma * (d - groove.a)
    dz = q[ball, 2] - q[ring, 2]
    offset = groove.z - dz
    line = math.sqrt(away * away + offset * offset)
    if line + common.radius <= groove.r:
        return
    along = (line * line + common.radius**2 - groove.r**2) / (2.0 * line)
    across = math.sqrt(max(common.radius**2 - along * along, 0.0)) * abs(away) / line
    middle = along * offset / line
    count = slices.shape[1]
    by_gauss = slices.shape[0] == 2
    first, last = 0, count - 1
    if not by_gauss:
        width = 2.0 * common.radius / count
        first = max(math.ceil((middle - across) / width + (count - 1) / 2.0), 0)
        last = min(math.floor((middle + across) / width + (count - 1) / 2.0), count - 1)

    nx, ny = dx / d, dy / d
    wx, wy = v[ball, 0] - v[ring, 0], v[ball, 1] - v[ring, 1]
    vz = v[ball, 2] - v[ring, 2]
    approach = groove.sigma * (wx * nx + wy * ny)
    turn, spin = v[ring, 3], v[ball, 3]
    drift = wy * nx - wx * ny - spin * d
    hurt = ring == 0 and defect.half_length > 0.0
    if hurt:
        # Signed angle of the ball's direction from the defect's middle.
        phi = defect.angle + q[0, 3]
        cos, sin = math.cos(phi), math.sin(phi)
        angle = abs(math.atan2(ny * cos - nx * sin, nx * cos + ny * sin))
    sigma, groove_a, groove_z, groove_rr = groove.sigma, groove.a, groove.z, groove.r**2
    stiffness, damping = common.stiffness, 1.5 * common.damping
    ball_rr, per_radius = common.radius**2, 1.0 / common.radius
    friction, slip = common.friction, common.slip_speed**2
    radial = tangential = axial = ball_torque = ring_torque = 0.0
    # Gauss's nodes see no jump: over a defect the zone is divided where the defect ends.
    low, high = middle - across, middle + across
    cut_low, cut_high = low, high
    if by_gauss and hurt and angle <= defect.width / (2.0 * groove_a):
        cut_low = min(max(defect.z - defect.half_length - dz, low), high)
        cut_high = min(max(defect.z + defect.half_length - dz, low), high)
    for part in range(3 if by_gauss else 1):
        begin = low if part == 0 else cut_low if part == 1 else cut_high
        end = cut_low if part == 0 else cut_high if part == 1 else high
        if by_gauss and end <= begin:
            continue
        part_middle, part_across = 0.5 * (begin + end), 0.5 * (end - begin)
        for k in range(first, last + 1):
            if by_gauss:
                zeta = part_middle + part_across * slices[0, k]
                rho = math.sqrt(ball_rr - zeta * zeta)
                tan, sin, cos = zeta / rho, zeta * per_radius, rho * per_radius
                stiffness = common.stiffness * part_across * slices[1, k]
            else:
                zeta, rho = slices[0, k], slices[1, k]
                tan, sin, cos = slices[2, k], slices[3, k], slices[4, k]
            z = dz + zeta
            x = z - groove_z
            radius = groove_a + sigma * math.sqrt(groove_rr - x * x)
            s = sigma * (d - radius) + rho
            if s <= 0.0:
                continue
            if hurt and abs(z - defect.z) <= defect.half_length:
                beta = defect.width / (2.0 * radius)
                if angle <= beta:
                    angles = (tan, sin, cos)
                    n = (nx, ny)
                    open_slice(
                        force,
                        q,
                        v,
                        ball,
                        n,
                        radius,
                        s,
                        rho,
                        angles,
                        beta,
                        stiffness,
                        defect,
                        common,
                    )
                    continue
            # A tenth faster than a power.
            F = stiffness * math.exp(math.log(s) * (10.0 / 9.0))
            F *= 1.0 + damping * (approach + vz * tan)
            if F <= 0.0:
                continue
            u_t = drift + (spin - turn) * radius
            u_m = vz * cos - approach * sin
            rub = friction * F / math.sqrt(u_t * u_t + u_m * u_m + slip)
            radial += F - rub * u_m * sin
            tangential += rub * u_t
            axial += F * tan + rub * u_m * cos
            ball_torque += rub * u_t * (radius - d)
            ring_torque += rub * u_t * radius
    radial *= sigma
    fx, fy = -radial * nx + tangential * ny, -radial * ny - tangential * nx
    add(force, ball, ring, fx, fy, -axial)
    force[ball, 3] -= ball_torque
    force[ring, 3] += ring_torque


@compiled
def cage_link(force: Any, q: Any, v: Any, i: int, j: int, common: Any) -> None:
    """One spring and damper between the centres of neighbouring balls."""
    x, y = q[j, 0] - q[i, 0], q[j, 1] - q[i, 1]
    length = math.sqrt(x * x + y * y)
    x, y = x / length, y / length
    rate = (v[j, 0] - v[i, 0]) * x + (v[j, 1] - v[i, 1]) * y
    pull = common.cage_stiffness * (length - common.cage_distance) + common.cage_damping * rate
    add(force, i, j, pull * x, pull * y, 0.0)


@compiled
def rhs(
    y: Any,
    dy: Any,
    grooves: Any,
    defects: Any,
    slices: Any,
    bodies: Any,
    record: Any,
) -> None:
    """Write the time derivative of a state.

    `bodies` holds, for every body and direction, the constant force, one over the mass, and the spring,
    damper and place of the support: shape (5, bodies, 4).
    """
    common = record[0]
    half = y.size // 2
    q, v = y[:half].reshape(-1, 4), y[half:].reshape(-1, 4)
    force = dy[half:].reshape(-1, 4)
    dy[:half] = y[half:]
    constant, mobility = bodies[0], bodies[1]
    force[:] = constant
    for ring in range(2):
        for i in range(4):
            force[ring, i] -= bodies[2, ring, i] * (q[ring, i] - bodies[4, ring, i])
            force[ring, i] -= bodies[3, ring, i] * v[ring, i]
    for row in range(common.rows):
        start = 2 + row * common.count
        for j in range(common.count):
            for ring in range(2):
                contact(
                    force,
                    q,
                    v,
                    start + j,
                    ring,
                    grooves[row, ring],
                    defects[row],
                    slices,
                    common,
                )
            cage_link(force, q, v, start + j, start + (j + 1) % common.count, common)
    for body in range(force.shape[0]):
        for i in range(4):
            force[body, i] *= mobility[body, i]


@compiled
def repeat(
    states: Any,
    dy: Any,
    grooves: Any,
    defects: Any,
    slices: Any,
    bodies: Any,
    record: Any,
) -> float:
    """Evaluate many states in one compiled loop; a number that depends on all of them."""
    total = 0.0
    for i in range(states.shape[0]):
        rhs(states[i], dy, grooves, defects, slices, bodies, record)
        total += dy[dy.size - 1]
    return total


class Bearing:
    """A scene as tables for :func:`rhs`; callable as ``bearing(t, y)``.

    Whoever measures by it first holds it to ``Model.rhs``, which shows what the equations here leave out.

    Parameters
    ----------
    scene : ballrace.Scene
        A scene on fixed slices.
    nodes : int, optional
        Gauss's nodes along a contact's zone instead of the slices.
    """

    def __init__(self, scene: br.Scene, nodes: int | None = None) -> None:
        document: dict[str, Any] = json.loads(scene.to_json())
        self.tables = tables(document)
        if nodes is not None:
            grooves, defects, slices, bodies, common = self.tables
            common["stiffness"] *= slices.shape[1] / (2.0 * common["radius"])
            gauss = np.stack(np.polynomial.legendre.leggauss(nodes))
            self.tables = grooves, defects, gauss, bodies, common

    def __call__(self, t: float, y: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the time derivative of a state; nothing depends on time but through it."""
        dy = np.empty_like(y)
        rhs(y, dy, *self.tables)
        return dy

    def repeat(self, states: NDArray[np.float64]) -> float:
        """Evaluate many states, shape (states, dim), without Python in between."""
        return float(repeat(states, np.empty(states.shape[1]), *self.tables))


def tables(document: dict[str, Any]) -> tuple[NDArray[Any], ...]:
    """Grooves, defects, slices, bodies and common numbers of a scene document."""
    rows, law = document["rows"], document["contact"]["law"]["iso16281"]
    grooves = np.zeros((len(rows), 2), GROOVE)
    defects = np.zeros(len(rows), DEFECT)
    defects["half_length"] = -1.0
    for i, row in enumerate(rows):
        D, alpha = row["ball_diameter"], row["contact_angle"]
        for ring, name in enumerate(("outer", "inner")):
            sigma = 1 - 2 * ring
            r = row[f"{name}_conformity"] * D
            lift = (r - D / 2) * math.cos(alpha) - row["clearance"] / 4
            z = row["axial_position"] - sigma * row["side"] * (r - D / 2) * math.sin(alpha)
            z += ring * row["side"] * row["axial_preload"]
            grooves[i, ring] = (sigma, row["pitch_diameter"] / 2 - sigma * lift, z, r)
    for x in document["defects"].values():
        z = rows[x["row"]]["axial_position"] + x["axial_offset"]
        defects[x["row"]] = (x["angle"], z, x["length"] / 2, x["width"], x["edge_radius"])

    row, cage = rows[0], document["cage"]
    count, D = document["contact"]["slices"]["fixed"], row["ball_diameter"]
    zeta = (np.arange(count) + 0.5) * D / count - D / 2
    rho = np.sqrt((D / 2) ** 2 - zeta**2)
    slices = np.stack([zeta, rho, zeta / rho, zeta / (D / 2), rho / (D / 2)])

    friction = document["friction"]["coulomb"]
    common = np.zeros(1, COMMON)
    common[0] = (
        len(rows),
        row["ball_count"],
        D / 2,
        law["constant"] * (law["length_ratio"] * D) ** (8 / 9) / count,
        document["contact"]["damping"],
        friction["coefficient"],
        friction["slip_speed"],
        cage["stiffness"],
        cage["damping"],
        row["pitch_diameter"] * math.sin(math.pi / row["ball_count"]),
    )
    return grooves, defects, slices, body_table(document), common


def body_table(document: dict[str, Any]) -> NDArray[np.float64]:
    """Constant forces, mobilities and supports, shape (5, bodies, 4)."""
    rows = document["rows"]
    D = rows[0]["ball_diameter"]
    mass = rows[0]["ball_mass"]
    if mass is None:
        mass = document["materials"]["balls"]["density"] * math.pi / 6 * D**3
    inertia = rows[0]["ball_inertia"]
    inertia = 0.1 * mass * D**2 if inertia is None else inertia
    bodies = np.zeros((5, 2 + len(rows) * rows[0]["ball_count"], 4))
    constant, mobility, stiffness, damping, _ = bodies
    mobility[2:] = [1 / mass, 1 / mass, 1 / mass, 1 / inertia]
    constant[2:, :3] = mass * np.array(document["gravity"])
    names = ("outer", "inner")
    for ring, name in enumerate(names):
        entry = document[f"{name}_ring"]
        # The outer ring does not turn, the inner ring turns at a constant speed: θ has no mobility.
        mobility[ring, :3] = 1 / entry["mass"]
        constant[ring, :3] = entry["mass"] * np.array(document["gravity"])
        for i, direction in enumerate("xyz"):
            mount = entry["support"][direction]["spring"]
            stiffness[ring, i], damping[ring, i] = mount["stiffness"], mount["damping"]
    for load in document["loads"].values():
        direction = np.array(load["direction"])
        force = load["force"] * direction / np.linalg.norm(direction)
        constant[names.index(load["ring"]), :3] += force
    return bodies
