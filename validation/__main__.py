"""All commands under one name: ``arterial-rom NAME …``, or ``python -m validation NAME …``."""

import sys
from collections.abc import Sequence
from difflib import get_close_matches

from cases.shell.command import COMPLETE, WRONG_INPUT, run

# module, loaded only when it is used, and what it does
COMMANDS = {
    "check": ("cases", "check case files, or print their JSON schema"),
    "solve": ("solver", "run the reduced model alone"),
    "compare": ("validation.compare", "compare the reduced model with a 3D reference, and write a report"),
    "report": ("reports", "draw the reports of finished comparisons or sweeps again"),
    "sweep": ("validation.sweep", "run a case over ranges and distributions of its numbers"),
    "inspect": ("validation.reference", "tell what files of a 3D result hold, and how a case states them"),
    "calibrate": ("validation.calibrate", "fit numbers of a case to pressures or to a 3D run"),
    "converge": ("validation.converge", "tell what the reduced model's numbers owe to its grid and steps"),
    "ablation": ("validation.ablation", "tell what each part of the coupled model buys against 3D"),
    "tables": ("validation.tables", "compute the thesis's tables again"),
    "benchmark": ("validation.benchmark", "measure how fast the solver is on this machine"),
    "febio": ("febio_io", "tell what a file of FEBio holds, or write it in other formats"),
    "feb": ("febio_io.feb", "write FEBio's model of a case"),
    "run-febio": ("febio_io.run", "run FEBio on a model, and tell how it ended"),
}
PROGRAM = "arterial-rom"


def main(argv: Sequence[str] | None = None) -> int:
    """Exit status of the command that is named first; without a name, all are listed."""
    name, *rest = (sys.argv[1:] if argv is None else argv) or ["--help"]
    if name in ("-h", "--help"):
        print(listed())
        return COMPLETE
    if name not in COMMANDS:
        nearest = get_close_matches(name, COMMANDS, n=1, cutoff=0)[0]
        message = f"no command {name!r}; the nearest is {nearest!r}, {PROGRAM} --help lists all"
        print(f"{PROGRAM}: {message}", file=sys.stderr)
        return WRONG_INPUT
    return run(f"{COMMANDS[name][0]}.command", f"{PROGRAM} {name}", rest)


def listed() -> str:
    """Names of the commands, a line each with what it does."""
    width = max(map(len, COMMANDS))
    lines = [f"  {name:{width}}  {what}" for name, (_, what) in COMMANDS.items()]
    return "\n".join(
        [f"usage: {PROGRAM} NAME …", "", *lines, "", f"{PROGRAM} NAME --help tells what it takes"]
    )


if __name__ == "__main__":
    sys.exit(main())
