"""Stands in for FEBio: writes a real log and plot file slowly, and ends as it is told to.

Told by files beside the model: "behaviour" holds the way to end, "real.xplt" the plot file to write.
"""

import os
import signal
import sys
import time
from pathlib import Path

RULE = "=" * 75
HEAD = f"{RULE}\n  version 4.11.0\n{RULE}\n FILES USED\n{RULE}\n\tPlot file  : model.xplt\n\n"
ERROR = f" {'*' * 73}\n * {'ERROR':^69} *\n * {'Negative jacobian was detected.':<69} *\n {'*' * 73}\n"
TIMING = "\tTotal elapsed time .............. : 0:00:01 (1.25 sec)\n"


def step(number, time_):
    return (
        f"\n===== beginning time step {number} : {time_:g} =====\n 1\n 2\nconvergence summary\n"
        f"    number of iterations   : 2\n\n------- converged at time : {time_:g}\n\n"
    )


def main():
    assert sys.argv[1] == "-i"
    model = Path(sys.argv[2])
    behaviour = Path("behaviour").read_text()
    Path("arguments").write_text("\n".join(sys.argv[1:]))
    log_name, plot_name = model.with_suffix(".log"), model.with_suffix(".xplt")
    if Path("names").exists():  # those that the model gives
        log_name, plot_name = map(Path, Path("names").read_text().split())
    Path("pid").write_text(str(os.getpid()))
    Path("threads").write_text(os.environ.get("OMP_NUM_THREADS", ""))
    sys.stdout.write("on the screen\n")
    sys.stdout.flush()
    if behaviour == "silent":
        return 3
    if behaviour == "stubborn":
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
    plot = Path("real.xplt").read_bytes()
    with log_name.open("w") as log, plot_name.open("wb") as out:
        log.write(HEAD)
        for number in range(1, 5):
            log.write(step(number, 0.1 * number))
            log.flush()
            out.write(plot[(number - 1) * len(plot) // 4 : number * len(plot) // 4])
            out.flush()
            time.sleep(0.1)
            if number == 2 and behaviour in ("hang", "stubborn"):
                time.sleep(600)
            if number == 2 and behaviour == "error":
                log.write(ERROR + TIMING + "\n E R R O R   T E R M I N A T I O N\n")
                return 1
            if number == 2 and behaviour == "killed":
                log.flush()
                os.kill(os.getpid(), signal.SIGKILL)
        log.write(TIMING + "\n N O R M A L   T E R M I N A T I O N\n")
    if behaviour == "no plot":
        plot_name.unlink()
    return 0


sys.exit(main())
