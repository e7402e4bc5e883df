"""Holding a number to a published one, and telling both."""


def meets(case: str, published: float, ours: float, tolerance: float) -> None:
    """Show a number beside the published one and hold it to a relative tolerance.

    `tests/validation.py` reads the line into the validation page.
    """
    deviation = ours / published - 1.0
    numbers = f"{published:.6g} | {ours:.6g} | {100 * deviation:+.3f} % | {100 * tolerance:.3g} %"
    print(f"\n| {case} | {numbers} |")
    assert abs(deviation) <= tolerance, f"{case}: published {published}, ours {ours}"
