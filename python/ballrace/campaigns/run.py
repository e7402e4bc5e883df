"""The call ``ballrace.campaign``."""

from __future__ import annotations

import contextlib
import json
import os
import warnings
from typing import TYPE_CHECKING, Any, Literal, TypedDict, Unpack, overload

from .._base.numbers import counted
from .._base.text import printable
from .._io.files import as_path
from .._results.features import feature_options
from ..errors import CampaignError, CampaignWarning, SceneError
from ..options import BUDGET, DECIDING, Run, document
from .arguments import (
    Plan,
    check_choices,
    scenes_of,
    shard_of,
    threads_of,
    warn_of_labels,
)
from .cases import Cases
from .estimate import Estimate, estimate
from .executors import Spread, executor_of, tasks_on_a_machine
from .handout import Handout
from .locks import hold, in_turn
from .progress import Counts, Progress, ProgressDisplay
from .result import Campaign
from .shards import set_aside
from .store import Store
from .work import Job, check_process, record_failed, run_here

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    import polars as pl

    from ..scene import Method, Scene


class _Options(TypedDict, total=False):
    """The arguments of :func:`campaign` that do not decide what it returns."""

    duration: float
    fs: float
    start: Literal["equilibrium", "rolling"]
    rtol: float | None
    accuracy: float | None
    method: Method | None
    bandwidth: Literal["auto"] | None
    settle: float | None
    keep: Literal["features", "signals"]
    columns: Sequence[str] | None
    skip: float
    band: tuple[float, float] | None
    contact_loads: bool
    threads: int | None
    executor: Any
    in_flight: int | None
    retries: int
    shard: tuple[int, int]
    resume: Literal["auto", "strict", False]
    on_error: Literal["record", "raise"]
    progress: bool | Callable[[Progress], object]
    time_limit: float | None
    max_steps: int | None


@overload
def campaign(
    cases: object,
    out: str | os.PathLike[str],
    *,
    scene: Scene | Mapping[str, Scene],
    dry_run: Literal[False] = ...,
    **options: Unpack[_Options],
) -> Campaign: ...
@overload
def campaign(
    cases: object,
    out: str | os.PathLike[str],
    *,
    scene: Scene | Mapping[str, Scene],
    dry_run: Literal[True],
    **options: Unpack[_Options],
) -> Estimate: ...
def campaign(
    cases: object,
    out: str | os.PathLike[str],
    *,
    scene: Scene | Mapping[str, Scene],
    duration: float = 0.1,
    fs: float = 50_000.0,
    start: Literal["equilibrium", "rolling"] = "equilibrium",
    rtol: float | None = None,
    accuracy: float | None = None,
    method: Method | None = None,
    bandwidth: Literal["auto"] | None = "auto",
    settle: float | None = None,
    keep: Literal["features", "signals"] = "features",
    columns: Sequence[str] | None = None,
    skip: float = 0.0,
    band: tuple[float, float] | None = None,
    contact_loads: bool = False,
    threads: int | None = None,
    executor: Any = None,
    in_flight: int | None = None,
    retries: int = 1,
    shard: tuple[int, int] = (0, 1),
    resume: Literal["auto", "strict", False] = "auto",
    on_error: Literal["record", "raise"] = "record",
    progress: bool | Callable[[Progress], object] = True,
    dry_run: bool = False,
    time_limit: float | None = None,
    max_steps: int | None = None,
) -> Campaign | Estimate:
    """Run a table of cases into a folder, and return the table of results.

    Finished cases are written as they come. Called again, after a kill, Ctrl-C or with more rows, it runs only
    those that are missing or damaged: the hash of its scene and of the arguments of its run identifies a case.
    The manifest says which rows are reliable: ``status``, ``error`` and ``message`` of cases that failed, and
    ``warnings`` of those that ran but need a check.

    Parameters
    ----------
    cases : table
        One row a case: polars, pandas, Arrow, a list of dicts or a dict of columns. Columns with a dot or an
        index are fields of the scene (``loads.axial.force``, ``rows[0].clearance``), as are its own fields;
        ``duration``, ``fs``, ``start``, ``rtol``, ``accuracy``, ``method``, ``bandwidth`` (``"auto"`` or
        ``"none"``), ``settle``, ``time_limit`` and ``max_steps`` replace the arguments of that name; ``scene`` is
        the name of the scene if there are several. Every other column is a label, which is only copied to the
        results; a label that resembles a field causes a warning. An empty cell changes nothing.
    out : path
        Folder of the campaign, made if it does not exist. With an executor all workers must see it under this
        name.
    scene : Scene, or mapping of str to Scene
        The scene that the rows change, or several scenes by name.
    duration, fs, start, rtol, accuracy, method, bandwidth, settle
        As for :func:`ballrace.simulate`. Features begin at t = 0, when the start has settled. With ``settle=0``,
        or from a rolling start, they include its transient unless `skip` leaves it out.
    keep : {"features", "signals"}
        Whether the signals of every case are kept beside its features.
    columns : sequence of str, optional
        Signals whose features are computed; by default all accelerations that the probes record. For
        ``outer.ay``: ``outer.ay.rms``, ``.peak``, ``.crest_factor``, ``.kurtosis``, and for every row of balls
        the lines of the signal at its fault frequencies ``outer.ay.row0.ftf``, ``.bpfo``, ``.bpfi``, ``.2bsf``
        (a ball's defect meets both races in a turn), the root of the sum of the squares of the first three
        harmonics (``.bpfo_harmonics``), and of the sidebands a shaft's frequency beside BPFI and a cage's beside
        2 BSF (``.bpfi_sidebands``, ``.2bsf_sidebands``; with an ``outer_speed`` also ``.bpfo_sidebands``); and all
        of these of the squared envelope,
        ``outer.ay.row0.bpfo_envelope``, ``.bpfo_envelope_harmonics`` and so on. They are sought within 0.5 % of
        where the balls of the run passed; of a run of less than a turn, within 2 % of nominal rolling. Where the
        given speed changes by more than 2 %, lines are taken over the shaft's angle; of a run from rest from a
        twentieth of its highest speed on, and ``outer.ay.lines_from`` says when [s]. A line that the record is
        too short for is empty, and so are all under a torque drive. Beside every feature stands its standard
        error, ``outer.ay.rms_se``, and ``turns``, ``row0.passes`` and ``batches`` say what these come from (see
        :meth:`ballrace.Signals.features`): records of fewer than 8 turns and 8 passes have none, ``batches`` is 0,
        and where no case has any the manifest leaves their columns out.
    skip : float
        Beginning of each run that features leave out [s].
    band : tuple of two floats, optional
        Band of the envelope [Hz]; by default all frequencies.
    contact_loads : bool
        Whether the extremes of the contact loads are among the features: ``row0.outer.load_max`` and so on [N].
        They need every contact at every sample, which costs time, and do not change the signals.
        ``largest_pressure``, the largest Hertz pressure of any contact at the start or the end of the run [Pa], is
        always among them.
    threads : int, optional
        Cases at once in this process, or in each task of an executor; by default all cores, or one with an
        executor.
    executor : optional
        Where tasks run: a :class:`concurrent.futures.Executor` whose workers were not forked, or anything with
        ``get_executor()``, such as a Dask ``Client``. Tasks share the memory of their machine: all tasks of a pool
        count as on one machine, those of Dask by the addresses of its workers; other executors are checked for one
        task only.
    in_flight : int, optional
        Tasks handed to the executor at most; by default two for each of its workers, or for each core of this
        machine where the executor does not state their number.
    retries : int
        How often a case is tried again, by itself in a new pool, if its worker died, for example of too little
        memory; if it dies again the case is a row with a CampaignError. 0: a worker's death ends the campaign.
        With executors other than Dask and :class:`concurrent.futures.ProcessPoolExecutor` a broken pool always
        ends it. A Dask cluster that has lost all its workers is waited for ``1 + retries`` minutes.
    shard : tuple of int, int
        ``(i, n)`` runs every n-th case from the i-th, i from 0: n such calls, on any machines at any times, run
        the whole campaign.
    resume : {"auto", "strict", False}
        A folder with cases finished by another version of the solver: ``"auto"`` warns and goes on, ``"strict"``
        refuses. False refuses every folder with finished cases.
    on_error : {"record", "raise"}
        Whether a case that fails is a row of the manifest, or raises its error (and runs again when called
        again).
    progress : bool or callable
        True shows a bar in a terminal or notebook, else one line at the end. A callable is given
        :class:`~ballrace.campaigns.Progress` as cases finish; what it raises stops the campaign.
    dry_run : bool
        Run the first missing case, write nothing, and return an :class:`~ballrace.campaigns.Estimate`.
    time_limit, max_steps
        Limits for each case, as for :func:`ballrace.simulate`; a case that exceeds one is a row with a
        BudgetError. They are not part of the hash that identifies a case: called again with a larger limit, or
        none, only the cases that had exceeded the smaller one run again.

    Returns
    -------
    Campaign
        Its ``manifest`` is the table of results.

    Raises
    ------
    SceneError
        An argument or a column is not usable; nothing was written.
    TypeError
        The executor is not usable; nothing was written.
    CampaignError
        The folder is not usable, or a worker failed. What has finished is safe.
    OSError
        The folder cannot be made or read.
    KeyboardInterrupt
        Ctrl-C; the message says what is safe and how to go on.

    Warns
    -----
    SceneWarning
        A number of ``scene`` is one that no bearing is likely to have, or a probe records what cannot move.
    CampaignWarning
        A label resembles a field; there are cases of another version, or that ran on other vector instructions;
        files were damaged, and their cases run again; a worker died, and its cases are tried again; an executor
        has given nothing back for 5 minutes or more.

    Examples
    --------
    >>> import ballrace as br, tempfile
    >>> scene = br.presets.deep_groove_6205()
    >>> table = br.grid({"loads.radial.force": [200.0, 400.0, 800.0]})
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     done = br.campaign(table, folder, scene=scene, duration=1e-3, progress=False)
    >>> done.manifest.select("loads.radial.force", "status").rows()
    [(200.0, 'ok'), (400.0, 'ok'), (800.0, 'ok')]
    """
    check_process()
    check_choices(keep=keep, resume=resume, on_error=on_error)
    folder = as_path(out, "out")
    asked = Run(
        duration=duration, fs=fs, start=start, rtol=rtol, accuracy=accuracy, method=method,
        bandwidth=bandwidth, settle=settle, time_limit=time_limit, max_steps=max_steps,
    )  # fmt: skip
    asked.to_json()  # refuses what no scene can be run by
    run = document({name: getattr(asked, name) for name in DECIDING})
    limits = {name: getattr(asked, name) for name in BUDGET}
    budget = document({name: limit for name, limit in limits.items() if limit is not None})
    if not (isinstance(progress, bool) or callable(progress)):
        raise SceneError("progress", repr(progress), "True, False or a callable")
    features = feature_options(columns, skip, band, contact_loads)
    scenes = scenes_of(scene, features)
    schema_version = json.loads(next(iter(scenes.values())))["schema"]
    engine, workers = (None, None) if executor is None else executor_of(executor)
    most = None if in_flight is None else counted("in_flight", in_flight, 1)
    plan = Plan(
        cases=Cases(cases, scenes, run, budget=budget, features=json.dumps(features)),
        identity={"schema": schema_version, "scenes": scenes, "run": run, "features": features},
        job=Job(
            threads=threads_of(threads, executor),
            sharing=1 if executor is None else tasks_on_a_machine(executor),
            keep_signals=keep == "signals",
            features=json.dumps(features),
            raise_errors=on_error == "raise",
            retries=counted("retries", retries, 0),
        ),
        executor=engine,
        workers=workers,
        shard=shard_of(shard),
        resume=resume,
    )
    warn_of_labels(plan.cases, scenes)
    if dry_run:
        return estimate(plan, folder)
    failed = [case.error for case in plan.cases.cases if case.error is not None]
    if failed and on_error == "raise":
        raise failed[0]
    return _run(plan, folder, most, progress)


def _run(
    plan: Plan, out: Path, in_flight: int | None, progress: bool | Callable[[Progress], object]
) -> Campaign:
    store = Store.prepare(out, plan.identity)
    with hold(store.root / "locks", *plan.shard):
        missing, damaged = plan.missing(store)
        _write_table(plan, store)
        _set_aside(store, damaged)
        total = len(plan.ids())
        display = ProgressDisplay(progress, total, total - len(missing), labels=plan.cases.labels)
        try:
            if missing:
                _guarded(plan, store, missing, in_flight, display)
        finally:
            display.end()
        result = Campaign(store)
        _warn_of_levels(store, result)
        if not (result.manifest["status"] == "missing").any():
            store.write_table("manifest.parquet", result.manifest)
    return result


def _guarded(
    plan: Plan, store: Store, missing: list[int], in_flight: int | None, display: ProgressDisplay
) -> None:
    """Run what is missing; whatever stops it says what is safe and how to go on."""

    def safe() -> str:
        try:
            count = len(plan.ids().keys() & set(store.results([])["case_id"]))
        except CampaignError:
            return f"finished cases are safe in {store.root}; call again to go on"
        return f"{count} of {display.now.total} cases are safe in {store.root}; call again to go on"

    try:
        _work(plan, store, missing, in_flight, display)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted; {safe()}") from None
    except CampaignError as error:
        raise CampaignError(f"{error}; {safe()}") from error


def _work(
    plan: Plan, store: Store, missing: list[int], in_flight: int | None, display: ProgressDisplay
) -> None:
    cases = [(i, plan.cases.cases[i]) for i in missing]
    todo = [i for i, case in cases if case.error is None]
    failed = [(case.id, case.error) for _, case in cases if case.error is not None]
    refused = Counts(len(failed), len(failed))
    if failed:
        record_failed(store, failed)
        display.update(refused)

    def on_progress(counts: Counts) -> None:
        display.update(counts.plus(refused))

    documents = plan.documents(todo)
    if plan.executor is None:
        run_here(store, documents, plan.job, on_progress)
    else:
        most = in_flight or 2 * (plan.workers or os.cpu_count() or 1)
        handout = Handout(documents, len(todo), plan.job.retries)
        Spread(
            store,
            handout,
            plan.job,
            executor=plan.executor,
            in_flight=most,
            on_progress=on_progress,
        ).run()


def _warn_of_levels(store: Store, result: Campaign) -> None:
    """Warn where cases ran on different vector instructions, as after a move to another machine."""
    levels = sorted(result.manifest["simd"].drop_nulls().unique())
    if len(levels) > 1:
        text = (
            f"{store.root}: cases ran on the vector instructions {' and '.join(levels)}, which differ in the last "
            "bits: compare features, not samples (the column simd says which)"
        )
        warnings.warn(printable(text), CampaignWarning, stacklevel=4)


def _set_aside(store: Store, damaged: list[Path]) -> None:
    """Take damaged files out of the way, and say so."""
    if not damaged:
        return
    set_aside(damaged)
    names = ", ".join(path.name for path in damaged[:3]) + (", …" if len(damaged) > 3 else "")
    text = f"{store.root}: damaged files are set aside, and their cases run again: {names}"
    warnings.warn(printable(text), CampaignWarning, stacklevel=4)


def _write_table(plan: Plan, store: Store) -> None:
    """Write the table of cases, once for all shards.

    A whole campaign may replace the table that is there; a shard only by one that has all its cases and more,
    since others may be at work on them.
    """
    frame = plan.cases.frame()
    with contextlib.ExitStack() as turn:
        if plan.shard[1] > 1:
            turn.enter_context(in_turn(store.root / "locks", "table"))
        there = _table_there(store)
        if there is not None and there.equals(frame):
            return
        if there is not None and plan.shard[1] > 1:
            lost = set(there["case_id"]) - set(frame["case_id"])
            if lost:
                raise CampaignError(
                    f"{store.root}: its table has {len(lost)} cases that this table lacks; give all shards the "
                    "same table, or one that includes these cases"
                )
        store.write_table("cases.parquet", frame)


def _table_there(store: Store) -> pl.DataFrame | None:
    """Return the table of cases that is there, if there is one that can be read; this call has its own."""
    try:
        return store.table("cases.parquet")
    except (FileNotFoundError, ValueError):
        return None
