"""Names of files, made of names in a model."""

import re


def safe_name(name: str) -> str:
    """Replace what not every file system takes by underscores.

    Parameters
    ----------
    name : str
        Any text.

    Returns
    -------
    str
        Letters, digits, dots, dashes and underscores; not empty, and neither dot nor underscore at an end.
    """
    return re.sub(r"[^\w.-]+", "_", name).strip("._") or "unnamed"
