"""Force chains: what the pieces of a scene pass on to each other, from centre to centre."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.results.contacts import Contacts
from clast.results.fragments import fragments
from clast.results.frame import Frame
from clast.results.run import Run

Floats32 = NDArray[np.float32]


class Chains(NamedTuple):
    """Links of the force chains, the strongest first.

    Attributes
    ----------
    ends : (k, 2, 3) float32
        Centres of the two pieces, or where a piece touches a wall and its centre, in m.
    force : (k,) float32
        Size of the force between them in N, summed over their contacts.
    """

    ends: Floats32
    force: Floats32


def pieces(run: Run, frame: Frame) -> NDArray[np.int64]:
    """Return which piece, held together by bonds, each particle belongs to: (n,) int64 from 0."""
    return fragments(len(run.radius), run.bond_ends.astype(np.int64), frame.bond_intact)


def force_chains(frame: Frame, contacts: Contacts, piece: NDArray[np.int64], budget: int | None) -> Chains:
    """Sum up contacts to links between pieces, and keep the strongest.

    Parameters
    ----------
    frame : Frame
    contacts : Contacts
        Of that frame. Those inside a piece make no link.
    piece : (n,) int64
        As :func:`pieces` gives it.
    budget : int or None
        Most links, None for all.
    """
    present = np.isfinite(frame.position).all(axis=1)
    weight = np.maximum(np.bincount(piece[present], minlength=int(piece.max(initial=0)) + 1), 1)
    place_of = frame.unwrapped
    sums = [np.bincount(piece[present], place_of[present, c], len(weight)) for c in range(3)]
    centre = frame.box.wrapped(np.stack(sums, axis=1) / weight[:, None]).astype(np.float32)
    first = piece[contacts.i]
    # a wall is met at many places, so that its contacts are counted by piece and number of the wall
    second = np.where(contacts.j >= 0, piece[np.maximum(contacts.j, 0)], contacts.j.astype(np.int64))
    link, force, place = _summed(first, second, contacts)
    near_end = np.where(link[:, :1] < 0, place, centre[np.maximum(link[:, 0], 0)])
    far_end = centre[link[:, 1]]
    ends = np.stack([frame.box.beside(far_end, near_end), far_end], axis=1)
    order = np.argsort(-force, kind="stable")[:budget]
    return Chains(ends[order].astype(np.float32), force[order].astype(np.float32))


def _summed(
    first: NDArray[np.int64], second: NDArray[np.int64], contacts: Contacts
) -> tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.float64]]:
    """Return the linked (smaller, larger) numbers, the size of the force between them, and where they touch."""
    other = first != second
    low, high = np.minimum(first, second)[other], np.maximum(first, second)[other]
    side = np.where(second[other] == high, 1.0, -1.0)
    link, of = np.unique(np.stack([low, high], axis=1), axis=0, return_inverse=True)
    of = of.ravel()

    def total(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.stack([np.bincount(of, values[:, c], len(link)) for c in range(3)], axis=1)

    force = total(side[:, None] * contacts.force[other])
    place = total(contacts.position[other].astype(np.float64)) / np.bincount(of, minlength=len(link))[:, None]
    return link, np.linalg.norm(force, axis=1), place


def reference_force(run: Run, frames: Sequence[int]) -> float:
    """Return the force in N that is drawn in full: one link of twenty has more, where the scene is pressed most."""
    pressed = [float(np.abs(found.normal_force).sum()) if (found := run.contacts(k)) else 0.0 for k in frames]
    k = frames[int(np.argmax(pressed))]
    found = run.contacts(k)
    if found is None or not len(found.i):
        return 1.0
    frame = run.frame(k)
    strong = float(np.quantile(force_chains(frame, found, pieces(run, frame), None).force, 0.95))
    return strong if strong > 0.0 else 1.0
