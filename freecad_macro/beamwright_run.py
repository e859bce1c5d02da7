# SPDX-License-Identifier: MIT OR Apache-2.0
"""One run of the program beside FreeCAD's event loop: it can be watched and cancelled."""

from __future__ import annotations

from typing import Any, Sequence

from beamwright_outcome import Outcome, Progress, StderrReader, verdict
from beamwright_program import Program
from PySide import QtCore

#: Milliseconds the program has to end by itself when cancelled, before it is killed.
PATIENCE = 1500


class Run(QtCore.QObject):  # type: ignore[misc]
    """A run of the program.

    ``progressed`` brings a ``Progress``, ``said`` a line for the log, ``ended`` an ``Outcome``.
    """

    progressed = QtCore.Signal(object)
    said = QtCore.Signal(str)
    ended = QtCore.Signal(object)

    def __init__(self, program: Program, arguments: Sequence[str], parent: Any = None) -> None:
        super().__init__(parent)
        self._program, self._arguments = program, list(arguments)
        self._reader = StderrReader()
        self._stdout = b""
        self._cancelled = False
        self._process = QtCore.QProcess(self)
        self._process.readyReadStandardError.connect(self._read_stderr)
        self._process.readyReadStandardOutput.connect(self._read_stdout)
        self._process.finished.connect(self._finished)
        self._process.errorOccurred.connect(self._failed)

    @property
    def is_running(self) -> bool:
        """Whether the program has not ended yet."""
        return bool(self._process.state() != QtCore.QProcess.ProcessState.NotRunning)

    def start(self) -> None:
        """Starts the program; ``ended`` follows in any case."""
        self._process.start(self._program.path, self._arguments)

    def cancel(self) -> None:
        """Asks the program to end, and kills it if it does not."""
        self._cancelled = True
        if self.is_running:
            self._process.terminate()
            QtCore.QTimer.singleShot(PATIENCE, self._kill)

    def stop_at_once(self) -> None:
        """Kills the program and waits for its end; ``ended`` follows."""
        self._cancelled = True
        self._kill()
        self._process.waitForFinished(5000)

    def _kill(self) -> None:
        if self.is_running:
            self._process.kill()

    def _read_stderr(self) -> None:
        self._tell(self._reader.feed(bytes(self._process.readAllStandardError().data())))

    def _read_stdout(self) -> None:
        self._stdout += bytes(self._process.readAllStandardOutput().data())

    def _tell(self, events: Sequence[Any]) -> None:
        # Of many steps that came in one piece only the last is worth painting.
        steps = [e for e in events if isinstance(e, Progress)]
        for line in (e for e in events if isinstance(e, str)):
            self.said.emit(line)
        if steps:
            self.progressed.emit(steps[-1])

    def _finished(self, code: int, status: Any) -> None:
        self._read_stderr()
        self._read_stdout()
        self._tell(self._reader.close())
        crashed = status == QtCore.QProcess.ExitStatus.CrashExit
        if crashed and not self._cancelled and not self._reader.error:
            self._reader.error = "the program was killed or crashed"
        code = -1 if crashed else code
        self.ended.emit(verdict(code, self._stdout, self._reader, self._cancelled))

    def _failed(self, error: Any) -> None:
        if error == QtCore.QProcess.ProcessError.FailedToStart:
            text = f"cannot start {self._program.path}: {self._process.errorString()}"
            self.ended.emit(Outcome(-1, text, {}))
