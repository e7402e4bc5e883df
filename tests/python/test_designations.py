"""Names as they stand on boxes: what they mean, what of them is doubted, and what is refused."""

from __future__ import annotations

import csv
import warnings
from importlib import resources

import pytest

import ballrace as br

MARKS = list(
    csv.DictReader(
        resources.files("ballrace.bearings").joinpath("marks.csv").read_text("utf-8").splitlines()
    )
)


@pytest.mark.parametrize(
    ("name", "designation", "clearance"),
    [
        # Literature: the makers' catalogues, by their systems of designations.
        ("7208 BECBP", "7208B", None), ("6205-2RSH/C3WT", "6205", "C3"), ("6309-2Z/C3GJN", "6309", "C3"),
        ("FAG 6205-C-2HRS-C3", "6205", "C3"), ("SKF Explorer 6205-2RSH/C3", "6205", "C3"), ("6316", "6316", None),
        ("SKF 6205-2RS JEM", "6205", None), ("6205 2Z/C3", "6205", "C3"), ("nsk 6205ddu", "6205", None),
        ("NSK 6205DDUCM NS7", "6205", None), ("NTN 6205LLUC3/5K", "6205", "C3"), ("6205ZZC4", "6205", "C4"),
        ("Timken 6210-2RS-C3", "6210", "C3"), ("KOYO 6203 2RDC3", "6203", "C3"), ("NACHI 6204-2NSE", "6204", None),
        ("6308-2Z/C3HT51", "6308", "C3"), ("6316 M/C3VL0241", "6316", "C3"), ("6205-2RSL/C3GJN", "6205", "C3"),
        ("62052RS", "6205", None), ("W 6205-2RS1", "6205", None), ("BB1-6205", "6205", None),
        ("6205.2Z.C3", "6205", "C3"),
        ("LDK UER204", "UER204", None), ("MB ER-16K", "ER-16K", None), ("er16k", "ER-16K", None),
        ("6805ZZ", "61805", None), ("6804", "61804", None), ("688ZZ", "618/8", None), ("698-2RS", "619/8", None),
        ("6022", "6022", None), ("60/22", "60/22", None), ("16008/C3", "16008", "C3"), ("608-2RSH", "608", None),
        ("7205 BEP", "7205B", None), ("7205-B", "7205B", None), ("7205 AC", "7205A5", None),
        ("7205CD", "7205C", None),
        ("SKF 7205 ACD/P4A", "7205A5", None), ("FAG B7205-E-T-P4S-UL", "7205A5", None), ("7210A", "7210A", None),
        ("NSK 7208CTYNSULP4", "7208C", None), ("7206-B-XL-TVP-UO", "7206B", None), ("7308BDB", "7308B", None),
        ("3205 A-2RS1TN9/MT33", "3205", None), ("5206ZZ", "3206", None), ("51105", "51105", None),
    ],
)  # fmt: skip
def test_names_on_boxes(name: str, designation: str, clearance: str | None) -> None:
    found = br.catalogue.read(name)
    assert (found.designation, found.clearance, found.unknown) == (designation, clearance, ())
    assert br.catalogue[name].designation == designation
    assert name in br.catalogue


def test_a_name_is_taken_apart() -> None:
    found = br.catalogue.read("SKF Explorer 6309-2Z/C3GJN")
    assert found.maker == "SKF"
    assert found.meanings == {
        "2Z": "shields on both sides",
        "C3": "clearance above normal, ISO 5753-1",
        "GJN": "polyurea grease, NLGI 2",
    }
    assert (
        br.bearing("6309-2Z/C3GJN", speed_rpm=1800.0).rows[0].clearance
        == br.bearing("6309", clearance="C3", speed_rpm=1800.0).rows[0].clearance
    )


def test_marks_are_a_table_of_meanings() -> None:
    names = [line["mark"] for line in MARKS]
    assert len(names) == len(set(names)) > 100
    assert all(line["meaning"] and line["makers"] for line in MARKS)
    assert {line["effect"] for line in MARKS} == {"", "clearance", "balls", "material"}
    for name in names:
        assert name in br.catalogue.read(f"6205-{name}").meanings, name


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("6205-2RS/QQ7", "QQ7: not known, and ignored; taken as 6205"),
        ("6205DDUC3X9", "X9: not known"),
        (
            "6205 ETN9",
            "ETN9, SKF's larger set of balls .*: taken as 6205, 9 balls of 7.94 mm of steel",
        ),
        ("6205-2RSLTN9/HC5C3WT", "HC5, balls of silicon nitride"),
        ("SKF 6305-2Z", "SKF prints other ratings than the maker of these 8 balls of 10.319 mm"),
    ],
)
def test_what_may_be_another_bearing_is_doubted_and_taken(name: str, message: str) -> None:
    """Literature of the last: SKF prints C₀ 11.6 kN of a 6305, NSK 11.2."""
    with pytest.warns(br.SceneWarning, match=message):
        assert br.bearing(name, speed_rpm=1800.0).name in ("6205", "6305")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert name in br.catalogue
        br.catalogue.read(name)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("NU205", "NU205 is a cylindrical roller bearing: ballrace simulates ball bearings"),
        ("SKF NU 2205 ECP", "NU 2205 ECP is a cylindrical roller bearing"),
        ("NJ310", "cylindrical"), ("N 205", "cylindrical"), ("22212 E", "a spherical roller bearing"),
        ("FAG 23024-E1-XL", "spherical"), ("30205", "a tapered roller bearing"), ("NSK HR32208J", "tapered"),
        ("33210", "tapered"), ("NA4905", "a needle roller bearing"), ("HK 2012", "needle"), ("RNA 4905", "needle"),
        ("1205", "a self-aligning ball bearing: its outer race is a sphere"), ("2205-2RS1", "self-aligning"),
        ("51205", "a thrust ball bearing of another series"), ("29412 E", "a roller thrust"),
        ("81105", "a roller thrust"),
        ("QJ210", r"a four-point bearing: write a scene with br\.scene\.GothicArch"),
        ("UC205", "an insert bearing"),
        ("C2205", "a toroidal roller bearing"), ("4205", "a double row deep groove bearing"),
        # Literature: the IMS data's BPFO of 236.4 Hz at 2000 1/min; the four of an NU330.
        ("Rexnord ZA-2115", r"its fault frequencies are FTF 0\.4433, BPFO 7\.092, BPFI 8\.908"),
        ("NU 330", r"its fault frequencies are FTF 0\.4, BPFO 5\.6, BPFI 8\.4, BSF 2\.55 times the shaft's"),
    ],
)  # fmt: skip
def test_bearings_without_balls_are_refused_by_their_kind(name: str, message: str) -> None:
    with pytest.raises(br.SceneError, match=message) as refused:
        br.bearing(name, speed_rpm=1800.0)
    assert refused.value.path == "designation"
    assert name not in br.catalogue


def test_long_names_are_read_at_once() -> None:
    """Fibonacci's many ways to read it as marks Z and ZZ are one."""
    for long in (60 * "Z" + "!", 100_000 * "Z", 3000 * " C3", "-" * 100_000):
        assert br.catalogue.read("6205" + long).designation == "6205"
        assert "6" + long not in br.catalogue


@pytest.mark.parametrize(
    ("name", "near"),
    [
        ("6299", "6209"), ("7205", "7205A, 7205A5, 7205B, 7205C"), ("62205-2RS", "6220"), ("622082RS", "6220"),
        ("", "from 6000 on"),
        ("63005-2RS", "from_dimensions"),
    ],
)  # fmt: skip
def test_an_unknown_name_says_what_is_near(name: str, near: str) -> None:
    """Wide series, such as 622, are no 6220 with a mark."""
    with pytest.raises(br.SceneError) as refused:
        br.catalogue[name]
    assert (refused.value.path, refused.value.value) == ("designation", repr(name))
    assert near in refused.value.allowed
    assert name not in br.catalogue
    assert br.catalogue.get(name) is None
