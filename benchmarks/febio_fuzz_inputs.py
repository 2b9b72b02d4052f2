"""What febio_fuzz.py feeds to the readers: the tests' samples, and how each kind of file is read whole."""

import random
import re
import struct
import sys
import zlib
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "febio_io"))  # its writers of made-up files

from log_samples import sample_log
from test_feb_structure import MODEL, OLD
from xplt_samples import ITEMS, MESH, rich_file, sample_file, sample_sections, state_values
from xplt_writer import Writer

from febio_io import to_xarray
from febio_io.errors import FebioError
from febio_io.feb.structure import read_structure
from febio_io.feb.summary import model_lines, problem_lines, summarize_model
from febio_io.run.endings import explain_ending
from febio_io.text.data_records import read_data_record
from febio_io.text.log import read_log
from febio_io.xplt import Plot, open_plot
from febio_io.xplt.summary import summarize, summary_lines
from febio_io.xplt.tags import Tag

WRITER = Writer()
OLD_LOG = b"===== beginning time step 1 : 1 =====\n 1\n Nonlinear solution status: time= 1\n"
OLD_LOG += b"\t   residual  1 -nan(ind) 0\n"
OLD_LOG += b"------- converged at time : 1\n\tTime in solver: 0:01:30\n Elapsed time : 0:02:00\n"
RECORDS = [
    b"1 2\n2 3\n1 4\n2 5\n",
    b"*Step  = 1\n*Time  = 0.1\n*Data  = x;y;z\n0 0 0\n1 0 -nan(ind)\n*Step  = 2\n*Time  = 0.2\n0 0 1\n",
    b"\xef\xbb\xbf# note\n*Step  = 1\n*Time  = 0.1\n*Data  = ux;uy\n5:0.5:0.25\n",
    b"*Step  = 1\n*Time  = 0.1\n*Data  = ux;uy\n0.5%s\n0.25%s\n",
]
NUMBERS = [0, 1, 2, 3, 4, 7, 8, 0x7F, 0xFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFF0, 0xFFFFFFFF, *map(int, Tag)]
WORDS = [
    b"*Step  = 1\n",
    b"*Time  = 0.5\n",
    b"nan",
    b"-1.#IND",
    b"1e999",
    b"9" * 40,
    b"0,5",
    b":",
    b"<",
    b'id="1"',
    b"@surface:",
    b"1:999999999",
    b"\n",
    b";",
    b"\0",
]

VALUES = [b"1", b"-1", b"9" * 40, b"nan", b"x", b"1:999999999", b"@surface:S"]


class Kind(NamedTuple):
    """One kind of input: name, reader, what is put around the damaged bytes, whole samples, weight."""

    name: str
    read: Callable[[Path], None]
    around: Callable[[bytes], bytes]
    samples: list[bytes]
    weight: int


def read_plot(path: Path) -> None:
    """Read all there is; first as a file that is too large to keep inflated."""
    with suppress(FebioError), open_plot(path, keep_inflated=0) as plot:
        read_values(plot)
    with open_plot(path) as plot:
        "\n".join(summary_lines(summarize(plot)))
        read_values(plot)
        to_xarray(plot)


def read_values(plot: Plot) -> None:
    for state in range(plot.n_states):
        plot.active_elements(state)
        plot.objects(state)
        for variable in plot.variables:
            for region in plot.regions(variable, state):
                plot.field(variable, state, region)


def read_text_log(path: Path) -> None:
    log = read_log(path)
    log.steps_table()
    explain_ending(path.read_text(encoding="utf-8", errors="replace"))
    for record in log.records:
        if record.file is None:
            log.data_record(record.number).to_pandas()


def read_model(path: Path) -> None:
    contents = read_structure(path)
    "\n".join(model_lines(summarize_model(path, contents)))
    "\n".join(problem_lines(contents))


def read_record(path: Path) -> None:
    record = read_data_record(path)
    record.to_pandas()
    record.to_xarray()


def around_state(content: bytes) -> bytes:
    """Put the (damaged) bytes of a state into a compressed state."""
    return WRITER.file(WRITER.root(ITEMS), WRITER.mesh(MESH), zlib.compress(content, 1))


def unchanged(content: bytes) -> bytes:
    return content


def kinds() -> list[Kind]:
    """List the kinds of input."""
    raw, packed = sample_file(states=2), sample_file(zlib=True, states=2)
    remeshed = WRITER.file(*sample_sections(states=1), WRITER.mesh(MESH), WRITER.state(1, state_values(1)))
    plots = [raw, packed, packed, sample_file(order=">", states=1), remeshed, rich_file()]
    blocks = [b"*Step  = %d\n*Time  = %g\n*Data  = x;y\n1 2 3\n4,5,nan\n" % (k, k / 8) for k in range(4)]
    return [
        Kind("plot file", read_plot, unchanged, plots, 5),
        Kind("compressed state", read_plot, around_state, [WRITER.state(0, state_values(0))], 2),
        Kind("log", read_text_log, unchanged, [sample_log().encode(), OLD_LOG], 1),
        Kind("data record", read_record, unchanged, [b"".join(blocks), *RECORDS], 2),
        Kind("model", read_model, unchanged, [MODEL.encode(), OLD.encode(), MODEL.encode("utf-16")], 2),
    ]


def mutate(content: bytes, random_: random.Random) -> bytes:
    """Damage some bytes: overwrite, cut, drop, repeat, insert; or, of XML, values."""
    if content.startswith(b"<?xml") and random_.random() < 0.8:
        return mutate_values(content, random_)
    result = bytearray(content)
    for _ in range(random_.choice((1, 1, 1, 2, 3, 8))):
        at = random_.randrange(max(len(result), 1))
        match random_.randrange(7):
            case 0:
                result[at : at + 1] = bytes([random_.randrange(256)])
            case 1:
                result[at : at + 4] = struct.pack(random_.choice("<>") + "I", random_.choice(NUMBERS))
            case 2:
                aligned = at & ~3
                result[aligned : aligned + 4] = struct.pack("<I", random_.choice(NUMBERS))
            case 3:
                del result[at:]
            case 4:
                del result[at : at + random_.randrange(1, 40)]
            case 5:
                other = random_.randrange(max(len(result), 1))
                result[at:at] = result[other : other + random_.randrange(1, 200)]
            case _:
                result[at:at] = random_.choice(WORDS)
    return bytes(result)


def mutate_values(content: bytes, random_: random.Random) -> bytes:
    """Exchange some values of attributes and texts of XML, so that it stays XML."""
    words = re.split(rb"([\w@:.,+-]+)", content)
    values = [k for k in range(7, len(words), 2) if not words[k - 1].endswith((b"<", b"/"))]
    for place in random_.choices(values, k=random_.choice((1, 1, 2, 3, 8))):
        if not words[place + 1].startswith(b"="):
            words[place] = random_.choice([words[random_.choice(values)], *VALUES])
    return b"".join(words)
