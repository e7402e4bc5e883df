"""Records, measured or simulated, read from and written to common file formats.

:func:`read` returns a :class:`Recording`, whose columns go into the same functions as those of a run;
:meth:`Recording.write`, which runs have too, writes the format that a file's name ends in.

======================  ===========================  =========================  =====================  ==========
format                  ends in                      numbers                    written, keeps         needs
======================  ===========================  =========================  =====================  ==========
text: CSV, LVM, …       ``.csv``, ``.txt``; read     all digits                 rate, names, units     —
                        also ``.tsv``, ``.lvm``,
                        ``.asc``
WAV                     ``.wav``                     32-bit floats, unscaled    all                    —
MATLAB, CWRU's keys     ``.mat``                     64 bits                    all                    7.3: ``io``
Universal File 58       ``.uff``, ``.unv``           64 bits                    all but metadata       ``io``
HDF5                    ``.h5``, ``.hdf5``           64 bits                    all                    ``io``
Parquet                 ``.parquet``, ``.pq``        64 bits                    all                    —
NPY, NPZ                ``.npy``, ``.npz``           all                        only read              —
TDMS                    ``.tdms``                    all                        only read              ``io``
Excel                   ``.xlsx``, ``.xlsm``,        16 digits                  only read              ``io``
                        ``.xls``
======================  ===========================  =========================  =====================  ==========
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._base.later import later, listed

if TYPE_CHECKING:
    from .dispatch import read
    from .folder import RecordFolder, read_folder
    from .recording import Recording
else:
    # Signals have columns as records do, and need no formats for it.
    __getattr__ = later(
        __name__,
        {
            "dispatch": ("read",),
            "folder": ("RecordFolder", "read_folder"),
            "recording": ("Recording",),
        },
    )

__all__ = ["RecordFolder", "Recording", "read", "read_folder"]

__dir__ = listed(__name__)
