"""Records, measured or simulated, read from and written to common file formats.

:func:`read` returns a :class:`Recording`, whose columns go into the same functions as those of a run;
:meth:`Recording.write`, which runs have too, writes the format that a file's name ends in.

====================  ======================  =======================  ================  ============
format                ends in                 numbers                  keeps             needs
====================  ======================  =======================  ================  ============
CSV                   ``.csv``, ``.txt``      all digits               rate, names,      —
                                                                       units
WAV                   ``.wav``                32-bit floats, unscaled  all               —
MATLAB, CWRU's keys   ``.mat``                64 bits                  all               —
Universal File 58     ``.uff``, ``.unv``      64 bits                  all but metadata  extra ``io``
HDF5                  ``.h5``, ``.hdf5``      64 bits                  all               extra ``io``
Parquet               ``.parquet``, ``.pq``   64 bits                  all               —
====================  ======================  =======================  ================  ============
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._later import later

if TYPE_CHECKING:
    from .dispatch import read
    from .recording import Recording
else:
    # Signals have columns as records do, and need no formats for it.
    __getattr__ = later(__name__, {"dispatch": ("read",), "recording": ("Recording",)})

__all__ = ["Recording", "read"]
