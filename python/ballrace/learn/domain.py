"""Features that separate simulated records from a measured one, and those outside of the simulated range."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .._base.libraries import pl
from ..errors import SceneError
from .character import NAMES, PATH, character_of
from .envelope_lines import EnvelopeLines
from .pieces import pieces_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from ..channel import Channel, Recorded
    from ..diagnosis.kinematics import AnyBearing
    from .data import Simulated

_ENDS = (0.01, 0.99)
_FOLDS = 4
_BETRAYING = 10


@dataclass(frozen=True, kw_only=True, eq=False)
class DomainReport:
    """How well features separate simulated and measured records.

    Attributes
    ----------
    auc : float
        Area under the ROC curve of a random forest that separates them, on held-out pieces: 0.5 not at all, 1
        always.
    auc_without_path : float
        The same without the shape of the spectrum, which housing and machine determine.
    features : polars.DataFrame
        A row for each feature, the most separating first: ``feature``, ``auc`` (of it alone, in either direction),
        ``simulated`` and ``measured`` (medians), ``lowest`` and ``highest`` (99 of 100 simulated records are
        above and below) and ``outside`` (share of the measured pieces beyond these).
    """

    auc: float
    auc_without_path: float
    features: pl.DataFrame

    @property
    def betraying(self) -> tuple[str, ...]:
        """The ten features that separate simulation and measurement most, the worst first."""
        return tuple(self.features["feature"].head(_BETRAYING))

    @property
    def outside(self) -> tuple[str, ...]:
        """Features of which half of the measured pieces lie outside of the simulated range: widen the recipe."""
        return tuple(self.features.filter(pl.col("outside") > 0.5)["feature"])

    def __str__(self) -> str:
        with pl.Config(
            tbl_rows=_BETRAYING, tbl_hide_dataframe_shape=True, tbl_hide_column_data_types=True
        ):
            table = str(self.features.head(_BETRAYING))
        beyond = ", ".join(self.outside) or "nothing"
        return (
            f"separated with an AUC of {self.auc:.3f}, without the path {self.auc_without_path:.3f}\n{table}\n"
            f"outside of what was simulated: {beyond}"
        )


def domain_report(
    data: Simulated,
    record: Recorded | ArrayLike,
    *,
    bearing: AnyBearing | None = None,
    speed_rpm: float | None = None,
    fs: float | None = None,
    column: str | None = None,
    label: str | None = None,
) -> DomainReport:
    """Compare simulated records with a measured one.

    Parameters
    ----------
    data : Simulated
        Records of a recipe.
    record, speed_rpm, fs, column
        As of :func:`ballrace.diagnose`; eight pieces as long as the simulated records, and more.
    bearing : optional
        Bearing of the record, as of :func:`ballrace.diagnose`; by default that of the recipe.
    label : str, optional
        Class of the record, where it is known: only simulated records of this class are compared.

    Returns
    -------
    DomainReport
        Areas under the ROC curve, and the features that separate.

    Raises
    ------
    SceneError
        An argument is not usable, or the record is too short.
    """
    table = data.windows
    if label is not None and label not in table["label"]:
        raise SceneError("label", repr(label), f"None, or one of {', '.join(data.recipe.classes)}")
    wanted = np.ones(table.height, bool) if label is None else (table["label"] == label).to_numpy()
    simulated = [one for one, is_wanted in zip(data.channels(), wanted, strict=True) if is_wanted]
    measured = pieces_of(record, data.turns, data.fs, speed_rpm=speed_rpm, fs=fs, column=column)
    if len(measured) < 2 * _FOLDS:
        raise SceneError(
            "record", f"{len(measured)} pieces of {data.turns:.3g} turns", f"{2 * _FOLDS} and more"
        )
    names, ours = marks_of(simulated, EnvelopeLines(data.recipe.made))
    _, theirs = marks_of(measured, EnvelopeLines(data.recipe.made if bearing is None else bearing))
    # Pieces that follow each other resemble each other.
    run = np.arange(len(measured)) * 2 * _FOLDS // len(measured)
    return compared(names, ours, theirs, table["bearing_id"].to_numpy()[wanted], run)


def marks_of(
    records: Sequence[Channel], lines: EnvelopeLines
) -> tuple[list[str], NDArray[np.float64]]:
    """Return names and values of the features that are compared, shape (records, features)."""
    found = np.hstack([lines.fit_transform(records), [character_of(each) for each in records]])
    return [*map(str, lines.get_feature_names_out()), *NAMES], found


def compared(
    names: Sequence[str], simulated: NDArray[np.float64], measured: NDArray[np.float64],
    bearings: NDArray[np.int64], runs: NDArray[np.int64],
) -> DomainReport:  # fmt: skip
    """Compare the features of simulated records of some bearings with those of measured pieces of some runs."""
    from sklearn.metrics import roc_auc_score

    X = np.vstack([simulated, measured])
    truth = np.repeat([0, 1], [len(simulated), len(measured)])
    groups = np.concatenate([bearings, runs + bearings.max() + 1])
    without = [not name.startswith(PATH) for name in names]
    alone = np.array([roc_auc_score(truth, column) for column in X.T])
    ends = np.quantile(simulated, _ENDS, axis=0)
    table = pl.DataFrame({
        "feature": list(names), "auc": np.maximum(alone, 1.0 - alone), "simulated": np.median(simulated, axis=0),
        "measured": np.median(measured, axis=0), "lowest": ends[0], "highest": ends[1],
        "outside": np.mean((measured < ends[0]) | (measured > ends[1]), axis=0),
    }).sort("auc", descending=True)  # fmt: skip
    return DomainReport(
        auc=_auc(X, truth, groups),
        auc_without_path=_auc(X[:, without], truth, groups),
        features=table,
    )


def _auc(X: NDArray[np.float64], truth: NDArray[np.int64], groups: NDArray[np.int64]) -> float:
    from sklearn.ensemble import RandomForestClassifier
    from sklearn.metrics import roc_auc_score
    from sklearn.model_selection import StratifiedGroupKFold, cross_val_predict

    forest = RandomForestClassifier(
        200, class_weight="balanced", min_samples_leaf=2, random_state=0
    )
    split = StratifiedGroupKFold(_FOLDS, shuffle=True, random_state=0)
    chance = cross_val_predict(forest, X, truth, groups=groups, cv=split, method="predict_proba")
    return float(roc_auc_score(truth, chance[:, 1]))
