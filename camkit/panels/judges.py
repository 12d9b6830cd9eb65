"""`ahp_panel` of a group: the judgements of one judge at a time, and what all say together."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..decision import Judges
from ..quantities.kinds import refuse_arguments
from ..views.front import judges_beside
from .ahp import AhpPanel, as_fraction, two_digits
from .kit.inputs import Amount, Menu
from .kit.parts import Part, Table, Words, row


class JudgesPanel(AhpPanel):
    """The sliders and boxes of one of several judges, how much each counts, and where they disagree.

    ``judgements`` and ``weights`` are the group's, ``given`` are all judges.
    """

    _view = staticmethod(judges_beside)

    def __init__(self, judges: Judges, title: str = "") -> None:
        refuse_arguments(JudgesPanel.__init__, locals())
        self.given: Judges
        self.judge = Menu(list(judges.said), "judge")
        self.share = Amount(description="counts", tooltip="how much this judge counts beside the others")
        self.way = Menu([("judgements", "judgements"), ("weights", "priorities")], "join the")
        self.table, self.disputed = Table(), Words()
        super().__init__(judges, title)
        self._quiet.hear(self.judge, lambda name: self._judge(self.given.said[name]))
        self._quiet.hear(self.share, self._weigh)
        self._quiet.hear(self.way, lambda way: self._take(replace(self.given, method=way)))

    def _questions(self) -> tuple[Part, ...]:
        return (row(self.judge, Words(value=["counts"]), self.share, self.way),)

    def _answers(self) -> tuple[Part, ...]:
        return self.table, self.disputed

    def load(self, judgements: object) -> None:
        """Show other judges of the same criteria."""
        if not isinstance(judgements, Judges):
            raise ValueError("there are the judgements of one judge; this panel has those of a group")
        self._refuse_others(judgements)
        with self._quiet:
            self.judge.offer(list(judgements.said), next(iter(judgements.said)))
            self.way.value = judgements.method
            self.method.value = judgements.judgements.method
        self._take(judgements)

    def _take(self, judges: Judges) -> None:
        """Show other judges, or the same ones joined in another way."""
        self.given = judges
        self._judge(judges.said[self.judge.value])

    def _weigh(self, share: float) -> None:
        """Let the judge count for more or less."""
        shares = {**dict(zip(self.given.said, self.given.shares, strict=True)), self.judge.value: share}
        try:
            self._take(replace(self.given, shares=tuple(shares.values())))
        except ValueError as refusal:
            self._take(self.given)
            self.banner.show_message(f"The judges count as before: {refusal}.")

    def _together(self) -> Judges:
        said = {name: replace(each, method=self.method.value) for name, each in self.given.said.items()}
        return replace(self.given, said={**said, self.judge.value: self.said})

    def _show(self) -> None:
        super()._show()
        judges = self.given
        with self._quiet:
            self.share.value = judges.shares[list(judges.said).index(self.judge.value)]
        self.table.put(*judges.rows())
        self.disputed.say(self.dispute)

    @property
    def dispute(self) -> str:
        """The pair of criteria on which a judge is farthest from the group, and who that is."""
        for i, j in self.given.disputed:  # the most disputed comes first
            apart = abs(np.log(self.given.ratios[:, i, j]))
            who = list(self.given.said)[int(np.nanargmax(apart))]
            says = as_fraction(self.given.said[who].array[i, j])
            group = two_digits(self.judgements.complete().array[i, j])
            pair = f"{self.names[i]} against {self.names[j]}"
            return f"Most disputed: {pair}, where {who} says {says} and the group about {group}."
        return ""

    def summary(self) -> str:
        """Weights of the group and of each judge."""
        return "\n".join([super().summary(), self.dispute, self.table.text])
