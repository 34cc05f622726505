"""How the commands answer what is typed wrong: with the command or the option that may be meant."""

from typing import Any

from typer.core import TyperCommand, TyperGroup

from robotics1.errors import nearest_names

MEANT = {"--q": "the values of the joints", "--target": "a target", "--force": "a force"}


class CommandGroup(TyperGroup):
    """The commands; what is none is answered with those that begin so or are near."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        """Return the command that is named first."""
        try:
            return super().resolve_command(ctx, args)
        except Exception as error:
            whole = [name for name in self.commands if name.startswith(args[0].lower())] or nearest_names(
                args[0], self.commands
            )
            if whole and "Did you mean" not in getattr(error, "message", "Did you mean"):
                error.message = f"{error.message.rstrip('.')}. Did you mean {', '.join(map(repr, whole))}?"  # type: ignore[attr-defined]
            raise


class RobotCommand(TyperCommand):
    """A command; a word too many is answered with the options that such words stand behind."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Read the words of the command line."""
        names = {name for parameter in self.params for name in parameter.opts}
        apart = any(word in names for word in args[:-1])
        one_dash = [f"-{word}" for word in args if word[:2] != "--" and f"-{word.partition('=')[0]}" in names]
        try:
            return super().parse_args(ctx, args)
        except Exception as error:
            message = getattr(error, "message", "")
            behind = [f"{what} behind {option}" for option, what in MEANT.items() if option in names]
            if behind and "extra argument" in message:
                joined = "; numbers that belong together have a comma between them, as 1,2" if apart else ""
                error.message = f"{message}: write {', '.join(behind)}{joined}"  # type: ignore[attr-defined]
            if one_dash and "No such option" in message:
                error.message = f"one dash is too few: write {one_dash[0]}"  # type: ignore[attr-defined]
            raise
