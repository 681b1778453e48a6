"""Damage of the grains: which share of its bonds each has lost."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.results.contacts import grain_count
from clast.results.frame import Frame
from clast.results.run import Run


def shows_damage(run: Run) -> bool:
    """Tell whether grains differ in damage: there are several, and bonds."""
    return len(run.bond_ends) > 0 and grain_count(run.grain) > 1


class GrainDamage:
    """Damage of every grain of a run, frame by frame.

    Parameters
    ----------
    run : Run
    """

    def __init__(self, run: Run) -> None:
        # a particle that belongs to no grain is one of its own
        alone = run.grain.max(initial=-1) + 1 + np.arange(len(run.grain))
        _, self._grain = np.unique(np.where(run.grain >= 0, run.grain, alone), return_inverse=True)
        self._of_bond = self._grain[run.bond_ends[:, 0]]
        self._bonds = np.maximum(np.bincount(self._of_bond, minlength=len(run.grain)), 1)

    def of(self, frame: Frame) -> NDArray[np.float32]:
        """Return for each particle the share of its grain's bonds that are broken.

        Returns
        -------
        (n,) float32 in [0, 1]
        """
        broken = np.bincount(self._of_bond[~frame.bond_intact], minlength=len(self._bonds))
        share: NDArray[np.float32] = (broken / self._bonds).astype(np.float32)[self._grain]
        return share
