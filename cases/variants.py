"""Variants: named overrides of one base, merged key by key."""

from collections.abc import Mapping
from types import MappingProxyType

from cases.yaml_nodes import Node

# what a section is; stating another one replaces the section, since the old keys do not fit the new kind
DISCRIMINATORS = MappingProxyType(
    {"calcification": "pattern", "inlet": "kind", "outlet": "kind", "reference": "kind"}
)
NO_DISCRIMINATORS: Mapping[str, str] = MappingProxyType({})


def merge_variant(base: Node, override: Node) -> Node:
    """Merge the override of one variant into the base.

    Sections merge key by key, anything else is replaced, lists included. A section whose override states
    another discriminator (`calcification.pattern`, `inlet.kind`, …) is replaced whole.

    Parameters
    ----------
    base, override : Node
        Sections of the case file; values keep the lines where they stand.

    Returns
    -------
    Node
        The merged section, at the place of the base.
    """
    return Node(_merge(base, override, DISCRIMINATORS).value, base.line, base.key)


def _merge(base: Node, override: Node, discriminators: Mapping[str, str]) -> Node:
    if not isinstance(base.value, dict) or not isinstance(override.value, dict):
        return override
    merged = dict(base.value)
    for key, node in override.value.items():
        present = merged.get(key)
        if present is None or _is_another(present, node, discriminators.get(key)):
            merged[key] = node
        else:
            merged[key] = _merge(present, node, NO_DISCRIMINATORS)
    return Node(merged, override.line, override.key)


def _is_another(present: Node, stated: Node, discriminator: str | None) -> bool:
    """Tell whether a section states another discriminator than the one it overrides."""
    if discriminator is None or not isinstance(present.value, dict) or not isinstance(stated.value, dict):
        return False
    old, new = present.value.get(discriminator), stated.value.get(discriminator)
    return new is not None and (old is None or old.value != new.value)
