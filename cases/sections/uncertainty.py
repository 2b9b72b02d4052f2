"""How uncertain the inputs of a case are, and how that is carried into its results."""

from dataclasses import dataclass
from typing import Annotated, Literal

from cases.errors import QuantityError, RefusedValueError
from cases.sections.base import Section
from cases.values.kinds import Context, Switch, ValueKind, one_of, refused, whole_number
from cases.values.units import parse_ratio
from cases.values.wording import choices, shown, unknown_key

Method = Literal["latin_hypercube", "local"]
FORMS = ("standard_deviation", "range", "relative")
MOST_SAMPLES, MOST_SEED = 100_000, 2**32 - 1


@dataclass(frozen=True)
class UncertainInput:
    """One uncertain number of a case, as the file states it; what its units mean depends on the case.

    Attributes
    ----------
    key : str
        One of :func:`cases.reading.numeric_keys.numeric_keys`.
    form : str
        ``standard_deviation``, ``range`` or ``relative``.
    stated : object
        A quantity, a list of two, or a ratio.
    reason : str
        Where the uncertainty is from.
    """

    key: str
    form: str
    stated: object
    reason: str


ALLOWED = f"keys of the case, each with one of {choices(FORMS)}, and a reason"


def _inputs(value: object, _context: Context | None) -> tuple[UncertainInput, ...]:
    if not isinstance(value, dict) or not value:
        raise refused(value, ALLOWED)
    return tuple(_input(key, stated) for key, stated in value.items())


def _input(key: str, stated: object) -> UncertainInput:
    if not isinstance(stated, dict):
        raise refused(stated, f"a section with one of {choices(FORMS)}, and a reason", key=(key,))
    for name in stated:
        if name not in (*FORMS, "reason"):
            raise RefusedValueError(unknown_key(name, (*FORMS, "reason")), (key, name))
    forms = [form for form in FORMS if form in stated]
    if len(forms) != 1:
        found = choices(forms) if forms else "none of them"
        raise RefusedValueError(f"{found}; allowed: exactly one of {choices(FORMS)}", (key,))
    form, reason = forms[0], stated.get("reason")
    if not isinstance(reason, str) or not reason.strip():
        raise RefusedValueError(
            f"{shown(reason)}; allowed: a text, where the uncertainty is from", (key, "reason")
        )
    return UncertainInput(key, form, _checked(form, stated[form], (key, form)), reason)


def _checked(form: str, stated: object, place: tuple[str, ...]) -> object:
    """Return what is stated of an input; a ratio as a number, quantities as they are."""
    if form == "range":
        if not isinstance(stated, list) or len(stated) != 2:
            raise refused(stated, "[low, high]", key=place)
        return tuple(stated)
    if form != "relative":
        return stated
    allowed = 'a positive percentage below 100 %, e.g. "5 %"'
    try:
        ratio = parse_ratio(stated)
    except QuantityError as error:
        raise refused(stated, allowed, str(error), place) from error
    if not 0 < ratio < 1:
        raise refused(stated, allowed, key=place)
    return ratio


_QUANTITY = {"type": ["string", "number"]}
_SCHEMA = {
    "type": "object",
    "additionalProperties": {
        "type": "object",
        "properties": {
            "standard_deviation": _QUANTITY,
            "range": {"type": "array", "items": _QUANTITY},
            "relative": _QUANTITY,
            "reason": {"type": "string"},
        },
        "required": ["reason"],
        "additionalProperties": False,
    },
}
Inputs = Annotated[tuple[UncertainInput, ...], ValueKind(_inputs, ALLOWED, _SCHEMA)]


class Uncertainty(Section):
    """Uncertain inputs, and how the uncertainty of results is found from them.

    Attributes
    ----------
    method : str
        ``latin_hypercube``: samples of all inputs at once; ``local``: central differences of one input after
        the other.
    samples, seed : int
        How many samples a Latin hypercube has, and what its random numbers start from.
    inputs : tuple of UncertainInput
        A standard deviation, stated or ``relative`` to the case's value, is that of a normal distribution; a
        range is one in which all values are equally likely.
    shared_with_reference : bool
        Whether the reference was computed with the same values: an error in them is then in both, and no part
        of their difference.
    """

    method: Annotated[Method, one_of(Method)] = "latin_hypercube"
    samples: Annotated[
        int, whole_number(f"a whole number from 2 to {MOST_SAMPLES}", lambda n: 2 <= n <= MOST_SAMPLES)
    ] = 64
    seed: Annotated[
        int, whole_number(f"a whole number from 0 to {MOST_SEED}", lambda n: 0 <= n <= MOST_SEED)
    ] = 0
    inputs: Inputs
    shared_with_reference: Switch = True
