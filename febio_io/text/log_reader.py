"""Reads a log line by line; what a line means depends only on it and on the section it is in."""

import re
from collections.abc import Callable
from pathlib import Path

from febio_io.text.log_model import Input, Log, Message, MessageKind, Norm, Termination
from febio_io.text.log_state import Attempt, State, end_iteration, log_of
from febio_io.text.record_blocks import Block, float_of, numbered_lines

NUMBER = r"([-+]?(?:\d{1,30}\.?\d{0,30}|\.\d{1,30})(?:[eE][-+]?\d{1,5})?|[-+]?(?:nan|inf))"
COUNT = r"(\d{1,15})"
RULE = re.compile(r"={70,}")
SEPARATOR = re.compile(r"-{70,}")
BOX_RULE = re.compile(r" ?\*{60,}")
VERSION = re.compile(r"\s*version\s+(\d+\.\d+\.\d+)")
SPACED_VERSION = re.compile(r"[\s-]*v e r s i o n[\s-]*(\d[\d .]*)")
LEADERS = re.compile(r"\.\.\s*:")  # the end of the dots between a name and its value
FILE_LINE = re.compile(r"\t(\w+ file)\s*:\s*(.*)")
DURATION = re.compile(rf"\d+:\d\d:\d\d\s*\({NUMBER} sec\)")
# What FEBio 1 and 2 tell instead, without seconds: the labels that their successors have.
OLD_DURATION = re.compile(r"\s*(Time in (?:linear )?solver|Elapsed time)\s*: (\d{1,6}):(\d\d):(\d\d)\s*")
OLD_LABELS = {"Elapsed time": "Total elapsed time"}
MEMORY = re.compile(rf"\s*Peak memory\s*:\s*{NUMBER} MB")
RECORD = re.compile(rf"Data Record #{COUNT}")
RECORD_HEADER = re.compile(r"(Step|Time|Data|File) = ?(.*)")
STEP = re.compile(rf"===== beginning time step {COUNT} : {NUMBER} =====")
ITERATION = re.compile(rf" {COUNT}")
STATUS = re.compile(rf" Nonlinear solution status: time= {NUMBER}")
COUNTS = {
    "stiffness updates": "stiffness_updates",
    "right hand side evaluations": "right_hand_sides",
    "stiffness matrix reformations": "reformations",
    "step from line search": "line_search_step",
}
COUNT_LINE = re.compile(rf"\t({'|'.join(COUNTS)})\s*= {NUMBER}")
SUMMARY = re.compile(rf"\s*number of (iterations|reformations)\s*: {COUNT}")
CONVERGED = re.compile(r"-+ converged at time :")
FAILED = re.compile(r"-+ failed to converge at time :")
RETRY = re.compile(r"Retrying time step\.")
AUGMENTATION = re.compile(r"\.{10,} augmentation #")
END_OF_STEP = "NONLINEARITERATIONINFORMATION"
MATRIX = {"Nr of equations": "n_equations", "Nr of nonzeroes in stiffness matrix": "n_nonzeros"}
TERMINATIONS: dict[str, Termination] = {"NORMALTERMINATION": "normal", "ERRORTERMINATION": "error"}


def parse_log(path: Path, text: str) -> Log:
    """Read the text of a log.

    Parameters
    ----------
    path : Path
        The file.
    text : str
        Its text.

    Returns
    -------
    Log
        What it tells.
    """
    state = State()
    whole, _, cut = text.rpartition("\n")
    for number, line in numbered_lines(whole):
        _read_line(state, number, line)
    if state.record is None:  # a record's line that is cut off would look like a whole one
        _read_line(state, whole.count("\n") + 2, cut)
    end_iteration(state)
    return log_of(state, path)


def _read_line(state: State, number: int, line: str) -> None:
    if not any(reader(state, number, line) for reader in READERS):
        _read_plain(state, number, line)
    if line.strip():
        state.previous = line.strip()


def _read_box(state: State, number: int, line: str) -> bool:
    if BOX_RULE.fullmatch(line.rstrip()):
        if state.box is None:
            state.box = [(number, "")]
        else:
            _end_box(state, state.box)
        return True
    if state.box is None:
        return False
    text = line.strip()
    if not text.startswith("*"):
        # A box that was cut short, as by a kill.
        _end_box(state, state.box)
        return False
    state.box.append((number, text.strip("*").strip()))
    return True


def _end_box(state: State, box: list[tuple[int, str]]) -> None:
    state.box = None
    lines = [text for _, text in box[1:] if text]
    kind: MessageKind = "info"
    if lines and lines[0].upper() in ("WARNING", "ERROR", "FATAL ERROR"):
        kind = "warning" if lines[0].upper() == "WARNING" else "error"
        lines = lines[1:]
    state.messages.append(Message(kind, " ".join(lines), box[0][0]))


def _read_record(state: State, number: int, line: str) -> bool:
    if match := RECORD.fullmatch(line.strip()):
        state.record = int(match[1])
        state.records.setdefault(state.record, []).append((Block(number), []))
        return True
    if state.record is None:
        return False
    block, lines = state.records[state.record][-1]
    if match := RECORD_HEADER.match(line):
        _record_header(state, state.record, block, match[1], match[2].strip())
    elif not line.strip():
        state.record = None
    elif not RULE.fullmatch(line.strip()):
        lines.append((number, line))
    return True


def _record_header(state: State, record: int, block: Block, key: str, text: str) -> None:
    if key == "Data":
        block.name = text
    elif key == "File":
        state.record_files[record] = text
    elif match := re.fullmatch(COUNT if key == "Step" else NUMBER, text):
        if key == "Step":
            block.step = int(match[1])
        else:
            block.time = float(match[1])


def _read_step(state: State, number: int, line: str) -> bool:
    if match := STEP.match(line):
        _begin_step(state, number, int(match[1]), float(match[2]))
        return True
    if RETRY.match(line):
        state.retry = True
        return True
    if not state.attempts or state.step_ended:
        return False
    attempt = state.attempts[-1]
    if CONVERGED.match(line) or FAILED.match(line):
        end_iteration(state)
        attempt.outcome = "converged" if CONVERGED.match(line) else "failed"
    elif match := SUMMARY.fullmatch(line.rstrip()):
        if match[1] == "iterations":
            attempt.n_iterations = int(match[2])
        else:
            attempt.n_reformations = int(match[2])
    elif AUGMENTATION.match(line):
        attempt.n_augmentations += 1
    else:
        return _read_iteration(state, line)
    return True


def _begin_step(state: State, line: int, number: int, time: float) -> None:
    end_iteration(state)
    state.section = "solution"
    last = state.attempts[-1] if state.attempts else None
    analysis_step, attempt = 1, 1
    if last is not None:
        again = number == last.number and (state.retry or last.outcome != "converged")
        new_analysis = state.step_ended or number < last.number or (number == last.number and not again)
        analysis_step = last.analysis_step + new_analysis
        attempt = last.attempt + 1 if again and not new_analysis else 1
    state.attempts.append(Attempt(analysis_step, number, attempt, time, line))
    state.step_ended = state.retry = False


def _read_iteration(state: State, line: str) -> bool:
    if match := ITERATION.fullmatch(line.rstrip()):
        end_iteration(state)
        state.pending = {"number": float(match[1])}
    elif match := STATUS.match(line):
        if "time" in state.pending:
            end_iteration(state)
        state.pending["time"] = float(match[1])
    elif match := COUNT_LINE.match(line):
        state.pending[COUNTS[match[1]]] = float(match[2])
    else:
        return _read_norm(state, line)
    return True


def _read_norm(state: State, line: str) -> bool:
    """Take in a norm: its name and three numbers, indented by a tab and blanks."""
    words = line.split()
    indented = line.startswith(("\t ", "\t\t"))
    values = [value for word in words[-3:] if (value := float_of(word)) is not None]
    if not indented or len(words) < 4 or len(values) < 3:
        return False
    state.norms[" ".join(words[:-3])] = Norm(*values)
    return True


def _read_end(state: State, _number: int, line: str) -> bool:
    letters = line.replace(" ", "")
    if letters == END_OF_STEP:
        end_iteration(state)
        state.step_ended = True
        state.section = letters
        state.totals.append({})
    elif letters in TERMINATIONS:
        state.termination = TERMINATIONS[letters]
    elif (pair := _named_value(line)) and (match := DURATION.fullmatch(pair[1])):
        state.timings[pair[0]] = float(match[1])
    elif match := OLD_DURATION.fullmatch(line):
        label = OLD_LABELS.get(match[1], "time in linear solver")
        seconds = 3600.0 * int(match[2]) + 60.0 * int(match[3]) + int(match[4])
        state.old_timings[label] = state.old_timings.get(label, 0.0) + seconds
    elif match := MEMORY.match(line):
        state.peak_memory = float(match[1])
    else:
        return False
    return True


READERS: tuple[Callable[[State, int, str], bool], ...] = (_read_box, _read_record, _read_step, _read_end)


def _read_plain(state: State, number: int, line: str) -> None:
    if RULE.fullmatch(line.rstrip()):
        state.section, state.item = state.previous, []
    elif SEPARATOR.fullmatch(line.rstrip()):
        state.item = []
    elif not state.version and (match := VERSION.match(line)):
        state.version = match[1]
    elif not state.version and (match := SPACED_VERSION.match(line)):
        state.version = match[1].replace(" ", "").rstrip(".")
    elif match := FILE_LINE.fullmatch(line):
        state.files.setdefault(match[1], match[2].strip())
    elif pair := _named_value(line):
        _read_value(state, number, line, *pair)
    elif line.strip() and not state.attempts:
        _read_item(state, line)


def _named_value(line: str) -> tuple[str, str] | None:
    """Split "name ..... : value", piece by piece: one pattern for all would take quadratic time."""
    match = LEADERS.search(line)
    name = line[: match.start()].rstrip(".").strip() if match else ""
    return (name, line[match.end() :].strip()) if match and name else None


def _read_value(state: State, number: int, line: str, name: str, value: str) -> None:
    indent = len(line.expandtabs(4)) - len(line.expandtabs(4).lstrip())
    if name in MATRIX and re.fullmatch(COUNT, value):
        state.matrix[MATRIX[name]] = int(value)
    elif state.step_ended:
        if state.totals and re.fullmatch(NUMBER, value):
            state.totals[-1][name] = float(value)
    elif not state.attempts:
        item = " / ".join(text for depth, text in state.item if depth < indent)
        state.inputs.append(Input(state.section, item, name, value, number))


def _read_item(state: State, line: str) -> None:
    """Take in a line that says what the next inputs belong to, e.g. a material or a part of it."""
    text = line.expandtabs(4)
    indent = len(text) - len(text.lstrip())
    state.item = [(depth, above) for depth, above in state.item if depth < indent]
    state.item.append((indent, text.strip()))
