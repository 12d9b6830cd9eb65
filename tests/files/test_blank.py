"""The body that carries a cam: keyways as the standards print them."""

import numpy as np
import pytest

from camkit import inch, mm
from camkit.files import Blank


@pytest.mark.parametrize(
    ("bore", "width", "depth"),
    [(12, 4, 1.8), (12.01, 5, 2.3), (20, 6, 2.8), (30, 8, 3.3), (50, 14, 3.8), (110, 28, 6.4)],
)
def test_keyways_of_din_6885(bore, width, depth):
    keyway = Blank(bore=bore * mm, key="DIN 6885-1").keyway
    assert np.allclose(keyway, (width * mm, depth * mm))


def test_a_square_key_in_a_one_inch_bore():
    """ANSI B17.1, table of keyseat depths: a bore of 1 in takes a key of 1/4 in, T = 1.114 in."""
    keyway = Blank(bore=1 * inch, key="ANSI B17.1").keyway
    assert keyway.width == pytest.approx(0.25 * inch)
    assert (1 * inch + keyway.depth) / inch == pytest.approx(1.114, abs=5e-4)


def test_a_key_lies_in_the_bore_and_its_slot_clears_the_key():
    blank = Blank(bore=1 * inch, key="ANSI B17.1")
    width, depth = blank.keyway
    corner = np.hypot(width / 2, blank.bore / 2 + depth)
    assert blank.reach == pytest.approx(2 * corner)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"bore": 4 * mm, "key": "DIN 6885-1"}, "the bore is 4 mm, for which DIN 6885-1 has no key"),
        ({"bore": 20 * mm, "key": "DIN 6885-1", "hub_diameter": 25 * mm}, "the hub diameter is 25 mm"),
        ({"thickness": 0.0}, "thickness"),
        ({"key": "mine"}, "key"),
    ],
)
def test_what_cannot_be_made(given, said):
    with pytest.raises(ValueError, match=said):
        Blank(**given)
