"""The page: controls, and cells of marimo that show what the other modules compute."""

import marimo

app = marimo.App(
    width="full",
    app_title="ballrace explore",
    css_file="explore.css",
    html_head_file="head.html",
)


@app.cell
def parts():
    """Import what the page shows."""
    from html import escape
    from pathlib import Path

    import marimo as mo

    import ballrace as br
    from ballrace._base.text import printable
    from ballrace.errors import BallraceError
    from ballrace.explore import at_rest, beside, chosen, live, picture, saved, sensor
    from ballrace.explore.controls import controls, named, taken
    from ballrace.explore.running import Forecast, Runner
    from ballrace.explore.settings import DAMAGE, SURFACES, Settings
    from ballrace.plot.style import CONFIG as ALONE

    # marimo has figures follow the width of the page; where plotly does, too, they lose their height.
    CONFIG = {**ALONE, "responsive": False}

    # Whatever text a file or a user brings is shown by these two: as words, never as Markdown or HTML.
    def said(text):
        """Return a text as the page shows it."""
        return mo.Html(f"<p>{escape(printable(text))}</p>")

    def refused(error):
        """Return an error as the page shows it."""
        return mo.Html(f'<p class="refused" role="alert">{escape(printable(str(error)))}</p>')

    given = mo.cli_args().get("file")
    file = Path(given) if given else None
    opened = None if file is None else chosen.read_file(file)
    return (
        BallraceError, CONFIG, DAMAGE, Forecast, Runner, SURFACES, Settings, at_rest, beside, br, chosen, controls,
        escape, file, live, mo, named, opened, picture, refused, said, saved, sensor, taken,
    )  # fmt: skip


@app.cell
def moving(mo):
    """Count moves of controls; each writes its value where it belongs.

    Cells that show the controls do not run again at a move, as those that name a dictionary of marimo do, which
    besides keeps but the last of several moves that come together.
    """
    get_moves, set_moves = mo.state(0)
    get_sizes, set_sizes = mo.state(0)

    def writing(values, name, count):
        def moved(value):
            values[name] = value
            count(lambda moves: moves + 1)

        return moved

    return get_moves, get_sizes, set_moves, set_sizes, writing


@app.cell
def bearing(mo, named, opened, set_sizes, writing):
    """Choose or describe the bearing."""
    ways = {"by the name on its box": "name", "by its size": "size"}
    if opened is not None:
        ways = {"from the file": "file", **ways}
    how = named(mo.ui.dropdown(ways, value=next(iter(ways)), label="bearing"))
    name = named(
        mo.ui.text(value="6205", label="name", placeholder="6205-2RSH/C3", full_width=True)
    )
    kinds = {
        "deep groove": "deep_groove", "angular contact": "angular_contact", "double row": "double_row",
    }  # fmt: skip
    size = {
        "bore_mm": 25.0, "outside_mm": 52.0, "width_mm": 15.0, "kind": "deep_groove", "contact_angle_deg": 40.0,
        "ball_count": 0, "ball_diameter_mm": 0.0,
    }  # fmt: skip

    def number(field, stop, label, step=0.1):
        least = 0.0 if "ball" in field or "angle" in field else 0.5
        return named(mo.ui.number(
            least, stop, step, size[field], label=label, on_change=writing(size, field, set_sizes)
        ))  # fmt: skip

    housing = named(mo.ui.dropdown(["pedestal", "bare ring"], value="pedestal", label="housing"))
    name_elements = [name, housing]
    size_elements = [
        number("bore_mm", 500.0, "bore d / mm"),
        number("outside_mm", 1000.0, "outside diameter D / mm"),
        number("width_mm", 300.0, "width B / mm"),
        named(
            mo.ui.dropdown(
                kinds, value="deep groove", label="kind", on_change=writing(size, "kind", set_sizes)
            )
        ),
        number("contact_angle_deg", 60.0, "contact angle / °, of angular contact", 1.0),
        number("ball_count", 60, "balls counted (0: estimate)", 1),
        number("ball_diameter_mm", 100.0, "ball diameter / mm (0: estimate)", 0.001),
        housing,
    ]
    return housing, how, name, name_elements, size, size_elements


@app.cell
def base(
    BallraceError, Settings, chosen, controls, get_sizes, housing, how, name, opened, refused, size,
):  # fmt: skip
    """Make the scene that the controls begin with."""

    def begin():
        if how.value == "file":
            return opened, None
        if how.value == "name":
            return chosen.named(name.value, housing.value), None
        given = {**size, "housing": housing.value}
        for optional in ("ball_count", "ball_diameter_mm"):
            given[optional] = given[optional] or None
        if given["kind"] == "deep_groove":
            given["contact_angle_deg"] = None
        return chosen.described(**given)

    _ = get_sizes()
    try:
        scene_begun, made = begin()
        begun, what, knobs = Settings.of(scene_begun), chosen.summary(scene_begun, made), ()
        knobs = controls(begun)
        trouble = None
    except BallraceError as error:
        begun, what, knobs = None, "", ()
        trouble = refused(error)
    return begun, knobs, trouble, what


@app.cell
def turned_knobs(DAMAGE, SURFACES, begun, br, knobs, mo, named, set_moves, writing):
    """Make the controls anew for another bearing."""
    shown = {each.field: each.value for each in knobs}
    picked = {} if begun is None else {"oil": begun.oil, "damage": "none", "on": "outer_race"}
    knob_elements = {
        each.field: named(mo.ui.slider(
            each.start, each.stop, each.step, each.value, label=each.label, include_input=True, full_width=True,
            on_change=writing(shown, each.field, set_moves),
        ))
        for each in knobs
    }  # fmt: skip

    def pick(name, options, label):
        began = next(each for each, value in options.items() if value == picked[name])
        knob_elements[name] = named(
            mo.ui.dropdown(
                options, value=began, label=label, on_change=writing(picked, name, set_moves)
            )
        )

    if begun is not None:
        dry = begun.oil is not None or begun.base.lubricant is None
        oils = {oil.name: oil.name for oil in br.lubricants()}
        pick("oil", {"dry" if dry else "as in the file": None, **oils}, "oil")
        pick("damage", {kind: kind for kind in DAMAGE}, "damage")
        pick("on", {where.replace("_", " "): where for where in SURFACES}, "damage on")
    return knob_elements, picked, shown


@app.cell
def running(Forecast, Runner, mo, named):
    """Make what starts and stops a run."""
    runner, forecast = Runner(), Forecast()
    get_out, set_out = mo.state(None)
    duration = named(
        mo.ui.slider(0.1, 2.0, 0.1, 0.4, label="simulated time / s", include_input=True)
    )
    idle = mo.ui.switch(label="run when idle")
    start = mo.ui.run_button(label="Run", kind="success")
    stop = mo.ui.run_button(label="Stop")
    tick = mo.ui.refresh(default_interval="500ms")
    return duration, forecast, get_out, idle, runner, set_out, start, stop, tick


@app.cell
def panel(how, knob_elements, mo, name_elements, said, size_elements, trouble, what):
    """Show all controls."""

    def of(*names):
        return [knob_elements[each] for each in names if each in knob_elements]

    by = {"name": name_elements, "size": size_elements, "file": []}
    mo.vstack([
        mo.md("# ballrace explore"), how, *by[how.value], said(what) if trouble is None else trouble,
        *of("radial_load", "axial_load", "moment", "speed_rpm", "outer_rpm", "clearance", "oil", "temperature_c"),
        mo.hstack(of("damage", "on"), justify="start", wrap=True),
        *of("width_mm", "angle_deg", "housing_mass", "noise"),
    ])  # fmt: skip


@app.cell
def acting(duration, idle, mo, start, stop, tick):
    """Show it, under the drawings."""
    mo.hstack(
        [start, stop, idle, duration, mo.Html(f"<div hidden>{tick.text}</div>")],
        justify="start", align="center", wrap=True, gap=1.0,
    )  # fmt: skip


@app.cell
def holding(mo):
    """Hold what cells read that need not run again at every move."""
    latest = {"scene": None}
    get_noise, set_noise = mo.state(0.0)
    return get_noise, latest, set_noise


@app.cell
def solving(
    BallraceError, begun, forecast, get_moves, get_noise, knobs, latest, live, picked, refused, set_noise, shown,
    taken,
):  # fmt: skip
    """Solve what the controls say."""
    _ = get_moves()
    scene, solution, unsolved = None, None, None
    if begun is not None:
        settings = taken(begun, knobs, shown).moved(**picked)
        try:
            scene = settings.scene()
            solution = live.solved(scene)
            forecast.ask(scene)
        except BallraceError as error:
            unsolved = refused(error)
        if settings.noise != get_noise():
            set_noise(settings.noise)
    latest["scene"] = scene
    return scene, solution, unsolved


@app.cell
def drawn(mo, picture, solution, unsolved):
    """Draw it."""
    mo.Html(picture.pictures(solution)) if solution is not None else unsolved


@app.cell
def answer(at_rest, mo, solution):
    """Show it in numbers."""
    mo.Html(at_rest.page(solution)) if solution is not None else None


@app.cell
def started(duration, idle, runner, scene, start):
    """Start a run by the button, or half a second after the last move."""
    if scene is not None and (start.value or idle.value):
        newest = runner.newest
        if start.value or newest is None or newest.scene != scene:
            runner.start(scene, duration=duration.value, delay=0.0 if start.value else 0.5)


@app.cell
def stopped(runner, stop):
    """Stop it by the button."""
    if stop.value:
        runner.stop()


@app.cell
def progress(duration, escape, forecast, get_out, latest, mo, refused, runner, said, set_out, tick):
    """Look after the run twice a second: a tick makes this cell run again."""
    _ = tick.value
    run = runner.newest
    seconds = forecast.seconds(latest["scene"])
    takes = (
        ""
        if seconds is None
        else f" A run of {duration.value:g} s takes some {max(seconds * duration.value, 0.1):.1g} s."
    )
    if run is None:
        state = said(f"No run yet.{takes}")
    elif run.state == "failed":
        state = refused(run.why)
    else:
        if run.state == "done" and get_out() is not run.out:
            set_out(run.out)
        fits = (
            ""
            if run.scene == latest["scene"]
            else f" These are other settings than those shown.{takes}"
        )
        text = f"{run.state}, {run.share:.0%}.{fits}"
        state = mo.Html(
            f'<p class="progress" role="status"><progress value="{run.share:.3f}" max="1"></progress> '
            f"{escape(text)}</p>"
        )
    state


@app.cell
def sensing(get_noise, get_out, sensor):
    """Take the run through the sensor."""
    out = get_out()
    simulated = None if out is None else sensor.sensed(out, get_noise())
    rates = None if out is None else sensor.rates_of(out)
    return out, rates, simulated


@app.cell
def results(BallraceError, CONFIG, mo, out, rates, refused, sensor, simulated):
    """Show the run as a sensor has it."""

    def shown_run():
        yield mo.md("## The run")
        yield mo.ui.plotly(sensor.waveform(simulated, rates), config=CONFIG)
        yield mo.ui.plotly(sensor.envelope(simulated, rates), config=CONFIG)
        yield mo.md("As sound; its loudness says nothing:")
        yield mo.audio(sensor.sound(simulated))
        try:
            yield mo.ui.plotly(sensor.orders(simulated, out), config=CONFIG)
        except BallraceError as error:
            yield refused(error)

    mo.vstack(list(shown_run())) if out is not None else None


@app.cell
def dropping(beside, file, mo, named, opened):
    """Take a measured file."""
    dropped_file = mo.ui.file(
        kind="area",
        label="Drop a measured file here: text, MATLAB, WAV or any other format that br.read takes",
    )
    record_fs = mo.ui.number(
        0, 1e7, step=1, value=0, label="its sampling rate / Hz (0: that of the file)", debounce=True
    )
    record_rpm = mo.ui.number(
        0, 1e5, step=0.1, value=0, label="its speed / 1/min (0: that of the file, or as above)", debounce=True
    )  # fmt: skip
    record_unit = mo.ui.dropdown(["m/s^2", "g"], label="its unit, where the file does not have it")
    record_said = mo.ui.dictionary(
        {
            "skip": mo.ui.number(
                0, 1_000_000, step=1, value=0, label="lines to skip", debounce=True
            ),
            "columns": mo.ui.text_area(
                rows=1, label="columns that are signals: names, or places from 0"
            ),
            "decimal": mo.ui.dropdown([".", ","], label="decimal mark"),
            "time": mo.ui.text_area(
                rows=1, label="column of the times, or of a clock; none: no column"
            ),
            "time_unit": mo.ui.dropdown(list(beside.TIME_UNITS), label="unit of the times"),
        }
    )
    for field in (record_fs, record_rpm, record_unit, *record_said.elements.values()):
        named(field)
    begun_with = None if opened is not None or file is None else (file.name, file.read_bytes())
    mo.vstack(
        [
            mo.md("## A measured record"), dropped_file, record_fs, record_rpm, record_unit,
            mo.md("What the file does not say:"), *record_said.elements.values(),
        ]
    )  # fmt: skip
    return begun_with, dropped_file, record_fs, record_rpm, record_said, record_unit


@app.cell
def received(BallraceError, beside, begun_with, dropped_file, mo, record_fs, record_said, refused):
    """Read it."""
    holding = next(((one.name, one.contents) for one in dropped_file.value), begun_with)
    dropped, column, unread = None, None, None
    if holding is not None:
        try:
            dropped = beside.received(
                *holding, record_fs.value or None, **beside.said_by(record_said.value)
            )
            column = mo.ui.dropdown(
                list(dropped.record), value=dropped.record.channel().name, label="column"
            )
        except (BallraceError, ImportError, OSError) as error:
            unread = refused(error)
    column if unread is None else unread
    return column, dropped


@app.cell
def verdict(
    BallraceError, CONFIG, begun, beside, column, dropped, mo, out, rates, record_rpm, record_unit, refused,
    said, simulated,
):  # fmt: skip
    """Say what the record is of, and lay its envelope over that of the run."""

    def judged():
        scene = begun.base if out is None else out.scene
        try:
            measured, found = beside.judged(
                dropped, column.value, scene, speed_rpm=record_rpm.value or None, unit=record_unit.value
            )  # fmt: skip
            fig = beside.overlaid(simulated, measured, rates, found)
        except BallraceError as error:
            return [refused(error)]
        shorter = beside.left_out(dropped, measured)
        return [
            mo.Html(f'<div class="facts verdict">{found._repr_html_()}</div>'),
            *([said(shorter)] if shorter else []),
            mo.ui.plotly(fig, config=CONFIG),
        ]

    mo.vstack(judged()) if dropped is not None and begun is not None else None


@app.cell
def saving(duration, get_noise, get_out, latest, mo, saved):
    """Save scene, report and notebook, which are written when they are asked for."""
    finished, lasting, noisy = get_out(), duration.value, get_noise()
    files = [
        mo.download(lambda: saved.scene_file(latest["scene"]), filename="scene.toml", label="Scene"),
        mo.download(
            lambda: saved.notebook(latest["scene"], lasting, noisy), filename="bearing.ipynb", label="Notebook"
        ),
    ]  # fmt: skip
    if finished is not None:
        report = mo.download(
            lambda: saved.report(finished), filename="report.html", label="Report of the run"
        )
        files.append(report)
    mo.vstack([mo.md("## Save"), mo.hstack(files, justify="start", wrap=True)])


if __name__ == "__main__":
    app.run()
