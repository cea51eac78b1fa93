"""What goes wrong."""

from __future__ import annotations

from pathlib import Path


class Error(Exception):
    """Something cannot be done, and the input is not to blame: a disk that is full, for example."""


class InputError(Error, ValueError):
    """The input is to blame. The words name the file, its line and column where there is one, and what was expected.

    Attributes:
        file: the file that is to blame, where it is one.
        line: the number of its line, from 1, where one is to blame.
    """

    def __init__(self, words: str, file: str | Path | None = None, line: int | None = None) -> None:
        super().__init__(words)
        self.file = None if file is None else Path(file)
        self.line = line
