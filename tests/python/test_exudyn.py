"""The healthy 6205 under 500 N beside Exudyn, an independent multibody program.

Truth: Exudyn (extra ``validation``; J. Gerstmayr, Multibody Syst. Dyn. 60 (2024) 533) with its contact of a
sphere in a torus, set up with the same geometry, masses, cage springs, friction and the Hertz constants that
our contacts have. It differs where it must: its contact is a point, so that a ball rolls on its full diameter
there and on a little less here (see ``test_defect_frequencies.py``), and its contact damping is linear.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import ballrace as br
from ballrace import frequencies
from ballrace.scene import ContactsProbe, Coulomb, Load, MotionProbe, SpeedDrive, Support
from truth import meets

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.long

DURATION = 0.3
SETTLED = 0.1
"""From here on results are averaged [s]: two turns of the cage and a bit."""
FS = 10_000.0
LOWEST = math.radians(5.0)
"""A ball within this of the load line is the lowest."""


@dataclass(frozen=True)
class Found:
    orbit: float
    """Of the balls, over the shaft's rate."""
    deflection: float
    """Mean place of the inner ring along the load [m]."""
    load: float
    """Mean load of the lowest ball on the outer race [N]."""
    wall: float
    """Time it took [s]."""


def scene() -> br.Scene:
    """Return the 6205 with a fixed outer ring and no play in the cage."""
    bearing = br.presets.deep_groove_6205(500.0).replace({"cage.play": 0.0})
    return replace(bearing, outer_ring=replace(bearing.outer_ring, support=Support()), defects={})


def judge(phases: list[Any], loads: list[Any], ring: Any, rate: float, wall: float) -> Found:
    """Average over the settled part; one phase [rad] and one load [N] a ball."""
    first = round(SETTLED * FS)
    turns = [(phi[-1] - phi[first]) / (phi.size - 1 - first) * FS / math.tau for phi in phases]
    place = np.concatenate([np.angle(np.exp(1j * (phi[first:] + math.pi / 2.0))) for phi in phases])
    load = np.concatenate([q[first:] for q in loads])
    return Found(
        orbit=float(np.mean(turns)) / rate,
        deflection=-float(np.mean(ring[first:])),
        load=float(np.mean(load[np.abs(place) < LOWEST])),
        wall=wall,
    )


def ours(bearing: br.Scene, rate: float) -> Found:
    count = bearing.rows[0].ball_count
    probes: dict[str, Any] = {
        f"ball{b}": MotionProbe(body=f"row0.ball{b}", components=("x", "y")) for b in range(count)
    }
    probes["inner"] = MotionProbe(body="inner", components=("y",))
    probes["row"] = ContactsProbe(races=("outer",), quantities=("load",))
    started = time.perf_counter()
    out = br.simulate(
        replace(bearing, probes=probes),
        duration=DURATION,
        fs=FS,
        start="rolling",
        threads=1,
        bandwidth=None,
    )
    wall = time.perf_counter() - started
    phases = [np.unwrap(np.arctan2(out[f"ball{b}.y"], out[f"ball{b}.x"])) for b in range(count)]
    loads = [out[f"row.ball{b}.outer.load"] for b in range(count)]
    return judge(phases, loads, out["inner.y"], rate, wall)


def implicit(exudyn: Any, duration: float = DURATION, step: float = 1e-5, fs: float = FS) -> Any:
    """Return the settings of the generalized-α method with fixed steps on one thread."""
    settings = exudyn.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 1.0 / fs
    settings.timeIntegration.numberOfSteps = round(duration / step)
    settings.timeIntegration.endTime = duration
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.8
    settings.timeIntegration.verboseMode = 0
    # Steps are short enough to pass contacts opening and closing; searching for the moment fails.
    settings.timeIntegration.adaptiveStep = False
    settings.timeIntegration.discontinuous.useRecommendedStepSize = False
    settings.timeIntegration.discontinuous.iterationTolerance = 1e6
    settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
    settings.parallel.numberOfThreads = 1
    return settings


@dataclass(frozen=True)
class Built:
    """The bearing in Exudyn, before it is assembled."""

    system: Any
    inner: Any
    balls: list[Any]
    gaps: list[Any]
    """Nodes of the outer contacts."""


def constants(load: float = 500.0) -> tuple[float, float]:
    """Return the constants of both contacts, from a bearing at rest whose equilibrium is known."""
    rest = br.equilibrium(br.presets.deep_groove_6205(load))
    at = int(np.argmax(rest.outer_load))
    return (
        float(rest.outer_load[at] / rest.outer_deflection[at] ** 1.5),
        float(rest.inner_load[at] / rest.inner_deflection[at] ** 1.5),
    )


def build(bearing: br.Scene, rate: float, outer_constant: float, inner_constant: float) -> Built:
    exudyn: Any = pytest.importorskip("exudyn", reason="the extra `validation` is not installed")
    items: Any = pytest.importorskip("exudyn.itemInterface")
    rigid: Any = pytest.importorskip("exudyn.rigidBodyUtilities")

    row, cage, friction = bearing.rows[0], bearing.cage, bearing.friction
    load, mount = bearing.loads["radial"], bearing.inner_ring.support.x
    assert cage is not None
    assert isinstance(friction, Coulomb)
    assert isinstance(load, Load)
    assert isinstance(mount, br.scene.Spring)
    count, radius, pitch = row.ball_count, row.ball_diameter / 2.0, row.pitch_diameter / 2.0
    outer_groove, inner_groove = (
        f * row.ball_diameter for f in (row.outer_conformity, row.inner_conformity)
    )
    ball_mass = bearing.materials.balls.density * math.pi / 6.0 * row.ball_diameter**3
    gravity = list(bearing.gravity)
    shaft = math.tau * rate
    orbit = shaft * frequencies.of_row(row).ftf

    system = exudyn.SystemContainer().AddSystem()
    ground = system.CreateGround()
    # Three rotation angles, so that an explicit method could be used too; an inertia so large that the
    # ring keeps its axis and its speed.
    inner = system.CreateRigidBody(
        nodeType=exudyn.NodeType.RotationRxyz,
        inertia=rigid.RigidBodyInertia(mass=bearing.inner_ring.mass, inertiaTensor=1e6 * np.eye(3)),
        initialAngularVelocity=[0.0, 0.0, shaft],
        gravity=gravity,
    )
    system.CreateCartesianSpringDamper(
        itemNumbers=[inner, ground], stiffness=[mount.stiffness] * 3, damping=[mount.damping] * 3
    )
    assert isinstance(load.force, float)
    system.CreateForce(itemNumber=inner, loadVector=[0.0, -load.force, 0.0])
    rings = (
        (
            ground,
            pitch - (outer_groove - radius) + row.clearance / 4.0,
            outer_groove,
            outer_constant,
        ),
        (
            inner,
            pitch + (inner_groove - radius) - row.clearance / 4.0,
            inner_groove,
            inner_constant,
        ),
    )
    balls, gaps = [], []
    for b in range(count):
        phi = row.start_angle + math.tau * b / count
        ball = system.CreateRigidBody(
            nodeType=exudyn.NodeType.RotationRxyz,
            referencePosition=[pitch * math.cos(phi), pitch * math.sin(phi), 0.0],
            initialVelocity=[-orbit * pitch * math.sin(phi), orbit * pitch * math.cos(phi), 0.0],
            initialAngularVelocity=[0.0, 0.0, -orbit * pitch / radius],
            inertia=rigid.InertiaSphere(mass=ball_mass, radius=radius),
            gravity=gravity,
        )
        marker = system.AddMarker(items.MarkerBodyRigid(bodyNumber=ball))
        for body, major, minor, constant in rings:
            node = system.AddNode(
                items.NodeGenericData(initialCoordinates=[0.0] * 4, numberOfDataCoordinates=4)
            )
            system.AddObject(
                items.ObjectContactSphereTorus(
                    markerNumbers=[
                        marker,
                        system.AddMarker(items.MarkerBodyRigid(bodyNumber=body)),
                    ],
                    nodeNumber=node,
                    sphereRadius=radius,
                    torusMajorRadius=major,
                    torusMinorRadius=minor,
                    torusAxis=[0.0, 0.0, 1.0],
                    dynamicFriction=friction.coefficient,
                    frictionProportionalZone=friction.slip_speed,
                    contactStiffness=constant,
                    contactStiffnessExponent=1.5,
                    # Ours at the load of the lowest ball, 1.5 α_d F.
                    contactDamping=1.5 * bearing.contact.damping * 250.0,
                )
            )
            if body == ground:
                gaps.append(node)
        balls.append(ball)
    for b in range(count):
        system.CreateSpringDamper(
            itemNumbers=[balls[b], balls[(b + 1) % count]],
            referenceLength=2.0 * pitch * math.sin(math.pi / count),
            stiffness=cage.stiffness,
            damping=cage.damping,
        )
    return Built(system, inner, balls, gaps)


def theirs(bearing: br.Scene, rate: float, outer_constant: float, inner_constant: float) -> Found:
    exudyn: Any = pytest.importorskip("exudyn", reason="the extra `validation` is not installed")
    items: Any = pytest.importorskip("exudyn.itemInterface")
    built = build(bearing, rate, outer_constant, inner_constant)
    system = built.system
    position = exudyn.OutputVariableType.Position
    places = [
        system.AddSensor(
            items.SensorBody(bodyNumber=body, storeInternal=True, outputVariableType=position)
        )
        for body in [built.inner, *built.balls]
    ]
    states = [
        system.AddSensor(
            items.SensorNode(
                nodeNumber=node,
                storeInternal=True,
                outputVariableType=exudyn.OutputVariableType.Coordinates,
            )
        )
        for node in built.gaps
    ]
    system.Assemble()

    settings = implicit(exudyn)
    started = time.perf_counter()
    system.SolveDynamic(settings)
    wall = time.perf_counter() - started

    ring, *paths = (system.GetSensorStoredData(sensor) for sensor in places)
    phases = [np.unwrap(np.arctan2(path[:, 2], path[:, 1])) for path in paths]
    loads = [
        outer_constant * np.maximum(-system.GetSensorStoredData(state)[:, 1], 0.0) ** 1.5
        for state in states
    ]
    return judge(phases, loads, ring[:, 2], rate, wall)


def test_the_healthy_6205_agrees(record_property: Callable[[str, object], None]) -> None:
    pytest.importorskip("exudyn", reason="the extra `validation` is not installed")
    bearing = scene()
    drive = bearing.drive
    assert isinstance(drive, SpeedDrive)
    assert isinstance(drive.speed, float)
    rate = drive.speed / math.tau
    outer_constant, inner_constant = constants()
    they = theirs(bearing, rate, outer_constant, inner_constant)
    we = ours(bearing, rate)
    for name, found in (("exudyn", they), ("ballrace", we)):
        record_property(name, found)
    # The point contact rolls on its full diameter.
    assert they.orbit == pytest.approx(frequencies.of_row(bearing.rows[0]).ftf, rel=1e-3)
    assert they.orbit < we.orbit < they.orbit * 1.003
    meets("6205 beside Exudyn: mean deflection, m", they.deflection, we.deflection, 2e-3)
    meets("6205 beside Exudyn: load of the lowest ball, N", they.load, we.load, 2e-3)
    meets("6205 beside Exudyn: orbit over shaft", they.orbit, we.orbit, 3e-3)
