"""Units of vibration: how instruments spell them, and accelerations and velocities in the common ones."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import SceneError

GRAVITY = 9.80665
"""Standard gravity, one g [m/s²], by the definition of the CGPM of 1901."""

_INCH = 0.0254

ACCELERATIONS = {
    "m/s^2": 1.0, "g": GRAVITY, "mg": 1e-3 * GRAVITY, "mm/s^2": 1e-3, "cm/s^2": 1e-2, "in/s^2": _INCH,
    "ft/s^2": 12.0 * _INCH,
}  # fmt: skip
VELOCITIES = {"m/s": 1.0, "mm/s": 1e-3, "cm/s": 1e-2, "µm/s": 1e-6, "in/s": _INCH}

ENVELOPE = "gE"
"""Unit of enveloped acceleration, as monitoring instruments export it."""

_DISPLACEMENTS = ("m", "mm", "µm", "mil", "in")
_VOLTAGES = ("V", "mV", "µV")
_SENSITIVITIES = ("mV/g", "V/g", "mV/(m/s^2)", "pC/g")

_OTHERS = (
    "N",
    "kN",
    "N m",
    "Hz",
    "°C",
    "°F",
    "K",
    "%",
    "A",
    "mA",
    "bar",
    "Pa",
    "kPa",
    "MPa",
    "rad",
    "deg",
    "°",
    "dB",
)

_SPELLINGS = {
    "m/s^2": "m/s2 m/s/s m/(s2) ms-2 ms2 mps2 m/sec2 m/sec/sec m/ss meter/s2 meters/s2 meter/sec2",
    "g": "g gs g's gn g0 gravity gravities g-force",
    "mg": "mg milli-g millig",
    "mm/s^2": "mm/s2 mm/s/s mms-2 mm/sec2 mm/sec/sec",
    "cm/s^2": "cm/s2 cm/s/s cms-2 cm/sec2 gal",
    "in/s^2": "in/s2 in/s/s ins-2 ips2 inch/s2 in/sec2 in/sec/sec",
    "ft/s^2": "ft/s2 ft/s/s fts-2 ft/sec2 ft/sec/sec",
    "m/s": "m/s ms-1 m/sec mps",
    "mm/s": "mm/s mms-1 mm/sec mmps",
    "cm/s": "cm/s cms-1 cm/sec",
    "µm/s": "µm/s um/s µms-1 ums-1 µm/sec um/sec",
    "in/s": "in/s ins-1 in/sec inch/s inch/sec inches/s ips",
    "µm": "µm um micron microns",
    "mil": "mil mils",
    "in": "in inch inches",
    ENVELOPE: "ge gse ges envg genv",
    "V": "v volt volts",
    "mV": "mv millivolt millivolts",
    "µV": "µv uv",
    "mV/(m/s^2)": "mv/(m/s2) mv/m/s2 mv/ms-2",
    **{unit: unit.lower().replace("^", "") for unit in ("m", "mm", "mV/g", "V/g", "pC/g")},
}
"""How each unit is written, in small letters, without blanks, dots and signs of powers."""

_CANONICAL = {text: unit for unit, texts in _SPELLINGS.items() for text in texts.split()}
_CANONICAL |= {unit.lower().replace(" ", ""): unit for unit in _OTHERS}

_ALIKE = str.maketrans(
    {"μ": "µ", "²": "2", "⁻": "-", "¹": "1", "−": "-", "·": None, "*": None, ".": None, "^": None, " ": None,
     "\xa0": None, "⋅": None}
)  # fmt: skip


def canonical(unit: str) -> str:
    """Return the name of a unit however it is spelled; text that is none it knows comes back as it is.

    >>> [canonical(unit) for unit in ("m/s2", "m.s-2", "m s⁻²", "m/s/s", "m/s²", "G", "ips", "Volt")]
    ['m/s^2', 'm/s^2', 'm/s^2', 'm/s^2', 'm/s^2', 'g', 'in/s', 'V']
    """
    return _CANONICAL.get(unit.lower().translate(_ALIKE), unit)


def is_unit(text: str) -> bool:
    """Whether a text is a unit of a measured quantity.

    >>> is_unit("m.s-2"), is_unit("left")
    (True, False)
    """
    return text.lower().translate(_ALIKE) in _CANONICAL


def in_unit(
    x: NDArray[np.float64], fs: float, unit: str, wanted: str, band: tuple[float, float]
) -> NDArray[np.float64]:
    """Return a signal in another unit; an acceleration as a velocity by integration in the spectrum.

    Raises
    ------
    SceneError
        A unit is none of those above, a velocity is to become an acceleration, or numbers are too large.
    """
    unit, wanted = canonical(unit), canonical(wanted)
    known = ACCELERATIONS | VELOCITIES
    if wanted not in known:
        raise SceneError("unit", repr(wanted), f"one of {', '.join(known)}")
    if unit not in known:
        raise SceneError("unit", repr(unit), _remedy(unit))
    scale = known[unit] / known[wanted]
    if unit in VELOCITIES and wanted in ACCELERATIONS:
        raise SceneError("unit", repr(wanted), f"a velocity, as the record in {unit} is one")
    integrates = unit in ACCELERATIONS and wanted in VELOCITIES
    with np.errstate(over="ignore", invalid="ignore"):
        found = scale * (_integrated(x, fs, band) if integrates else x)
    if not np.isfinite(found).all() and np.isfinite(x).all():
        allowed = f"numbers that are finite in {wanted}, too"
        raise SceneError("x", f"{np.abs(x).max():g} {unit}", allowed)
    return found


def _remedy(unit: str) -> str:
    """Return what a record in a unit that is no acceleration or velocity lacks."""
    if unit in _VOLTAGES:
        scale = {"V": 0.1, "mV": 100.0, "µV": 1e5}[unit]
        return (
            "an acceleration: divide the voltage by the sensor's sensitivity; for 100 mV/g it is "
            f'br.Recording(x / {scale:g}, fs=fs, unit="g")'
        )
    if unit in _SENSITIVITIES:
        return "the unit of the samples, V or g for example; this is the sensitivity of a sensor"
    if unit == ENVELOPE:
        return "an acceleration as measured: gE is its envelope, from which no acceleration is to be had"
    if unit in _DISPLACEMENTS:
        return "an acceleration or a velocity; this is a displacement"
    return f"a record in one of {', '.join(ACCELERATIONS | VELOCITIES)}; give its unit"


def _integrated(
    x: NDArray[np.float64], fs: float, band: tuple[float, float]
) -> NDArray[np.float64]:
    """Integrate once: division by 2πif within the band, nothing outside."""
    low, high = band
    if not 0.0 < low < high:
        raise SceneError("band", repr(band), "two rising frequencies above 0 [Hz]")
    f = np.fft.rfftfreq(x.size, 1.0 / fs)
    inside = (f >= low) & (f <= high)
    spectrum = np.zeros(f.size, dtype=np.complex128)
    spectrum[inside] = np.fft.rfft(x)[inside] / (2j * np.pi * f[inside])
    return np.fft.irfft(spectrum, x.size)
