"""The published case, simulated: figures 5 to 11 of the paper and its numbers beside ours.

Source: P. Tkachuk, J. Strackeljan, *A 3D-ball bearing model for simulation of axial load variations*: a
double-row wheel bearing under 7 kN with a defect on the outer ring, and 0, +3 or -3 kN along its axis.

How each number is taken:

- *Signals* are point samples (``bandwidth=None``), as the paper computed its own; what :func:`ballrace.simulate`
  gives by default has passed a low-pass, and its impacts are lower by what lies above 0.4 fs.
- *Impact*: the largest ``|outer.ay - mean|`` in each passage of a ball of the faulted row after 0.02 s, sampled
  at 200 kHz without a filter; mean over all whole passages. A passage is one ball pitch at the rate at which the
  balls of the run go round, with the defect in its middle.
- *Envelope line*: the magnitude of the analytic signal of the acceleration between 0.5 and 20 kHz; of this the
  amplitude of the oscillation at the passing frequency, over the same whole passages.
- *Line over its surroundings* and *scatter of impacts*: figure 11 shows "no clear fault structure". In a signal
  without one the squared envelope's line at the passing frequency is hardly above what surrounds it
  (10 dB and less; noise alone gives 4 to 9 dB), and its impacts differ by a fifth of their mean and more.
- *Ball in the middle of the load zone*: the ball of the faulted row nearest to -90° at t = 0.017992 s (figure 9).
  The contact zone's place is the middle of its slices' forces, in the outer ring's frame; its length that of the
  slices that bear. 200 slices of equal width. Static: the healthy bearing with a ball at -90°. With the ball on
  the defect the place depends on where in the defect it is: a tenth of a degree moves the shift by 0.06 mm.
- *Transient*, of the rolling start: the last time at which the healthy bearing's rms over 2 ms, about its mean, is
  above that of a vibration with a twentieth of the mean impact under purely radial load as its amplitude; the
  latest of the three loads. Of the equilibrium start, unsettled: the healthy bearing's rms over the first
  passage of a ball against that of the rolling start.
"""

from .case import Balls, Case, Dynamic, Snapshot, Static
from .comparison import AXIAL_LOADS, TARGETS, Comparison, Target, compare
from .measures import (
    ENVELOPE_BAND,
    Zone,
    clarity,
    envelope_line,
    impacts,
    orbit,
    passages,
    settling_time,
    zone,
)
from .page import HEADER, rows
from .report import dumps, write, write_page
from .simulations import FS, INSTANT, SETTLED, SIGNALS, dynamic, snapshot, static, turned
from .study import DURATION, Paper, bearing, run

__all__ = [
    "AXIAL_LOADS",
    "DURATION",
    "ENVELOPE_BAND",
    "FS",
    "HEADER",
    "INSTANT",
    "SETTLED",
    "SIGNALS",
    "TARGETS",
    "Balls",
    "Case",
    "Comparison",
    "Dynamic",
    "Paper",
    "Snapshot",
    "Static",
    "Target",
    "Zone",
    "bearing",
    "clarity",
    "compare",
    "dumps",
    "dynamic",
    "envelope_line",
    "impacts",
    "orbit",
    "passages",
    "rows",
    "run",
    "settling_time",
    "snapshot",
    "static",
    "turned",
    "write",
    "write_page",
    "zone",
]
