"""What FEBio's common endings mean, told by the lines of its own log."""

import re

# What a log or the screen says, of the first that is found: what it means and what helps.
ENDINGS = (
    (
        r"does not support the requested matrix format",
        "",  # depends on the solver
    ),
    (
        r"[Nn]egative jacobian(s)? (was )?detected during",
        "the mesh has elements that are inside out from the start: the order of their nodes is wrong",
    ),
    (
        r"FAILED!",
        "FEBio could not read the model",
    ),
    (
        r"zero\(s\) found on diagonal|Zero diagonal",
        (
            "something moves without resistance: a node without an element or support, or a material without "
            "stiffness"
        ),
    ),
    (
        r"memory allocation failure|bad_alloc|[Oo]ut of memory",
        "the matrix does not fit into memory: a coarser mesh, or a larger machine",
    ),
    (
        r"(?i)\blicen[sc]e\b.*(not found|expired|invalid|could not|fail)|no (valid )?licen[sc]e",
        (
            "the linear solver wants a licence that it does not find: set another by <default_linear_solver "
            'type="pardiso"/> (that of Intel\'s MKL needs none), in a file for --config'
        ),
    ),
    (
        r"[Nn]egative jacobian",
        (
            "an element was turned inside out: a smaller time step or a slower ramp of the loads, a finer "
            "mesh there, or a material that is less soft"
        ),
    ),
    (
        r"NAN detected",
        "values ran away: a smaller time step, and units and signs of loads and parameters that agree",
    ),
    (
        r"Max\. nr of retries reached",
        (
            "the step failed with every smaller size that <max_retries> and <dtmin> allow: smaller steps, "
            "slower loads, or looser tolerances"
        ),
    ),
    (
        r"(?i)fatal error.*configuration file|failed reading febio configuration",
        "the configuration (febio.xml beside the program, or --config FILE) could not be read",
    ),
)
SOLVERS = re.compile(r"Selecting linear solver (\S+)|[Dd]efault linear solver[ .]*: *(\S+)")


def explain_ending(said: str) -> str:
    """Say what a failed run's ending means, and what helps.

    Parameters
    ----------
    said : str
        The log, and what came on the screen.

    Returns
    -------
    str
        A sentence, with the line that it explains if that is in `said`; empty if no ending is known.
    """
    last = said.rpartition("------- converged at time")[2]  # what failed before has been overcome
    for pattern, meaning in ENDINGS:
        if found := re.search(pattern, last):
            start = last.rfind("\n", 0, found.start()) + 1
            line = last[start:].partition("\n")[0].strip(" *\t\r")[:120]
            return f"{line!r} means: {meaning or _no_fast_solver(said)}"
    return ""


def _no_fast_solver(said: str) -> str:
    named = [first or second for first, second in SOLVERS.findall(said)]
    if named and named[-1] == "pardiso":
        return (
            "this FEBio was built without Pardiso (Intel's MKL), though it knows the name: use a build that "
            "has it, such as that of https://febio.org/downloads"
        )
    solver = named[-1] if named else "skyline"
    return (
        f"the linear solver {solver!r} is for symmetric matrices only, flow needs another: "
        '<default_linear_solver type="pardiso"/> in febio.xml beside the program, or in a file for --config'
    )
