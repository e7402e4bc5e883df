"""What tests of oils share."""

from __future__ import annotations

import math


def astm_d341(at_40: float, at_100: float, celsius: float) -> float:
    """Kinematic viscosity [mm²/s] from those at 40 and 100 °C: log log (ν + 0.7) = A - B log T."""

    def twice(nu: float) -> float:
        return math.log10(math.log10(nu + 0.7))

    T40, T100, T = 313.15, 373.15, 273.15 + celsius
    B = (twice(at_40) - twice(at_100)) / math.log10(T100 / T40)
    return float(10.0**10.0 ** (twice(at_40) - B * math.log10(T / T40))) - 0.7
