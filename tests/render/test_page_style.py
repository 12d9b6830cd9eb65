"""How pages look: what is read and what is used stands out from what it is on (WCAG 2.2, 1.4.3 and 1.4.11)."""

import re

import pytest

from camkit.render.page_parts import STYLE
from camkit.render.roles import contrast


def themes():
    """The colours by name of each block that sets them."""
    blocks = re.findall(r"\{([^{}]*--paper:[^{}]*)\}", STYLE)
    return [dict(re.findall(r"--(\w+): (#\w+)", block)) for block in blocks]


def full(shade):
    return shade if len(shade) == 7 else "#" + "".join(2 * c for c in shade[1:])


def test_pages_and_sheets_have_a_light_and_a_dark_theme():
    assert len(themes()) == 4


@pytest.mark.parametrize("theme", themes(), ids=lambda theme: theme["paper"])
def test_letters_and_edges_have_the_contrast_that_wcag_asks_for(theme):
    shades = {name: full(shade) for name, shade in theme.items()}
    for behind in ("paper", "card"):
        for letters in ("ink", "pale", "accent", "bad", "ok"):
            assert contrast(shades[letters], shades[behind]) >= 4.5, (letters, behind)
        assert contrast(shades["edge"], shades[behind]) >= 3, behind


def test_no_other_colours_are_named():
    rest = re.sub(r"--\w+: #\w+", "", STYLE)
    assert not re.findall(r"#[0-9a-fA-F]{3,6}\b", rest)
