"""The command `robotics1`."""

from robotics1.cli.commands import main as main
