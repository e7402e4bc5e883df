"""Features of a bearing's faults as a transformer of scikit-learn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import needed
from .._base.numbers import real
from ..channel import Channel, Recorded
from ..diagnosis.kinematics import kinematics_of
from ..errors import SceneError
from .features import features_of, names_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from ..diagnosis.kinematics import AnyBearing

_base = needed("sklearn.base", "ballrace.learn", extra="learn")
_checks = needed("sklearn.utils.validation", "ballrace.learn", extra="learn")


class EnvelopeLines(_base.TransformerMixin, _base.BaseEstimator):  # type: ignore[misc, name-defined]
    """Heights and depths of the envelope lines of each fault and, on request, the envelope's orders.

    A transformer of scikit-learn's conventions. All features are ratios or levels in decibels, at orders of the
    shaft: they change neither with the unit nor, as far as an envelope can be free of it, with the housing and the
    sensor, and are the same quantities of simulated and measured records. Kurtosis and crest factor are not among
    them: simulated impacts have half of the measured ones' (the guide, Transfer).

    ====================  =====================================================================================
    ``<part>.height``     mean level of a fault's lines over the running median beside them, the largest over
                          bands and a common factor of 0.985 to 1.015 [dB]
    ``<part>.depth``      largest depth of modulation of a band at the rate of those lines
    ``order <o>``         highest level within a step of the envelope's orders, a mean over bands [dB]
    ====================  =====================================================================================

    Parts are ``outer_race``, ``inner_race``, ``ball`` and ``cage``; :mod:`ballrace.diagnosis` describes the first
    two rows. A record that is too short for a feature, or silent, has 0 there; lines of a fault need at least ten
    turns of the shaft.

    Parameters
    ----------
    bearing : str, Bearing, Scene, Row, Orders, FaultFrequencies or mapping, optional
        As of :func:`ballrace.diagnose`. None: that of the records, in :meth:`ballrace.learn.Simulated.features`
        and :class:`ballrace.learn.Diagnoser`.
    fs : float, optional
        Sampling rate of arrays [Hz]; records have their own.
    speed_rpm : float, optional
        Speed of the inner ring for arrays, and for records without one [1/min]; where the bearing is given as
        orders or rates of a hub, the relative speed of its rings.
    highest : float, optional
        Highest order of the envelope's spectrum that is a feature; by default its orders are no features.
    step : float
        Step of these orders.
    row : int
        Row of balls of a scene, from 0.

    Attributes
    ----------
    orders_ : ndarray
        Middles of the steps of orders; empty without ``highest``.

    Examples
    --------
    >>> import ballrace as br, numpy as np
    >>> noise = np.random.default_rng(1).normal(size=(3, 12_000))
    >>> lines = EnvelopeLines("6205", fs=12_000.0, speed_rpm=1797.0)
    >>> lines.fit_transform(noise).shape, lines.get_feature_names_out()[0]
    ((3, 8), 'outer_race.height')
    """

    def __init__(
        self,
        bearing: AnyBearing | None = None,
        *,
        fs: float | None = None,
        speed_rpm: float | None = None,
        highest: float | None = None,
        step: float = 0.1,
        row: int = 0,
    ) -> None:
        self.bearing = bearing
        self.fs = fs
        self.speed_rpm = speed_rpm
        self.highest = highest
        self.step = step
        self.row = row

    def fit(self, X: ArrayLike | Sequence[Recorded], y: object = None) -> EnvelopeLines:
        """Check the parameters and what is given; nothing is learnt.

        Parameters
        ----------
        X : array_like, shape (n, length), or sequence of Signals, Measurement, Recording or Channel
            Windows, all at ``fs`` and ``speed_rpm``, or records.
        y : ignored
            For scikit-learn.

        Raises
        ------
        SceneError
            A parameter is not usable, or missing for what is given.
        """
        self.orders_ = self._orders()
        if self.bearing is None:
            raise SceneError("bearing", "None", "what names the bearing, such as '6205'")
        self.kinematics_ = kinematics_of(self.bearing, self.row)
        self._channels(X, reset=True)
        return self

    def transform(self, X: ArrayLike | Sequence[Recorded]) -> NDArray[np.float64]:
        """Return the features of each window or record, shape (n, features).

        Raises
        ------
        SceneError
            A sampling rate or a speed is missing.
        """
        _checks.check_is_fitted(self)
        rows = [self._features(channel) for channel in self._channels(X, reset=False)]
        return np.array(rows)

    def get_feature_names_out(self, input_features: object = None) -> NDArray[np.object_]:
        """Return the names of the features."""
        _checks.check_is_fitted(self)
        return np.array(names_of(self.orders_), dtype=object)

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        # Arrays have no sampling rate: without one only records are taken.
        tags.input_tags.two_d_array = self.fs is not None and self.speed_rpm is not None
        return tags

    def of(self, bearing: AnyBearing) -> EnvelopeLines:
        """Return the same features of a bearing, where none is named yet."""
        made = _base.clone(self)
        return made if self.bearing is not None else made.set_params(bearing=bearing)  # type: ignore[no-any-return]

    def _orders(self) -> NDArray[np.float64]:
        """Return the middles of the steps of orders; the first is two steps off 0, where the mean was removed."""
        if self.highest is None:
            return np.zeros(0)
        for name, most in (("highest", 1000.0), ("step", 0.25 * real(self.highest))):
            if not 0.01 <= real(getattr(self, name)) <= most:
                raise SceneError(name, repr(getattr(self, name)), f"an order, 0.01 to {most:g}")
        return np.arange(2.0 * self.step, self.highest + 0.5 * self.step, self.step)

    def _channels(self, X: Any, *, reset: bool) -> list[Channel]:
        if isinstance(X, Recorded):
            raise SceneError("X", type(X).__name__, "a list of records")
        if isinstance(X, list | tuple) and X and all(isinstance(x, Recorded) for x in X):
            return [x.channel() for x in X]
        for name in ("fs", "speed_rpm"):
            if not 0.0 < real(getattr(self, name)) < np.inf:
                allowed = "above 0 for arrays; records know theirs"
                raise SceneError(name, repr(getattr(self, name)), allowed)
        x = _checks.validate_data(self, X, reset=reset, dtype=np.float64)
        return [Channel(x=row, fs=float(self.fs or 0.0)) for row in x]

    def _features(self, channel: Channel) -> NDArray[np.float64]:
        shaft = channel.shaft if channel.shaft else real(self.speed_rpm) / 60.0
        if not abs(shaft) > 0.0:
            allowed = "the speed [1/min], which a record does not know"
            raise SceneError("speed_rpm", repr(self.speed_rpm), allowed)
        x = np.asarray(channel.x, dtype=np.float64)
        return features_of(x, channel.fs, abs(shaft), self.kinematics_.orders, self.orders_)
