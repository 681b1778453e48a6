"""What single contact laws promise: each case holds for laws of one form."""

from __future__ import annotations

from clast.verification.case import Family
from clast.verification.contact_cases import adhesion, linear, plastic, rolling, unloading, viscoelastic

TEXT = """A case for each contact law beside `hertz_mindlin`, for its options and for what resists rolling, with the
closed form that its authors gave. A law of another form is left out of them."""

FAMILY = Family(
    "contact_laws",
    "Contact laws one by one",
    TEXT,
    (linear.CASE, unloading.CASE, viscoelastic.CASE, plastic.CASE, adhesion.CASE, rolling.CASE),
)
