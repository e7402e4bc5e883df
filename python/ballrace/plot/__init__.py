"""Pictures, by plotly: ``pip install "ballrace[plot]"``.

Each function draws into ``fig`` if one is given, passes ``layout`` on to ``fig.update_layout``, and returns the
figure, whose ``data`` hold the numbers. :func:`write` makes a page of one that needs no network, and
:data:`CONFIG` switches plotly's logo and cloud off elsewhere: ``fig.show(config=br.plot.CONFIG)``.

>>> import ballrace as br
>>> scene = br.bearing("6205", defects=br.defects.spall(on="inner_race", width_mm=1.0), speed_rpm=1800.0)
>>> fig = br.plot.envelope_spectrum(br.simulate(scene, duration=0.1))

===============================  ===========================================================================
of a signal                      :func:`impacts`, :func:`envelope_spectrum`, :func:`psd`,
                                 :func:`spectrogram`, :func:`order_map`, :func:`kurtogram`
of a run                         :func:`signals`, :func:`load_cases`, :func:`orbit`, :func:`ball_path`,
                                 :func:`slice_forces`, :func:`animation`, :func:`animation3d`
of a bearing under load          :func:`section`, :func:`load_distribution`, :func:`force_distribution`,
                                 :func:`unrolled`
of a campaign                    :func:`campaign_map`, :func:`distribution`
===============================  ===========================================================================

No colour stands alone: lines differ in their dashes and markers, and what matters is named in the picture.
"""

from __future__ import annotations

from .._base.later import listed
from .animation import animation, probes
from .animation3d import animation3d
from .campaigns import campaign_map, distribution
from .loads import force_distribution, load_distribution, slice_forces
from .maps import kurtogram, order_map, spectrogram
from .motion import ball_path, orbit
from .races import unrolled
from .section import section
from .spectra import envelope_spectrum, psd
from .style import CONFIG, write
from .times import impacts, load_cases, signals

__all__ = [
    "CONFIG",
    "animation",
    "animation3d",
    "ball_path",
    "campaign_map",
    "distribution",
    "envelope_spectrum",
    "force_distribution",
    "impacts",
    "kurtogram",
    "load_cases",
    "load_distribution",
    "orbit",
    "order_map",
    "probes",
    "psd",
    "section",
    "signals",
    "slice_forces",
    "spectrogram",
    "unrolled",
    "write",
]

__dir__ = listed(__name__)
