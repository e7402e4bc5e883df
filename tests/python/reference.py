"""The model a second time: slow, plain, and written without looking at the Rust.

Every slice of every contact is a turn of a Python loop. "Section" and "(n)" are those of the model
page: section 2 is the geometry, 4 the normal force, 5 the friction, 6 the cage, 7 the defects.

A vector of the x-y plane is a complex number x + iy: |v| is its length, i v is ẑ × v,
Re(v̄ w) is the scalar and Im(v̄ w) the z component of the vector product.
"""

from __future__ import annotations

import cmath
import itertools
import math
from collections import Counter
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import ellipe, ellipkm1, roots_jacobi

Json = dict[str, Any]
Vector = NDArray[np.float64]

OUTER, INNER = 0, 1
TAU = 2.0 * math.pi


def dot(v: complex, w: complex) -> float:
    """Scalar product of two vectors of the plane."""
    return v.real * w.real + v.imag * w.imag


def cross(v: complex, w: complex) -> float:
    """Z component of the vector product."""
    return v.real * w.imag - v.imag * w.real


def unit(angle: float) -> complex:
    """Unit vector at an angle from +x."""
    return complex(math.cos(angle), math.sin(angle))


def wrap(angle: float) -> float:
    """The angle from −π to π."""
    return math.remainder(angle, TAU)


# ---------------------------------------------------------------------------- values of the scene


def time_value(value: Any, t: float) -> float:
    """Value of a function of time; continuous from the right."""
    if not isinstance(value, dict):
        return float(value)
    if "ramp" in value:
        p = value["ramp"]
        if t >= p["end"]:
            return float(p["to"])
        if t <= p["start"]:
            return float(p["from"])
        share = (t - p["start"]) / (p["end"] - p["start"])
        return float(p["from"] + (p["to"] - p["from"]) * share)
    if "sine" in value:
        p = value["sine"]
        return float(p["mean"] + p["amplitude"] * math.sin(TAU * p["frequency"] * t + p["phase"]))
    return piecewise_linear(value["table"]["times"], value["table"]["values"], t)[0]


def time_rate(value: Any, t: float) -> float:
    """Derivative of a function of time, from the right."""
    if not isinstance(value, dict):
        return 0.0
    if "ramp" in value:
        p = value["ramp"]
        inside = p["start"] <= t < p["end"]
        return float((p["to"] - p["from"]) / (p["end"] - p["start"])) if inside else 0.0
    if "sine" in value:
        p = value["sine"]
        w = TAU * p["frequency"]
        return float(p["amplitude"] * w * math.cos(w * t + p["phase"]))
    return piecewise_linear(value["table"]["times"], value["table"]["values"], t)[1]


def piecewise_linear(xs: list[float], ys: list[float], x: float) -> tuple[float, float]:
    """Value and slope from the right of a polygon, constant beyond its ends."""
    after = sum(1 for place in xs if place <= x)
    if after == 0:
        return float(ys[0]), 0.0
    if after == len(xs):
        return float(ys[-1]), 0.0
    slope = (ys[after] - ys[after - 1]) / (xs[after] - xs[after - 1])
    return float(ys[after - 1] + slope * (x - xs[after - 1])), float(slope)


def defect_width(defect: Json, z: float) -> tuple[float, float]:
    """Width w of a defect and dw/dz at a place from its middle."""
    width = defect["width"]
    if isinstance(width, dict):
        return piecewise_linear(width["positions"], width["widths"], z)
    return float(width), 0.0


def largest_width(defect: Json) -> float:
    """Largest width of a defect."""
    width = defect["width"]
    return float(max(width["widths"]) if isinstance(width, dict) else width)


# ---------------------------------------------------------------------------- races (section 2)


@dataclass(frozen=True)
class Groove:
    """The race of one ring under one row, in the ring's own frame."""

    sigma: float  # +1 outer, −1 inner
    a: float  # radius of the groove's centre from the axis
    z: float  # axial place of the groove's centre
    r: float  # groove radius
    limits: tuple[float, float]  # axial ends, from the groove's centre
    waves: tuple[tuple[float, float, float], ...]  # order, amplitude, phase

    def exists(self, z: float) -> bool:
        """Whether there is a race at this axial place."""
        x = z - self.z
        return abs(x) < self.r and self.limits[0] <= x <= self.limits[1]

    def torus(self, z: float) -> float:
        """Race radius without waviness."""
        return self.a + self.sigma * math.sqrt(self.r**2 - (z - self.z) ** 2)

    def torus_slope(self, z: float) -> float:
        """Its derivative by z."""
        x = z - self.z
        return -self.sigma * x / math.sqrt(self.r**2 - x**2)

    def waviness(self, angle: float) -> float:
        """Error of the race radius at an angle of the ring's own frame."""
        return sum(a * math.cos(order * angle + phase) for order, a, phase in self.waves)

    def waviness_slope(self, angle: float) -> float:
        """Its derivative by the angle."""
        return -sum(a * order * math.sin(order * angle + p) for order, a, p in self.waves)

    def radius(self, z: float, angle: float) -> float:
        """Race radius R(z, φ)."""
        return self.torus(z) + self.waviness(angle)


def groove(row: Json, ring: int, materials: Json) -> Groove:
    """Groove of a ring under a row (section 2)."""
    D, d_m, alpha, side = (
        row["ball_diameter"],
        row["pitch_diameter"],
        row["contact_angle"],
        row["side"],
    )
    R = D / 2
    if ring == OUTER:
        r = row["outer_conformity"] * D
        a = d_m / 2 - (r - R) * math.cos(alpha) + row["clearance"] / 4
        z = row["axial_position"] - side * (r - R) * math.sin(alpha)
        shoulders, waves, sigma = row["outer_shoulders"], row["outer_waviness"], 1.0
    else:
        r = row["inner_conformity"] * D
        a = d_m / 2 + (r - R) * math.cos(alpha) - row["clearance"] / 4
        z = row["axial_position"] + side * (r - R) * math.sin(alpha) + side * row["axial_preload"]
        shoulders, waves, sigma = row["inner_shoulders"], row["inner_waviness"], -1.0
    limits = (-math.inf, math.inf)
    if shoulders is not None:
        limits = (-r * math.sin(shoulders[0]), r * math.sin(shoulders[1]))
    harmonics: tuple[tuple[Any, Any, Any], ...] = ()
    if waves:
        # The share of a wave that a contact keeps, sin κ/κ with κ = n b/R (section 14.1).
        width = hertz(row, ring, materials).c_b * row["texture"]["reference_load"] ** (1 / 3)
        arc = width / (a + sigma * r * math.cos(alpha))
        shares = [math.sin(w["order"] * arc) / (w["order"] * arc) for w in waves]
        harmonics = tuple(
            (w["order"], share * w["amplitude"], w["phase"])
            for w, share in zip(waves, shares, strict=True)
        )
    return Groove(sigma, a, z, r, limits, harmonics)


# ---------------------------------------------------------------------------- Hertz (section 4)


@dataclass(frozen=True)
class Hertz:
    """F = K δ^(3/2), half-length c_a F^(1/3), half-width c_b F^(1/3), the slice law q = k' (δ − κ τ²/2)."""

    K: float
    c_a: float
    c_b: float

    @property
    def k(self) -> float:
        """k' of the slice law."""
        return float(3 * self.K ** (2 / 3) / (4 * self.c_a))

    @property
    def kappa(self) -> float:
        """Curvature κ of the slice law."""
        return float(2 / (self.c_a**2 * self.K ** (2 / 3)))


def hertz(row: Json, ring: int, materials: Json) -> Hertz:
    """Hertz's constants of a nominal ball on a race at the nominal contact angle.

    Gap A x² + B y², x along the groove's profile (the long axis), y in the rolling direction. With
    semi-axes a > b, e² = 1 − (b/a)² and complete elliptic integrals K, E of modulus e:

        A = p₀ (K − E) b / (E* a² e²)      B = p₀ (E a²/b² − K) b / (E* a² e²)
        δ = p₀ b K / E*                    F = ⅔ π p₀ a b
    """
    D, alpha = row["ball_diameter"], row["contact_angle"]
    gamma = D * math.cos(alpha) / row["pitch_diameter"]
    if ring == OUTER:
        f, rolling = row["outer_conformity"], -2 * gamma / (D * (1 + gamma))
    else:
        f, rolling = row["inner_conformity"], 2 * gamma / (D * (1 - gamma))
    A = (2 / D - 1 / (f * D)) / 2
    B = (2 / D + rolling) / 2
    ball, race = materials["balls"], materials["rings"]
    compliance = (1 - ball["poisson_ratio"] ** 2) / ball["youngs_modulus"]
    compliance += (1 - race["poisson_ratio"] ** 2) / race["youngs_modulus"]

    def integrals(axes: float) -> tuple[float, float]:  # axes = b/a
        return float(ellipkm1(axes**2)), float(ellipe(1 - axes**2))

    def mismatch(axes: float) -> float:
        K, E = integrals(axes)
        return float((E / axes**2 - K) / (K - E) - B / A)

    axes = float(brentq(mismatch, 1e-6, 1 - 1e-6, xtol=1e-16, rtol=1e-15))
    K, E = integrals(axes)
    c_a = (3 * (K - E) * compliance / (2 * math.pi * (1 - axes**2) * A)) ** (1 / 3)
    stiffness = (2 * math.pi * c_a / (3 * K * compliance)) ** 1.5
    return Hertz(float(stiffness), float(c_a), float(axes * c_a))


# ---------------------------------------------------------------------------- arcs (section 7)


@dataclass(frozen=True)
class Arc:
    """The arc over which a defect removes the surface in one slice, in its body's frame."""

    defect: Json
    middle: float  # φ_f
    half: float  # β
    half_rate: float  # dβ/dζ of a ball defect, dβ/dz of a ring's


@dataclass(frozen=True)
class Mark:
    """The place of a fault circle on its body."""

    angle: float
    angle_rate: float  # d angle / dζ or dz
    radius: float  # R_f
    depth: float


@dataclass(frozen=True)
class Gap:
    """A connected piece of the union of arcs: circles at its two ends and on its floor."""

    ends: tuple[Mark, Mark]
    floor: list[Mark]


def edge(arc: Arc, side: float) -> Mark:
    """Edge circle at the lower (side −1) or upper (+1) end of an arc."""
    return Mark(
        arc.middle + side * arc.half, side * arc.half_rate, float(arc.defect["edge_radius"]), 0.0
    )


def floor_marks(arc: Arc) -> list[Mark]:
    """Floor circles of one defect."""
    floor = arc.defect["floor"]
    if floor is None:
        return []
    n = floor["elements"]
    shares = [2 * (k + 1) / (n + 1) - 1 for k in range(n)]  # from −1 to 1 between the edges
    return [
        Mark(
            arc.middle + share * arc.half,
            share * arc.half_rate,
            float(arc.defect["edge_radius"]),
            float(floor["depth"]),
        )
        for share in shares
    ]


# ---------------------------------------------------------------------------- one ball on one race


@dataclass(frozen=True)
class Body:
    """Place and velocity of a body."""

    index: int
    centre: complex
    z: float
    theta: float
    velocity: complex
    vz: float
    omega: float


@dataclass(frozen=True)
class TangentialShare:
    """Tangential force of a wavy race over the radial one (section 4), and where it acts."""

    share: complex
    point: complex


@dataclass(frozen=True)
class Surface:
    """What a ball without defects meets in a slice: the race, or a circle of a ring defect.

    `terms` are (sign, drop): the elastic force is Σ sign · law(s_race − drop). Penetrations and
    drops come with their derivatives by z, the place on the ring, and by ζ, that on the ball.
    """

    kind: str
    terms: list[tuple[float, Vector]]
    s: Vector  # penetration of the smooth ball
    normal: complex  # n_e, out of the ball
    point: complex  # p
    centre: complex | None  # of the circle
    radius: float  # of the circle
    centre_rate: complex  # d centre / dz
    tangential: TangentialShare


@dataclass(frozen=True)
class Feature:
    """One pair of elements that touch in a slice."""

    kind: str
    terms: list[tuple[float, Vector]]
    normal: complex
    point: complex
    tan_alpha: float
    tangential: TangentialShare


@dataclass(frozen=True)
class Slice:
    """A slice, or a quadrature node: where, and its elastic force as a function of the drop."""

    zeta: float
    depth: float  # penetration of a ball and race without defects: s_race, or P of the Hertz law
    per_drop: float  # what a drop of 1 m takes from it: 1, or cos α'
    stiffness: float
    exponent: float

    def penetration(self, drop: float) -> float:
        """Penetration of an element that stands back by `drop` in the plane."""
        return self.depth - self.per_drop * drop

    def force(self, penetration: float) -> float:
        """Elastic force, 0 without penetration."""
        return float(self.stiffness * max(penetration, 0.0) ** self.exponent)

    def energy(self, penetration: float) -> float:
        """Elastic energy: the integral of the force."""
        power = self.exponent + 1
        return float(self.stiffness * max(penetration, 0.0) ** power / power)


class Contact:
    """One ball on one race in one state."""

    def __init__(
        self, model: Reference, row: int, ball_of_row: int, ball: Body, ring: Body
    ) -> None:
        self.model, self.ball, self.ring = model, ball, ring
        self.row = model.rows[row]
        self.groove = model.grooves[row][ring.index]
        self.hertz = model.hertz[row][ring.index]
        self.ring_defects = model.ring_defects[row][ring.index]
        self.ball_defects = model.ball_defects[row].get(ball_of_row, [])
        self.diameter = model.ball_diameter(row, ball_of_row)
        self.R_b = self.diameter / 2
        self.sigma = self.groove.sigma
        # n, d of section 3.
        self.d = abs(ball.centre - ring.centre)
        self.n = (ball.centre - ring.centre) / self.d
        # Of the Hertz law, once slices are known: cos α' and sin α', δ and the distance of the centres.
        self.direction, self.approach, self.L = (math.nan, math.nan), -math.inf, math.nan
        self.beside = 0.0  # how far beside a slice defects are looked for
        # Derivatives of the elastic energy by e and z, the ball's place in the meridional plane,
        # beyond those of the forces along normals; and the sums of the magnitudes of their parts.
        self.by_place = np.zeros(2)
        self.parts_of_place = np.zeros(2)

    # -- slices and laws (section 4)

    def slices(self) -> list[Slice]:
        """All slices or nodes of this contact."""
        return self.iso_slices() if self.hertz is None else self.hertz_slices(self.hertz)

    def iso_slices(self) -> list[Slice]:
        """Slices or nodes with the law (2), (3)."""
        D = self.row["ball_diameter"]
        C = self.model.iso["constant"] * (self.model.iso["length_ratio"] * D) ** (8 / 9)
        if self.model.fitted:
            nodes = self.chord_nodes()
        else:
            width = self.diameter / self.model.slice_count
            nodes = [(zeta, width) for zeta in self.fixed_places()]
        return [
            self.iso_slice(zeta, C / D * width) for zeta, width in nodes if self.race_exists(zeta)
        ]

    def iso_slice(self, zeta: float, stiffness: float) -> Slice:
        """A slice of the law (2), (3)."""
        return Slice(zeta, float(self.race_penetration(zeta)[0]), 1.0, stiffness, 10 / 9)

    def chord_nodes(self) -> list[tuple[float, float]]:
        """Places ζ and widths of nodes fitted to the chord that ball and groove have in common.

        In the meridional plane (axial + i · radial, from the ball's centre) the two circles cut in
        ±h along the tangent t of the line of centres; a node at u on the chord is the ball's point
        u t + √(R² − u²) n, and stands for the width dζ = Im(i · point) / √(R² − u²) du.
        """
        g = self.groove
        away = self.sigma * (self.d - g.a - g.waviness(self.ring_angle(self.n)))
        centre = complex(g.z - (self.ball.z - self.ring.z), -away)  # of the groove, from the ball's
        L = abs(centre)
        if L + self.R_b <= g.r:
            return []
        assert away > 0
        normal = -centre / L
        tangent = -1j * normal
        along = (g.r**2 - L**2 - self.R_b**2) / (2 * L)
        h = math.sqrt(self.R_b**2 - along**2)

        def point(u: float) -> complex:
            return u * tangent + math.sqrt(self.R_b**2 - u**2) * normal

        assert all(point(u).imag > 0 for u in (-h, h))
        cuts = []
        for zeta in self.axial_ends():
            if abs(zeta) < self.R_b:
                on_ball = complex(zeta, self.rho(zeta))
                cuts.append((on_ball * tangent.conjugate()).real)
        nodes = []
        for u, weight in self.fitted_nodes((-h, h), cuts, 10 / 9):
            p = point(u)
            nodes.append((p.real, weight * p.imag / math.sqrt(self.R_b**2 - u**2)))
        return nodes

    def hertz_slices(self, constants: Hertz) -> list[Slice]:
        """Fitted nodes or fixed slices of the Hertz law."""
        ring, g = self.ring, self.groove
        # The two circles of the meridional plane: from the groove's centre to the ball's, (e, −c).
        e = self.sigma * (self.d - g.a - g.waviness(self.ring_angle(self.n)))
        c = g.z - (self.ball.z - ring.z)
        self.model.near(e)
        if e <= 0:
            return []
        L = math.hypot(e, c)
        delta = L + self.R_b - g.r
        cos, sin = e / L, -c / L
        self.model.near(delta)
        if delta <= 0:
            return []
        self.direction, self.approach, self.L = (cos, sin), delta, L
        if self.model.fitted:
            tau_max = math.sqrt(2 * delta / constants.kappa)
            cuts = [(zeta - self.R_b * sin) / cos for zeta in self.axial_ends()]
            nodes = self.fitted_nodes((-tau_max, tau_max), cuts, 1.0)
        else:
            width = self.diameter / self.model.slice_count
            nodes = [((x - self.R_b * sin) / cos, width / cos) for x in self.fixed_places()]
        slices = []
        for tau, weight in nodes:
            zeta = self.R_b * sin + tau * cos
            P = delta - constants.kappa * tau**2 / 2
            self.model.near(P)
            if P > 0 and abs(zeta) < self.R_b and self.race_exists(zeta):
                slices.append(Slice(zeta, P, cos, constants.k * weight, 1.0))
        return slices

    def fixed_places(self) -> list[float]:
        """Slice centres ζ_k of section 3."""
        n, D = self.model.slice_count, self.diameter
        return [-D / 2 + (k + 0.5) * D / n for k in range(n)]

    def fitted_nodes(
        self, zone: tuple[float, float], cuts: list[float], exponent: float
    ) -> list[tuple[float, float]]:
        """Places τ and weights of Gauss–Jacobi nodes on every piece of the contact zone.

        The law vanishes with `exponent` at the zone's own ends, and at no cut.
        """
        low, high = zone
        ends = [low, *sorted(x for x in cuts if low < x < high), high]
        nodes = []
        for a, b in itertools.pairwise(ends):
            beta, alpha = exponent * (a == low), exponent * (b == high)
            count = self.model.slice_count * (2 if alpha == beta == 0 else 1)
            places, weights = roots_jacobi(count, alpha, beta)
            weights = weights / ((1 - places) ** alpha * (1 + places) ** beta)
            half = (b - a) / 2
            nodes += [
                ((a + b) / 2 + half * float(x), half * float(w))
                for x, w in zip(places, weights, strict=True)
            ]
        return nodes

    def axial_ends(self) -> list[float]:
        """ζ where the zone is cut: shoulders, and the axial ends of defects near the contact."""
        ball, ring, g = self.ball, self.ring, self.groove
        ends = [g.z + x + ring.z - ball.z for x in g.limits if math.isfinite(x)]
        for defect in self.ring_defects:
            z_f = self.row["axial_position"] + defect["axial_offset"]
            reach = largest_width(defect) / g.torus(z_f)
            away = abs(wrap(self.ring_angle(self.n) - defect["angle"]))
            self.model.near((away - reach) * g.torus(z_f))
            if away <= reach:
                half = defect["length"] / 2
                ends += [z_f + x + ring.z - ball.z for x in (-half, half)]
        for defect in self.ball_defects:
            middle, half = defect["axial_offset"], defect["length"] / 2
            rho = math.sqrt(self.R_b**2 - (abs(middle) + half) ** 2)
            reach = largest_width(defect) / rho
            away = abs(wrap(self.ball_angle(self.sigma * self.n) - defect["angle"]))
            self.model.near((away - reach) * rho)
            if away <= reach:
                ends += [middle - half, middle + half]
        return ends

    # -- geometry of a slice (section 3)

    def ring_angle(self, direction: complex) -> float:
        """Angle of a direction in the ring's own frame."""
        return cmath.phase(direction) - self.ring.theta

    def ball_angle(self, direction: complex) -> float:
        """Angle of a direction in the ball's own frame."""
        return cmath.phase(direction) - self.ball.theta

    def ring_z(self, zeta: float) -> float:
        """Axial place of a slice in the ring's own frame."""
        return self.ball.z + zeta - self.ring.z

    def rho(self, zeta: float) -> float:
        """Radius ρ of a slice."""
        return math.sqrt(self.R_b**2 - zeta**2)

    def race_exists(self, zeta: float) -> bool:
        """Whether the slice faces the race rather than a shoulder."""
        z = self.ring_z(zeta)
        if not self.model.fitted:
            for end in (*self.groove.limits, -self.groove.r, self.groove.r):
                self.model.near(z - self.groove.z - end)
        return self.groove.exists(z)

    def race_penetration(self, zeta: float) -> Vector:
        """s of the race without defects, and its derivatives by z and ζ."""
        z = self.ring_z(zeta)
        radius = self.groove.radius(z, self.ring_angle(self.n))
        s = self.sigma * (self.d - radius) + self.rho(zeta)
        return np.array([s, -self.sigma * self.groove.torus_slope(z), -zeta / self.rho(zeta)])

    def race_tangential(self, from_ring: complex, point: complex) -> TangentialShare:
        """σ R'(φ)/d along ẑ × n, for what stands so far from the ring's centre."""
        d = abs(from_ring)
        slope = self.groove.waviness_slope(self.ring_angle(from_ring))
        return TangentialShare(self.sigma * slope / d * 1j * from_ring / d, point)

    # -- arcs (section 7)

    def ring_arcs(self, zeta: float) -> list[Arc]:
        """Arcs of the ring's defects in this slice."""
        z, arcs = self.ring_z(zeta), []
        for defect in self.ring_defects:
            x = z - (self.row["axial_position"] + defect["axial_offset"])
            w, slope = defect_width(defect, x)
            if self.within_length(x, defect) and w > 0:
                R = self.groove.torus(z)
                rate = slope / (2 * R) - w * self.groove.torus_slope(z) / (2 * R**2)
                arcs.append(Arc(defect, defect["angle"], w / (2 * R), rate))
        return arcs

    def ball_arcs(self, zeta: float) -> list[Arc]:
        """Arcs of the ball's defects in this slice."""
        rho, arcs = self.rho(zeta), []
        for defect in self.ball_defects:
            x = zeta - defect["axial_offset"]
            w, slope = defect_width(defect, x)
            if self.within_length(x, defect) and w > 0:
                rate = slope / (2 * rho) + w * zeta / (2 * rho**3)
                arcs.append(Arc(defect, defect["angle"], w / (2 * rho), rate))
        return arcs

    def within_length(self, x: float, defect: Json) -> bool:
        """Whether a place from the middle of a defect lies within its length."""
        if not self.model.fitted and self.beside == 0.0:  # fitted nodes never lie on an end
            self.model.near(abs(x) - defect["length"] / 2)
        return bool(abs(x + self.beside) <= defect["length"] / 2)

    def gap(self, arcs: list[Arc], angle: float, scale: float) -> Gap | None:
        """The connected union of arcs that holds a direction; `scale` turns angles into lengths."""
        places = [(wrap(arc.middle - angle), arc) for arc in arcs]
        ends = [0.0] + [x + side * arc.half for x, arc in places for side in (-1, 1)]
        for i, one in enumerate(ends):
            for other in ends[:i]:
                self.model.near((one - other) * scale)
        union = [place for place in places if abs(place[0]) <= place[1].half]
        if not union:
            return None
        size = 0
        while len(union) > size:
            size = len(union)
            low = min(x - arc.half for x, arc in union)
            high = max(x + arc.half for x, arc in union)
            union = [(x, arc) for x, arc in places if x - arc.half <= high and x + arc.half >= low]
        first = min(union, key=lambda place: place[0] - place[1].half)[1]
        last = max(union, key=lambda place: place[0] + place[1].half)[1]
        floor = [mark for _, arc in union for mark in floor_marks(arc)]
        return Gap((edge(first, -1.0), edge(last, 1.0)), floor)

    # -- what the smooth ball meets (section 7, ring defects)

    def surfaces(self, zeta: float) -> list[Surface]:
        """The race and, inside a ring defect, its circles."""
        z, s_race = self.ring_z(zeta), self.race_penetration(zeta)
        self.model.near(s_race[0])
        if (
            self.hertz is None and s_race[0] <= 0.0
        ):  # a slice that does not reach the race touches nothing
            return []
        angle = self.ring_angle(self.n)
        n_e = self.sigma * self.n
        p = self.ring.centre + self.groove.radius(z, angle) * self.n
        tangential = self.race_tangential(self.d * self.n, self.ball.centre)
        gap = self.gap(self.ring_arcs(zeta), angle, self.groove.torus(z))
        if gap is None:
            return [
                Surface("race", [(1.0, np.zeros(3))], s_race, n_e, p, None, 0.0, 0.0, tangential)
            ]
        edges = [self.ring_circle(zeta, mark) for mark in gap.ends]
        drops = [s_race - s for s, *_ in edges]
        # The race keeps law(s₁₂), s₁₂ = s_race − drop₁ − drop₂; edge j carries law(s_j) − law(s₁₂).
        both = drops[0] + drops[1]
        found = [
            Surface("race_in_defect", [(1.0, both)], s_race, n_e, p, None, 0.0, 0.0, tangential)
        ]
        for circle, drop, mark in zip(edges, drops, gap.ends, strict=True):
            terms = [(1.0, drop), (-1.0, both)]
            found.append(self.circle_surface("edge", terms, circle, mark.radius))
        for mark in gap.floor:  # bare sum
            circle = self.ring_circle(zeta, mark)
            terms = [(1.0, s_race - circle[0])]
            found.append(self.circle_surface("floor", terms, circle, mark.radius))
        return found

    def ring_circle(self, zeta: float, mark: Mark) -> tuple[Vector, complex, complex]:
        """Penetration of the smooth ball into a circle of the ring, its centre and d centre/dz."""
        z = self.ring_z(zeta)
        u = unit(mark.angle + self.ring.theta)
        radius = self.groove.radius(z, mark.angle) + self.sigma * (mark.depth + mark.radius)
        radius_rate = self.groove.torus_slope(z)
        radius_rate += self.groove.waviness_slope(mark.angle) * mark.angle_rate
        centre = self.ring.centre + radius * u
        centre_rate = radius_rate * u + radius * mark.angle_rate * 1j * u
        line = centre - self.ball.centre
        s = self.rho(zeta) + mark.radius - abs(line)
        by_z = -dot(line, centre_rate) / abs(line)
        return np.array([s, by_z, -zeta / self.rho(zeta)]), centre, centre_rate

    def circle_surface(
        self,
        kind: str,
        terms: list[tuple[float, Vector]],
        circle: tuple[Vector, complex, complex],
        radius: float,
    ) -> Surface:
        """A circle of the ring as the smooth ball meets it."""
        s, centre, centre_rate = circle
        line = centre - self.ball.centre
        n_e = line / abs(line)
        p, none = centre - radius * n_e, TangentialShare(0.0, self.ball.centre)
        return Surface(kind, terms, s, n_e, p, centre, radius, centre_rate, none)

    # -- what the ball with its defects meets (section 7, ball defects)

    def features(self, zeta: float) -> list[Feature]:
        """All pairs of elements that may touch in a slice."""
        smooth_tan = zeta / self.rho(zeta)
        arcs, found = self.ball_arcs(zeta), []
        for x in self.surfaces(zeta):
            gap = self.gap(arcs, self.ball_angle(x.normal), self.rho(zeta)) if arcs else None
            if gap is None:
                found.append(Feature(x.kind, x.terms, x.normal, x.point, smooth_tan, x.tangential))
                continue
            # As the ring's edges against the race, so the ball's edges against the surface X.
            edges = [self.ball_circle(zeta, mark, x) for mark in gap.ends]
            drops = [x.s - s for s, *_ in edges]
            both = drops[0] + drops[1]
            terms = [(sign, drop + both) for sign, drop in x.terms]
            kind = f"{x.kind}+in_ball_defect"
            found.append(Feature(kind, terms, x.normal, x.point, smooth_tan, x.tangential))
            for (_, n_e, p, tan, tangential), own in zip(edges, drops, strict=True):
                terms = [(sign, drop + own) for sign, drop in x.terms]
                terms += [(-sign, drop + both) for sign, drop in x.terms]
                found.append(Feature(f"{x.kind}+ball_edge", terms, n_e, p, tan, tangential))
            for mark in gap.floor:  # bare sum
                s, n_e, p, tan, tangential = self.ball_circle(zeta, mark, x)
                terms = [(sign, drop + (x.s - s)) for sign, drop in x.terms]
                found.append(Feature(f"{x.kind}+ball_floor", terms, n_e, p, tan, tangential))
        return found

    def ball_circle(
        self, zeta: float, mark: Mark, x: Surface
    ) -> tuple[Vector, complex, complex, float, TangentialShare]:
        """Penetration, normal, contact point, tan α and tangential share of a circle of the ball on a surface."""
        rho, u = self.rho(zeta), unit(mark.angle + self.ball.theta)
        arm = rho - mark.radius - mark.depth
        centre = self.ball.centre + arm * u
        if x.centre is None:
            line = centre - self.ring.centre
            out = line / abs(line)
            radius = self.groove.radius(self.ring_z(zeta), self.ring_angle(out))
            s = self.sigma * (abs(line) - radius) + mark.radius
            n_e, p = self.sigma * out, self.ring.centre + radius * out
            by_z, tangential = x.s[1], self.race_tangential(line, centre)
        else:
            line = x.centre - centre
            s = x.radius + mark.radius - abs(line)
            n_e = line / abs(line)
            p = x.centre - x.radius * n_e
            by_z, tangential = -dot(n_e, x.centre_rate), x.tangential
        # tan α = −∂s/∂ζ: the gap's own gradient.
        centre_rate = -zeta / rho * u + arm * mark.angle_rate * 1j * u
        tan = dot(tangential.share - n_e, centre_rate)
        return np.array([s, by_z, -tan]), n_e, p, tan, tangential

    # -- forces (sections 4 and 5)

    def apply(self) -> None:
        """Adds the forces of all slices to both bodies."""
        for part in self.slices():
            for feature in self.features(part.zeta):
                self.apply_feature(part, feature)
        self.apply_ends()
        self.apply_place()

    def apply_ends(self) -> None:
        """Axial ends of defects: the energies per length on both sides, times how the end moves.

        The zone is cut along τ (Hertz) or, for the ISO law, along z: there a ring's ends stand still.
        """
        ball, ring = self.ball, self.ring
        of_ring = [
            self.row["axial_position"] + x["axial_offset"] + side * x["length"] / 2
            for x in self.ring_defects
            for side in (-1, 1)
        ]
        of_ball = [
            x["axial_offset"] + side * x["length"] / 2
            for x in self.ball_defects
            for side in (-1, 1)
        ]
        for zeta in distinct([z + ring.z - ball.z for z in of_ring]):
            jump = self.energy_jump(zeta)
            if self.hertz is not None and jump != 0.0:
                cos, sin = self.direction
                self.turn(jump * (zeta * sin - self.R_b) / cos**2)
                self.move(0.0, -jump / cos)
        for zeta in distinct(of_ball):
            jump = self.energy_jump(zeta)
            if self.hertz is None:
                self.move(0.0, jump)
            elif jump != 0.0:
                cos, sin = self.direction
                self.turn(jump * (zeta * sin - self.R_b) / cos**2)

    def energy_jump(self, zeta: float) -> float:
        """Energy per length just below a place less that just above."""
        part = self.slice_at(zeta)
        if part is None:
            return 0.0
        energies = []
        for self.beside in (-1e-12, 1e-12):
            penetrations = [
                (sign, part.penetration(drop[0]))
                for feature in self.features(zeta)
                for sign, drop in feature.terms
            ]
            energies.append(sum(sign * part.energy(s) for sign, s in penetrations))
        self.beside = 0.0
        return energies[0] - energies[1]

    def slice_at(self, zeta: float) -> Slice | None:
        """A slice of length 1, if the zone reaches there."""
        if abs(zeta) >= self.R_b or not self.groove.exists(self.ring_z(zeta)):
            return None
        if self.hertz is None:
            D = self.row["ball_diameter"]
            C = self.model.iso["constant"] * (self.model.iso["length_ratio"] * D) ** (8 / 9)
            part = self.iso_slice(zeta, C / D)
        else:
            cos, sin = self.direction
            tau = (zeta - self.R_b * sin) / cos
            P = self.approach - self.hertz.kappa * tau**2 / 2
            part = Slice(zeta, P, cos, self.hertz.k, 1.0)
        return part if part.depth > 0 else None

    def turn(self, by_angle: float, size: float = 0.0) -> None:
        """A derivative of the energy by α', the angle of the line of centres of length L."""
        cos, sin = self.direction
        size = max(size, abs(by_angle))
        self.by_place += np.array([-sin, cos]) * by_angle / self.L
        self.parts_of_place += np.abs([-sin, cos]) * size / self.L

    def move(self, by_e: float, by_z: float) -> None:
        """Derivatives of the energy by e and z."""
        self.by_place += [by_e, by_z]
        self.parts_of_place += np.abs([by_e, by_z])

    def apply_place(self) -> None:
        """The force through the ball's centre that those derivatives are; e = σ (d − a − R̃(φ))."""
        (by_e, by_z), sizes = self.by_place, self.parts_of_place
        if not sizes.any():
            return
        tangential = self.race_tangential(self.d * self.n, self.ball.centre)
        force = -by_e * self.sigma * self.n + by_e * tangential.share
        size = math.hypot(*sizes) / max(math.hypot(by_e, by_z), 1e-300)
        self.model.add_pair(self.ball, self.ring, self.ball.centre, force, -by_z, parts=size)

    def apply_feature(self, part: Slice, feature: Feature) -> None:
        """Adds the forces of one pair of elements to both bodies."""
        model, ball, ring = self.model, self.ball, self.ring
        E = gross = 0.0
        for sign, drop in feature.terms:
            s = part.penetration(drop[0])
            model.near(s)
            E += sign * part.force(s)
            gross += part.force(s)
        if E <= 0.0:  # a wavy race can make the difference of two laws negative
            return
        model.active[feature.kind] += 1
        if self.hertz is not None:
            self.tilt(part, feature)
        radial = E * (1.0 if self.hertz is None else self.direction[0])
        model.add_pair(
            ball,
            ring,
            feature.tangential.point,
            radial * feature.tangential.share,
            0.0,
            parts=gross / E,
        )
        n_e, p = feature.normal, feature.point
        # Relative velocity at p (section 5).
        v_p = ball.velocity + ball.omega * 1j * (p - ball.centre)
        v_p -= ring.velocity + ring.omega * 1j * (p - ring.centre)
        v_pz = ball.vz - ring.vz
        approach = dot(v_p, n_e)
        if self.hertz is None:
            tan = feature.tan_alpha
            v_n = approach + v_pz * tan
            sin, cos = tan / math.hypot(1.0, tan), 1.0 / math.hypot(1.0, tan)
        else:
            cos_n, sin_n = self.direction
            v_n = approach * cos_n + v_pz * sin_n
            # Along the common tangent: bodies that approach along its normal do not rub.
            sin, cos = sin_n, cos_n
        # Hunt–Crossley (2), (4).
        factor = 1.0 + 1.5 * model.damping * v_n
        F = E * factor
        gross *= 1.0 + abs(1.5 * model.damping * v_n)
        if model.clamp_pull:
            model.near(factor * 1e-5)
            if F < 0:
                model.clamped += 1
                return
        # F is a sum of larger parts, and this many times smaller than the sum of their magnitudes.
        parts = gross / abs(F) if F != 0.0 else 1.0
        # Normal force on the ball (6), (7).
        if self.hertz is None:
            model.add_pair(ball, ring, p, -F * n_e, -F * tan, parts=parts)
        else:
            model.add_pair(ball, ring, p, -F * cos_n * n_e, -F * sin_n, parts=parts)
        # Friction on the ball (8), (9).
        u_t = dot(v_p, 1j * n_e)
        u_m = -approach * sin + v_pz * cos
        u = math.hypot(u_t, u_m)
        mu, v_s = model.friction(u)
        if mu != 0.0:
            f = mu * max(F, 0.0) / math.hypot(u, v_s)
            in_plane = u_t * 1j * n_e - u_m * sin * n_e
            model.add_pair(ball, ring, p, -f * in_plane, -f * u_m * cos, parts=parts)

    def tilt(self, part: Slice, feature: Feature) -> None:
        """What α' and the axial place have to say to the energy of a pair of elements (Hertz law).

        p = δ − κτ²/2 − Δ cos α' at fixed τ, with Δ(z, ζ), ζ = R sin α' + τ cos α' and z = z_b − z_r + ζ.
        """
        cos, sin = self.direction
        tau = (part.zeta - self.R_b * sin) / cos
        zeta_rate = self.R_b * cos - tau * sin
        for sign, (drop, by_z, by_zeta) in feature.terms:
            F = sign * part.force(part.penetration(drop))
            parts = drop * sin, -cos * (by_z + by_zeta) * zeta_rate
            self.turn(F * sum(parts), abs(F) * sum(map(abs, parts)))
            self.move(0.0, -F * cos * by_z)


def distinct(places: list[float]) -> list[float]:
    """Places without those that repeat another but for a rounding."""
    found: list[float] = []
    for place in places:
        if all(abs(place - other) > 2e-12 for other in found):
            found.append(place)
    return found


# ---------------------------------------------------------------------------- the whole bearing


class Reference:
    """The right-hand side of a scene.

    Parameters
    ----------
    scene
        The scene document with every field written out.

    Attributes
    ----------
    names
        Names of the states: all positions, then all velocities.
    active
        How many pairs of elements of each kind carried a force in the last evaluation.
    clamped
        How many of them would have pulled and were set to zero.
    nearest
        Smallest distance from a switching threshold in the last evaluation [m].
    """

    def __init__(self, scene: Json) -> None:
        self.scene = scene
        self.rows: list[Json] = scene["rows"]
        contact = scene["contact"]
        law, slices = contact["law"], contact["slices"]
        is_hertz = law == "hertz"
        self.fitted = "fitted" in slices
        self.slice_count = int(next(iter(slices.values())))
        self.iso: Json = {} if is_hertz else law["iso16281"]
        self.damping = float(contact["damping"])
        self.clamp_pull = bool(contact["clamp_pull"])
        rings = (OUTER, INNER)
        materials = scene["materials"]
        self.grooves = [[groove(row, ring, materials) for ring in rings] for row in self.rows]
        self.hertz: list[list[Hertz | None]] = [
            [hertz(row, ring, scene["materials"]) if is_hertz else None for ring in rings]
            for row in self.rows
        ]
        self._sort_defects()
        self.balls = [(i, j) for i, row in enumerate(self.rows) for j in range(row["ball_count"])]
        bodies = ["outer", "inner", *(f"row{i}.ball{j}" for i, j in self.balls)]
        self.names = [f"{b}.{q}" for b in bodies for q in ("x", "y", "z", "theta")]
        self.names += [f"{b}.{q}" for b in bodies for q in ("vx", "vy", "vz", "omega")]
        self.body_count = len(bodies)
        self._compile_bodies()
        self.active: Counter[str] = Counter()
        self.clamped = 0
        self._clear()

    def _sort_defects(self) -> None:
        """Lists of defects by the surface that carries them."""
        self.ring_defects: list[list[list[Json]]] = [[[], []] for _ in self.rows]
        self.ball_defects: list[dict[int, list[Json]]] = [{} for _ in self.rows]
        for defect in self.scene["defects"].values():
            row = defect["row"]
            if defect["on"] == "ball":
                self.ball_defects[row].setdefault(defect["ball"], []).append(defect)
            else:
                ring = OUTER if defect["on"] == "outer_race" else INNER
                self.ring_defects[row][ring].append(defect)

    def ball_diameter(self, row: int, ball: int) -> float:
        """Diameter D_b of one ball."""
        errors = self.rows[row]["diameter_errors"]
        return float(self.rows[row]["ball_diameter"] + (errors[ball] if errors else 0.0))

    def _compile_bodies(self) -> None:
        """Masses, mounts and nominal places of all bodies."""
        self.mass = np.zeros((self.body_count, 4))
        self.place = np.zeros((self.body_count, 4))
        self.mounts: list[list[Any]] = []
        for ring, name in enumerate(("outer_ring", "inner_ring")):
            entry = self.scene[name]
            absent = "fixed" if ring == OUTER else "free"
            self.mounts.append(self._mounts(entry["support"], absent))
            self.mass[ring] = self._ring_mass(entry, self.mounts[ring])
        for body, (i, j) in enumerate(self.balls, start=2):
            row = self.rows[i]
            D = self.ball_diameter(i, j)
            m = row["ball_mass"]
            if m is None:
                m = self.scene["materials"]["balls"]["density"] * math.pi * D**3 / 6
            J = row["ball_inertia"]
            self.mass[body] = [m, m, m, 0.4 * m * (D / 2) ** 2 if J is None else J]
            c = row["pitch_diameter"] / 2 * unit(row["start_angle"] + TAU * j / row["ball_count"])
            self.place[body] = [c.real, c.imag, row["axial_position"], 0.0]
            self.mounts.append(self._mounts(row["ball_support"], "free"))

    @staticmethod
    def _mounts(support: Json, absent: str) -> list[Any]:
        return [absent if support[q] is None else support[q] for q in ("x", "y", "z", "theta")]

    def _ring_mass(self, ring: Json, mounts: list[Any]) -> list[float]:
        """Mass three times and moment of inertia; zero where they are not needed."""
        m, J = ring["mass"], ring["inertia"]
        if m is None:
            if mounts[:3] != ["fixed"] * 3:
                raise ValueError("the reference wants the mass of a ring that can move")
            m = 0.0
        if J is None:
            if ring["diameter"] is not None and ring["width"] is not None:
                raise ValueError("the reference wants the inertia of a ring with given dimensions")
            J = m * (self.rows[0]["pitch_diameter"] / 2) ** 2
        return [m, m, m, J]

    # -- sums

    def _clear(self) -> None:
        self.forces = np.zeros((self.body_count, 4))
        self.magnitudes = np.zeros((self.body_count, 4))
        self.nearest = math.inf
        self.active.clear()
        self.clamped = 0

    def near(self, distance: float) -> None:
        """Notes the distance of the state from a switching threshold [m]."""
        self.nearest = min(self.nearest, abs(distance))

    def add(
        self, body: int, force: complex, axial: float = 0.0, arm: complex = 0.0, parts: float = 1.0
    ) -> None:
        """Adds one force, acting at `arm` from the body's centre.

        It is itself a sum, whose parts have `parts` times its magnitude.
        """
        torques = arm.real * force.imag, arm.imag * force.real
        self.forces[body] += [force.real, force.imag, axial, torques[0] - torques[1]]
        sizes = [abs(force.real), abs(force.imag), abs(axial), abs(torques[0]) + abs(torques[1])]
        self.magnitudes[body] += [parts * size for size in sizes]

    def add_pair(
        self, ball: Body, ring: Body, p: complex, force: complex, axial: float, *, parts: float
    ) -> None:
        """Adds a force at the point p, a sum of parts, to the ball and its opposite to the ring."""
        self.add(ball.index, force, axial, p - ball.centre, parts)
        self.add(ring.index, -force, -axial, p - ring.centre, parts)

    def add_torque(self, body: int, torque: float) -> None:
        """Adds a torque about z."""
        self.forces[body, 3] += torque
        self.magnitudes[body, 3] += abs(torque)

    # -- laws

    def friction(self, u: float) -> tuple[float, float]:
        """Coefficient μ at a slip, and v_s."""
        law = self.scene["friction"]
        if law == "none":
            return 0.0, 1.0
        (kind, p), *_ = law.items()
        if kind == "coulomb":
            mu = p["coefficient"]
        elif kind == "stribeck":
            fall = math.exp(-((u / p["stribeck_speed"]) ** 2))
            mu = p["kinetic_coefficient"]
            mu += (p["static_coefficient"] - p["kinetic_coefficient"]) * fall
        else:
            mu = (p["a"] + p["b"] * u) * math.exp(-p["c"] * u) + p["d"]
        return float(mu), float(p["slip_speed"])

    def _add_cage(self, bodies: list[Body]) -> None:
        """Links between neighbouring balls (section 6)."""
        cage = self.scene["cage"]
        first = 2
        for row in self.rows if cage is not None else []:
            Z = row["ball_count"]
            l_0 = row["pitch_diameter"] * math.sin(math.pi / Z)
            links = Z if Z > 2 else Z - 1
            for j in range(links):
                one, other = bodies[first + j], bodies[first + (j + 1) % Z]
                line = other.centre - one.centre
                u = line / abs(line)
                x, half = abs(line) - l_0, cage["play"] / 2
                if half > 0:
                    self.near(abs(x) - half)
                if half > 0 and abs(x) <= half:
                    continue
                extension = x - math.copysign(half, x)
                spring = cage["stiffness"] * extension
                damper = cage["damping"] * dot(other.velocity - one.velocity, u)
                for pull in (spring, damper):
                    self.add(one.index, pull * u)
                    self.add(other.index, -pull * u)
            first += Z

    def _add_outside(self, t: float, bodies: list[Body]) -> None:
        """Gravity, loads, unbalances, the drive's torque."""
        gx, gy, gz = self.scene["gravity"]
        for body in range(self.body_count):
            m = float(self.mass[body, 0])
            self.add(body, m * complex(gx, gy), m * gz)
        rings = {"outer": OUTER, "inner": INNER}
        for load in self.scene["loads"].values():
            dx, dy, dz = load["direction"]
            F = time_value(load["force"], t) / math.hypot(dx, dy, dz)
            self.add(rings[load["ring"]], F * complex(dx, dy), F * dz)
        drive = self.scene["drive"]
        self.unbalance = [0j, 0j]
        for unbalance in self.scene["unbalances"].values():
            ring = bodies[rings[unbalance["ring"]]]
            u = unbalance["moment"] * unit(unbalance["angle"] + ring.theta)
            self.unbalance[ring.index] += u
            self.add(ring.index, ring.omega**2 * u)
            self.add_torque(ring.index, cross(u, complex(gx, gy)))
        if "torque" in drive:
            self.add_torque(INNER, time_value(drive["torque"]["value"], t))

    def _add_supports(self, q: Vector, v: Vector) -> None:
        """Springs and dampers to the inertial frame."""
        for body, mounts in enumerate(self.mounts):
            for i, mount in enumerate(mounts):
                if isinstance(mount, dict):
                    spring = mount["spring"]["stiffness"] * (q[body, i] - self.place[body, i])
                    damper = mount["spring"]["damping"] * v[body, i]
                    self.forces[body, i] -= spring + damper
                    self.magnitudes[body, i] += abs(spring) + abs(damper)

    # -- what a user asks for

    def evaluate(self, t: float, y: Vector) -> tuple[Vector, Vector]:
        """All forces on all bodies.

        Parameters
        ----------
        t
            Time [s].
        y
            State, in the order of `names`.

        Returns
        -------
        forces
            Forces x, y, z [N] and torque about z [N m] on every body, shape (bodies, 4).
        magnitudes
            The sum of the absolute values of the single contributions, same shape.
        """
        self._clear()
        q = np.asarray(y, dtype=float)[: 4 * self.body_count].reshape(-1, 4)
        v = np.asarray(y, dtype=float)[4 * self.body_count :].reshape(-1, 4)
        bodies = [
            Body(
                i,
                complex(a[0], a[1]),
                float(a[2]),
                float(a[3]),
                complex(b[0], b[1]),
                *map(float, b[2:]),
            )
            for i, (a, b) in enumerate(zip(q, v, strict=True))
        ]
        for body, (row, j) in enumerate(self.balls, start=2):
            for ring in (OUTER, INNER):
                Contact(self, row, j, bodies[body], bodies[ring]).apply()
        self._add_cage(bodies)
        self._add_outside(t, bodies)
        self._add_supports(q, v)
        return self.forces.copy(), self.magnitudes.copy()

    def fixed(self) -> NDArray[np.bool_]:
        """Which coordinates do not follow their force, shape (bodies, 4)."""
        fixed = np.array([[mount == "fixed" for mount in mounts] for mounts in self.mounts])
        fixed[INNER, 3] |= "speed" in self.scene["drive"]
        return fixed

    def rhs(self, t: float, y: Vector) -> Vector:
        """Derivative of the state: velocities, then accelerations.

        Parameters
        ----------
        t
            Time [s].
        y
            State, in the order of `names`.
        """
        forces, _ = self.evaluate(t, y)
        fixed = self.fixed()
        a = np.zeros_like(forces)
        a[~fixed] = forces[~fixed] / self.mass[~fixed]
        if "speed" in self.scene["drive"]:
            a[INNER, 3] = time_rate(self.scene["drive"]["speed"], t)
        for ring, u in enumerate(self.unbalance):
            if u != 0:
                self._accelerate_unbalanced(ring, u, forces[ring], a[ring])
        return np.concatenate([np.asarray(y, dtype=float)[4 * self.body_count :], a.ravel()])

    def _accelerate_unbalanced(self, ring: int, u: complex, forces: Vector, a: Vector) -> None:
        """Accelerations x, y, θ of a ring whose mass has its centre at u/m: what is not free is known."""
        m, J = self.mass[ring, 0], self.mass[ring, 3]
        matrix = np.array([[m, 0.0, -u.imag], [0.0, m, u.real], [-u.imag, u.real, J]])
        places = [0, 1, 3]
        free = ~self.fixed()[ring, places]
        known = np.where(free, 0.0, a[places])
        right = (forces[places] - matrix @ known)[free]
        known[free] = np.linalg.solve(matrix[np.ix_(free, free)], right)
        a[places] = known

    def threshold_distance(self, y: Vector) -> float:
        """Smallest distance of anything in this state from a switching threshold [m].

        Parameters
        ----------
        y
            State, in the order of `names`.
        """
        self.evaluate(0.0, y)
        return self.nearest
