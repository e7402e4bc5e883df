"""A page that solves and draws a bearing anew at every move of a control: ``ballrace explore``.

============  ==========================================================================================
``settings``  what the controls say, as values; the scene that follows from them
``chosen``    the bearing to begin with: by the name on its box, by its size, or from a file
``live``      what is solved at rest: loads, pressures, stiffness, life, fault frequencies
``picture``   the same as a drawing: seen along the axis, cut through it, the largest contacts
``at_rest``   the same in words and numbers
``running``   runs on a thread of their own, with progress, that can be stopped
``sensor``    a run with noise of the sensor, as figures and as sound
``beside``    a measured record beside the run, and its verdict
``saved``     scene, report and notebook as files
``app``       the page itself, of marimo; it computes nothing
``served``    the page on loopback, behind a token, in a process that ends with this one
``serving``   what that process does
``guard``     who is answered, and what a browser may do with an answer
============  ==========================================================================================

Only ``app``, ``served`` and ``serving`` need marimo (extra ``app``).
"""

from __future__ import annotations
