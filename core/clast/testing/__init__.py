"""Contract kit: what every part of a kind must keep to, tried on a part before it computes anything.

``clast plugins check FILE`` tries every part of a file. In a test of a plugin::

    from clast.testing import assert_contract

    def test_my_law_keeps_to_the_contract():
        assert_contract("my_law.py")
"""

from __future__ import annotations

from clast.testing.claim import Claim, Outcome
from clast.testing.kit import assert_contract, claims_of, try_part

__all__ = ["Claim", "Outcome", "assert_contract", "claims_of", "try_part"]
