"""Any move, text or file that comes to the page of `ballrace explore` is shown or refused, and is never markup."""

from __future__ import annotations

import asyncio
import json
import xml.etree.ElementTree as ET
from typing import Any

import hypothesis.strategies as st
import numpy as np
from hypothesis.strategies import DrawFn

import ballrace as br
from ballrace.explore import at_rest, beside, chosen, saved
from ballrace.explore.controls import controls, taken
from ballrace.explore.guard import Guard
from ballrace.explore.live import solved
from ballrace.explore.picture import pictures
from ballrace.explore.settings import DAMAGE, SURFACES, Settings
from budget import decided, fuzzed
from records import ENDS
from test_fuzz_records import damaged

TAGS = {
    "div", "figure", "figcaption", "svg", "g", "polygon", "line", "circle", "ellipse", "rect", "text", "title",
    "table", "tr", "th", "td", "ul", "li", "p", "strong",
}  # fmt: skip
"""Elements that the page itself writes."""

KINDS = ("deep_groove", "angular_contact", "double_row")

LOADING = ("src", "href", "srcdoc", "action", "data", "formaction")

DESIGNATIONS = (
    "6205",
    "6309/C3",
    "7208B",
    "3206",
    "618/5",
    "NU205",
    "6205-2RSH/C3",
    "wheel-bearing",
    "1205",
)

NUMBERS = st.one_of(
    st.floats(-1e4, 1e4), st.floats(), st.integers(-(10**20), 10**20), st.sampled_from((0.0, 1e-300, 1e300))
)  # fmt: skip

TEXTS = st.one_of(
    st.text(max_size=30),
    st.sampled_from(("<script>", "<img src=x onerror=a>", "&lt;", "]]>", "\0", "\x1b[31m", "\u202e", "\ud800")),
    st.builds("".join, st.lists(st.sampled_from((*DESIGNATIONS, " ", "/", "-", "<b>", "C3", "\n")), max_size=5)),
)  # fmt: skip


def shown(html: str) -> None:
    """Check that a piece of the page is well formed, and has nothing that it does not write itself."""
    for element in ET.fromstring(f"<div>{html}</div>").iter():
        name = element.tag.rpartition("}")[2]
        assert name in TAGS, name
        for attribute in element.attrib:
            assert not attribute.startswith("on"), attribute
            assert attribute.rpartition("}")[2] not in LOADING, attribute


BEGUN = tuple(
    Settings.of(br.bearing(name, speed_rpm=1800.0)) for name in ("6205", "7208B", "3206", "6309")
)
FIELDS = [
    name for name in Settings.__dataclass_fields__ if name not in ("base", "oil", "damage", "on")
]


@st.composite
def moves(draw: DrawFn) -> dict[str, Any]:
    """Draw what controls say, mostly within their ranges; a request may say anything."""
    begun = draw(st.sampled_from(BEGUN))
    made = controls(begun)
    numbers = {}
    for one in draw(st.lists(st.sampled_from(made), max_size=6)):
        within = st.floats(one.start, one.stop)
        numbers[one.field] = draw(NUMBERS if draw(st.integers(0, 19)) == 0 else within)
    wild = (
        draw(st.lists(st.sampled_from(FIELDS), max_size=1)) if draw(st.integers(0, 4)) == 0 else ()
    )
    beyond = {name: draw(NUMBERS) for name in wild}
    picked = {
        "oil": draw(st.sampled_from((None, None, "vg68", "vg32", "<b>", "grease"))),
        "damage": draw(st.sampled_from((*DAMAGE, *DAMAGE, *DAMAGE, "<b>"))),
        "on": draw(st.sampled_from((*SURFACES, *SURFACES, *SURFACES, ""))),
    }
    return {"begun": begun, "numbers": numbers, "beyond": beyond, "picked": picked}


@fuzzed(moved=moves(), name=TEXTS)
def test_any_move_is_shown_or_refused(moved: dict[str, Any], name: str) -> str:
    def answer() -> tuple[br.Scene, str]:
        begun = moved["begun"]
        settings = taken(begun, controls(begun), moved["numbers"])
        scene = settings.moved(**moved["picked"], **moved["beyond"]).scene()
        live = solved(scene.replace({"name": name}))
        return live.scene, pictures(live) + at_rest.page(live)

    found = decided(answer)
    if isinstance(found, br.BallraceError):
        return type(found).__name__
    scene, html = found
    shown(html)
    assert br.Scene.from_toml(saved.scene_file(scene).decode()) == scene
    first, *_ = json.loads(saved.notebook(scene, 0.1, 0.0))["cells"]
    assert "<" not in first["source"], "markup in the notebook"
    return "shown"


@fuzzed(text=TEXTS, housing=st.sampled_from(("pedestal", "bare ring")))
def test_any_designation_is_a_bearing_or_refused(text: str, housing: Any) -> str:
    found = decided(lambda: chosen.summary(chosen.named(text, housing)))
    return type(found).__name__


@st.composite
def sizes(draw: DrawFn) -> list[Any]:
    """Draw bore, outside diameter, width and contact angle, mostly in their proportions."""
    bore = draw(st.floats(2.0, 300.0))
    usual = [bore, bore * draw(st.floats(1.2, 3.0)), bore * draw(st.floats(0.2, 0.9)), 30.0]
    return [draw(NUMBERS) if draw(st.integers(0, 9)) == 0 else one for one in usual]


@fuzzed(
    sizes=sizes(),
    balls=st.tuples(st.one_of(st.just(0), NUMBERS), st.one_of(st.just(0.0), NUMBERS)),
    kind=st.sampled_from(KINDS),
)
def test_any_size_is_a_bearing_or_refused(
    sizes: list[Any], balls: tuple[Any, Any], kind: Any
) -> str:
    bore, outside, width, angle = sizes
    count, diameter = balls

    def answer() -> str:
        made = chosen.described(
            bore, outside, width, kind=kind, contact_angle_deg=None if kind == "deep_groove" else angle,
            ball_count=count or None, ball_diameter_mm=diameter or None,
        )  # fmt: skip
        return chosen.summary(*made)

    return type(decided(answer)).__name__


@st.composite
def drops(draw: DrawFn) -> tuple[str, bytes]:
    """Draw a file that is dropped, by its name and what is in it."""
    end = draw(st.sampled_from(ENDS))
    name = draw(TEXTS).replace("/", "").replace("\0", "").encode("utf-8", "ignore").decode()
    return f"{name[:40]}.{draw(st.sampled_from((end, end, end, 'txt', '')))}", draw(damaged(end))


@fuzzed(
    dropped=drops(),
    fs=st.one_of(st.none(), st.sampled_from((1000.0, 20e3)), NUMBERS),
    rpm=st.one_of(st.none(), st.just(1800.0), NUMBERS),
    unit=st.sampled_from(("m/s^2", "g")),
)
def test_any_dropped_file_is_judged_or_refused(
    dropped: tuple[str, bytes], fs: Any, rpm: Any, unit: str
) -> str:
    name, contents = dropped
    read = decided(lambda: beside.received(name, contents, fs))
    if isinstance(read, br.SceneError) and read.path == "fs":
        read = decided(lambda: beside.received(name, contents, 1000.0))
    if isinstance(read, br.BallraceError):
        assert "/tmp" not in str(read)
        return f"not read: {type(read).__name__}"
    column = read.record.channel().name
    scene = BEGUN[0].base
    found = decided(lambda: beside.judged(read, column, scene, speed_rpm=rpm, unit=unit))
    if isinstance(found, br.BallraceError):
        return f"not judged: {type(found).__name__}"
    measured, verdict = found
    shown(verdict._repr_html_())
    drawn = decided(lambda: beside.overlaid(None, measured, None, verdict))
    if isinstance(drawn, br.BallraceError):
        return f"not drawn: {type(drawn).__name__}"
    assert np.all(np.isfinite(np.asarray(drawn.data[0].y, dtype=float)))
    return verdict.verdict


HEADERS = st.lists(
    st.tuples(
        st.sampled_from((b"host", b"Host", b"origin", b"cookie", b"x-forwarded-host")),
        st.one_of(
            st.sampled_from((b"127.0.0.1:2718", b"localhost", b"evil.example", b"http://127.0.0.1:2718", b"null")),
            st.binary(max_size=20),
        ),
    ),
    max_size=4,
)  # fmt: skip
ANSWERS = st.lists(
    st.tuples(
        st.sampled_from((b"content-type", b"Content-Security-Policy", b"set-cookie", b"X-Frame-Options")),
        st.sampled_from((b"text/html", b"text/html; charset=utf-8", b"application/json", b"a=b; max-age=1", b"*")),
    ),
    max_size=4,
)  # fmt: skip


@fuzzed(
    asked=HEADERS,
    answered=ANSWERS,
    body=st.one_of(
        st.binary(max_size=60),
        st.lists(st.sampled_from((b"<script>", b"</script>", b"<script", b"<!--", b"-->", b"a", b"\xff", b">")))
        .map(b"".join),
    ),
)  # fmt: skip
def test_any_request_is_guarded(
    asked: list[tuple[bytes, bytes]], answered: list[tuple[bytes, bytes]], body: bytes
) -> str:
    reached: list[bool] = []
    sent: list[Any] = []

    async def application(scope: Any, receive: Any, send: Any) -> None:
        del scope, receive
        reached.append(True)
        await send({"type": "http.response.start", "status": 200, "headers": answered})
        await send({"type": "http.response.body", "body": body[:5], "more_body": True})
        await send({"type": "http.response.body", "body": body[5:]})

    async def send(message: Any) -> None:
        sent.append(message)

    async def receive() -> Any:
        raise AssertionError("nothing is received")

    asyncio.run(Guard(application)({"type": "http", "headers": asked}, receive, send))
    hosts = [value for name, value in asked if name.lower() == b"host"]
    own = len(hosts) == 1 and hosts[0].partition(b":")[0] in (b"127.0.0.1", b"localhost")
    assert own or not reached
    names = [name.lower() for name, _ in sent[0]["headers"]]
    for name in (b"content-security-policy", b"x-frame-options", b"referrer-policy"):
        assert names.count(name) == 1
    assert not any(
        b"max-age" in value for name, value in sent[0]["headers"] if name == b"set-cookie"
    )
    if reached:
        assert b"".join(message.get("body", b"") for message in sent[1:]) == body
    return "answered" if reached else "refused"
