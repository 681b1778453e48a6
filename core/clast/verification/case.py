"""A case: a scene, what is known about it, and a judge that compares."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from clast.config.scene import SceneConfig
from clast.verification.bench import Bench
from clast.verification.finding import Finding
from clast.verification.sketch import Sketch

Need = Callable[[SceneConfig], str | None]
"""Tells why a case says nothing about the parts of a scene; None where it does."""

Findings = Iterator[Finding | Sketch]
"""What a judge yields, in the order of the table: numbers, and panels for the picture of its family."""


@dataclass(frozen=True)
class Case:
    """A scene with a known answer.

    Attributes
    ----------
    name : str
        How the command line names it.
    title : str
        What is verified, in a few words.
    config : str
        File name of the scene, without ``.yaml``; several cases may look at one scene.
    judge : (bench) -> iterator of Finding and Sketch
        Runs the scene, in as many variants as it needs.
    expected : str
        The closed form and its source, or where the expected numbers come from.
    needs : tuple of Need
        What the closed form asks of the scene's parts.
    """

    name: str
    title: str
    config: str
    judge: Callable[[Bench], Findings]
    expected: str
    needs: tuple[Need, ...] = ()


@dataclass(frozen=True)
class Family:
    """Cases that belong together, and share a picture.

    Attributes
    ----------
    name, title : str
    text : str
        Introduces the family in the documentation: Markdown.
    cases : tuple of Case
    """

    name: str
    title: str
    text: str
    cases: tuple[Case, ...]
