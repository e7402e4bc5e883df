"""Bearings that are no ball bearings of the catalogue, by the names they are sold by."""

from __future__ import annotations

import math
import re

from ..frequencies.kinematic import Orders, orders

_KINDS = (
    (r"(R?NUP?|R?NJ|NF|NH|NCF|NJG|NN[UC]?F?|R?N)\d", "a cylindrical roller bearing"),
    (r"(NA|RNA|NKI?A?S?|NK[ISX]|HK|BK|K|NX|AXK|F?NTN?)\d", "a needle roller bearing"),
    (
        r"(BS2)?(213|222|223|230|231|232|233|238|239|240|241)\d\d(?!\d)",
        "a spherical roller bearing",
    ),
    (r"(4T|HR|T|K)?3(02|03|13|20|22|23|29|30|31|32)\d\d(?!\d)", "a tapered roller bearing"),
    (r"ZA2", "a roller bearing of two rows"),
    (r"C[23456]\d\d\d", "a toroidal roller bearing"),
    (r"29[234]\d\d|8[179][1-4]\d\d", "a roller thrust bearing"),
    (r"(1[0-4]|2[23])\d\d(?!\d)|1(08|26|27|29|35)(?!\d)", "a self-aligning ball bearing"),
    (r"5[1-4][1-4]\d\d", "a thrust ball bearing of another series"),
    (r"QJ?F?\d", "a four-point bearing"),
    (r"4[23]\d\d(?!\d)", "a double row deep groove bearing"),
    (r"(UC|SA|SB|YAR|YET|GYE?|GRAE|GE|YEL|UK)[A-Z]{0,3}2\d\d", "an insert bearing"),
)
"""Beginning of a designation, by the systems of SKF, FAG, NSK and NTN, and what it means."""

_MEANT = {
    "a self-aligning ball bearing": "its outer race is a sphere, which ballrace does not have",
    "a four-point bearing": "write a scene with br.scene.GothicArch",
    "a double row deep groove bearing": "write a scene of two rows",
    "an insert bearing": "it has the balls of a deep groove bearing of the series 62, such as 6205 for UC205",
    "a thrust ball bearing of another series": "the catalogue has 51100 to 51124",
}
_ROLLERS = "ballrace simulates ball bearings"

_KNOWN = {
    # J. Lee and others, IMS bearing data: 16 rollers of 0.331 inch on 2.815 inch at 15.17°.
    "ZA2115": orders(16, 0.331, 2.815, math.radians(15.17)),
    # Published for 1000 1/min: cage 6.67, rollers 42.5 and outer race 93.4 Hz, which is 14 times the cage; so the
    # inner race has 14 times 10 Hz (globalspec.com, reference 77830, section 1.7.1).
    "NU330": Orders(ftf=0.4, bpfo=5.6, bpfi=8.4, bsf=2.55),
}


def why_not(text: str) -> str | None:
    """Return why a bearing of this name, without maker, is not in the catalogue; None where it is not known.

    Examples
    --------
    >>> import textwrap
    >>> print(textwrap.fill(why_not("NU205"), 108))
    NU205 is a cylindrical roller bearing: ballrace simulates ball bearings; br.frequencies.orders has its fault
    frequencies by number and diameter of its rolling elements
    """
    # NU 205 is NU205; what follows a number stays apart from it.
    name = re.sub(r"(?<=[A-Z])[-\s]+(?=\d)", "", text.strip(), count=1)
    for pattern, what in _KINDS:
        if re.match(pattern, name):
            return f"{text.strip()} is {what}: {_MEANT.get(what, _ROLLERS)}{_rates(name)}"
    return None


def _rates(name: str) -> str:
    known = next((found for start, found in _KNOWN.items() if name.startswith(start)), None)
    if known is None:
        return "; br.frequencies.orders has its fault frequencies by number and diameter of its rolling elements"
    lines = ("ftf", "bpfo", "bpfi", "bsf")
    orders = ", ".join(f"{line.upper()} {getattr(known, line):.4g}" for line in lines)
    return f"; its fault frequencies are {orders} times the shaft's"
