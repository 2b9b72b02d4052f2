"""Logs made of the lines that FEBio writes, for tests."""

RULE = "=" * 75
BANNER = f"""{RULE}
      F I N I T E   E L E M E N T S   F O R   B I O M E C H A N I C S

  version 4.8.0.0a1b2c3
  FEBio is a registered trademark.
{RULE}


 FILES USED
{RULE}
\tInput file : run.feb
\tPlot file  : run.xplt
\tLog file   : run.log

 MATERIAL DATA
{RULE}
  1 - Blood (type: fluid-FSI)
\tfluid: (type: fluid)
\t  density ......................................... : 1060
{"-" * 75}
  2 - Wall (type: neo-Hookean)
\tE ................................................. : 600000

"""


def box(*lines, title=None):
    rule = " " + "*" * 73
    body = ([title.center(69)] if title else []) + list(lines)
    return "\n".join([rule, *(f" * {line:<69} *" for line in body), rule, ""])


def begin(number, time):
    return f"\n===== beginning time step {number} : {time:g} =====\n\n"


def iteration(number, time, residual=1.0):
    return (
        f" {number}\n Nonlinear solution status: time= {time:g}\n"
        f"\tstiffness updates             = {number - 1}\n"
        f"\tright hand side evaluations   = {number + 1}\n"
        "\tstiffness matrix reformations = 1\n"
        "\tstep from line search         = 0.500000\n"
        "\tconvergence norms :     INITIAL         CURRENT         REQUIRED\n"
        f"\t   residual            1.000000e+00    {residual:e}    1.000000e-03 \n"
        "\t   energy              3.000000e-06    nan    3.000000e-08 \n"
    )


def converged(time, iterations=2, reformations=1):
    return (
        "\nconvergence summary\n"
        f"    number of iterations   : {iterations}\n    number of reformations : {reformations}\n"
        f"\n------- converged at time : {time:g}\n\n"
    )


def failed(time, attempt=1):
    return (
        f"\n------- failed to converge at time : {time:g}\n\n"
        f"Retrying time step. Retry attempt {attempt} of max 5\n\n\nAUTO STEPPER: retry step, dt = 0.05\n\n"
    )


def record(number, step, time, name, *lines, file=None):
    note = [f"Data Record #{number}", RULE, f"Step = {step}", f"Time = {time:.9g}", f"Data = {name}"]
    if file:
        note.append(f"File = {file}")
    return "\n" + "\n".join([*note, *lines]) + "\n\n"


END_OF_STEP = """
 N O N L I N E A R   I T E R A T I O N   I N F O R M A T I O N

\tNumber of time steps completed .................... : 2

\tTotal number of equilibrium iterations ............ : 4

"""
TIMING = """
 Elapsed time : 0:00:03

 T I M I N G   I N F O R M A T I O N

\tSolve time ...................... : 0:00:02 (2.5 sec)

\tTotal elapsed time .............. : 0:00:03 (3.01782 sec)

"""
NORMAL = "\n N O R M A L   T E R M I N A T I O N\n\n"
ERROR = "\n E R R O R   T E R M I N A T I O N\n\n"


def sample_log():
    """A run of two analysis steps, with a retry, records in the log, and boxes."""
    return "".join(
        [
            BANNER,
            record(1, 0, 0, "x;y", "1 0 0", "2 1 0"),
            box("Selecting linear solver pardiso"),
            begin(1, 0.1),
            "\n===== reforming stiffness matrix:\n\tNr of equations ........................... : 1872\n",
            "\tNr of nonzeroes in stiffness matrix ....... : 186332\n",
            iteration(1, 0.1),
            box("Max nr of iterations reached.", title="WARNING"),
            failed(0.1),
            begin(1, 0.05),
            iteration(1, 0.05),
            iteration(2, 0.05, 1e-4),
            converged(0.05),
            record(1, 1, 0.05, "x;y", "1 0.5 0", "2 1.5 0"),
            record(2, 1, 0.05, "stress", file="stress.txt"),
            END_OF_STEP,
            begin(1, 0.15),
            iteration(1, 0.15),
            "........................ augmentation # 1\n",
            iteration(2, 0.15),
            converged(0.15),
            END_OF_STEP,
            TIMING,
            NORMAL,
        ]
    )
