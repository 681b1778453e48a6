"""A live bar on a terminal, with lines of text above it."""

from __future__ import annotations

from typing import Any


class LiveBar:
    """Shows a bar from entering to leaving; a command's listener inherits it and moves it with :meth:`move`."""

    def __enter__(self) -> Any:
        """Show the bar."""
        from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn

        self.bar = Progress(TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), refresh_per_second=8)
        self.bar.start()
        self.task = self.bar.add_task("starting", total=None)
        return self

    def __exit__(self, *reason: object) -> None:
        """Remove the bar."""
        self.bar.stop()

    def say(self, text: str) -> None:
        """Print above the bar."""
        self.bar.console.print(text, highlight=False, soft_wrap=True)

    def move(self, text: str, done: int, whole: int) -> None:
        """Tell how much of the whole is done."""
        self.bar.update(self.task, description=text, completed=done, total=whole)
