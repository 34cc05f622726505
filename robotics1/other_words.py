"""What a reader of another package writes, and what it is called here: an unknown attribute names what is meant."""

from collections.abc import Callable, Mapping
from functools import wraps
from typing import TYPE_CHECKING, Any, TypeVar

from robotics1.errors import InputError, nearest_names

Kind = TypeVar("Kind", bound=type)
MOST = 12  # attributes that are listed
ALIKE = 0.7  # the least similarity of a name that is meant
ALMOST = 0.85  # that of a word of another package with a slip

FUNCTIONS = {  # lower case, without _: what others call a function
    "fk": "forward_kinematics", "fkine": "forward_kinematics", "forward": "forward_kinematics",
    "directkinematics": "forward_kinematics", "getpose": "forward_kinematics", "pose": "forward_kinematics",
    "ik": "solve_ik or ik_solutions", "ikine": "solve_ik", "inverse": "solve_ik",
    "inversekinematics": "solve_ik or ik_solutions",
    "allsolutions": "ik_solutions", "jacobian": "frame_jacobian, or the method jacobian of a task",
    "jacob0": "frame_jacobian", "jacobe": "frame_jacobian", "loadurdf": "load_robot", "fromurdf": "load_robot",
    "load": "load_robot", "urdf": "load_robot", "dh": "robot_from_dh", "dhtable": "urdf_to_dh",
    "dhparameters": "urdf_to_dh", "spline": "cubic_spline", "plot": "view, animate or plots", "teach": "view",
    "singularities": "find_singularities", "isreachable": "is_reached", "symbolic": "formulas", "sheet": "report",
    "datasheet": "report", "maniplty": "manipulability", "det": "formulas", "determinant": "formulas",
    "formula": "formulas", "dhrobot": "robot_from_dh", "seriallink": "robot_from_dh", "revolutedh": "robot_from_dh",
    "erobot": "load_robot", "rigidbodytree": "load_robot", "importrobot": "load_robot", "models": "load_robot",
    "plt": "plots", "show": "view, animate or plots", "fromdh": "robot_from_dh",
}  # fmt: skip
OF_OBJECTS = {"dh": "urdf_to_dh", "urdf": "dh_to_urdf"}  # words that mean another function where an object is asked
PLOTS = {  # class → the function that draws its objects
    "Robot": "view", "Workspace": "plot_workspace", "ReachabilityMap": "plot_reachability", "Curve": "plot_trajectory",
    "IKIteration": "plot_run", "ControlRun": "plot_run", "Tracking": "plot_run", "FrameTask": "plot_ellipses",
}  # fmt: skip
DRAW = ("plot", "show", "display", "draw")
ATTRIBUTES = {  # the same of attributes: the first that the object has is meant
    "solutions": "q", "solution": "q", "configurations": "q branches", "best": "q",
    "q": "joint_names __call__ branches",
    "tolist": "q", "numpy": "python", "simplify": "readable", "joints": "q", "first": "q", "all": "q",
    "success": "status", "converged": "status", "ok": "status", "found": "status", "error": "error_norm",
    "residual": "error_norm", "solve": "__call__", "ik": "__call__", "evaluate": "__call__ at", "eval": "__call__ at",
    "at": "__call__", "position": "__call__", "value": "__call__", "solvemany": "solve_batch", "batch": "solve_batch",
    "solveall": "solve_batch", "t": "duration end", "time": "duration end", "length": "end",
    "acc": "acceleration", "accel": "acceleration", "vel": "velocity", "speed": "velocity", "maxvelocity": "peak",
    "peakvelocity": "peak", "maxacceleration": "peak", "j": "jacobian", "jacob": "jacobian", "det": "determinant",
    "detj": "determinant", "p": "value", "r": "value", "f": "value", "subs": "at", "numeric": "at",
    "dof": "nv", "n": "nq", "ndof": "nv", "numjoints": "nq", "limits": "lower upper", "qlim": "lower upper",
    "jointlimits": "lower upper", "lowerlimits": "lower", "upperlimits": "upper", "velocitylimits": "max_velocity",
    "links": "frame_names", "frames": "frame_names", "linknames": "frame_names", "tools": "frame_names",
    "names": "joint_names", "coordinates": "row_names", "points": "branches", "singularities": "branches",
    "sets": "branches", "configuration": "q branches", "tocsv": "csv sample", "csv": "sample", "topandas": "sample",
    "jointtrajectory": "sample", "todict": "joint_trajectory", "open": "save", "show": "save", "write": "save",
    "radius": "r_max", "reach": "r_max",
}  # fmt: skip

CALLS: list[Callable[[str], str | None]] = []  # the name of a function → how it is called; the top adds this


def names_what_is_meant(kind: Kind) -> Kind:
    """Give a class an AttributeError that says what would be right."""
    kind.__getattr__ = _unknown  # type: ignore[attr-defined]  # a type checker goes on knowing each attribute
    return kind


def made_by(calls: str) -> Callable[[Kind], Kind]:
    """Let a class that users do not make themselves say which function makes its objects."""

    def decorated(kind: Kind) -> Kind:
        made = kind.__init__  # type: ignore[misc]

        @wraps(made)
        def make(self: Any, *given: Any, **named: Any) -> None:
            try:
                made(self, *given, **named)
            except TypeError as error:
                if error.__traceback__ is None or error.__traceback__.tb_next is not None:
                    raise  # from inside
                raise InputError(f"a {kind.__name__} is not made by its class: {calls} returns one") from None

        kind.__init__ = make  # type: ignore[misc]
        return kind

    return decorated


class ClassOfWords(type):
    """The metaclass of a class whose unknown attributes, as in `Robot.from_urdf`, name the function that is meant."""

    if not TYPE_CHECKING:  # a type checker goes on knowing each attribute

        def __getattr__(cls, name: str) -> Any:
            raise UnknownAttributeError(cls, name, FUNCTIONS)


class UnknownAttributeError(AttributeError):
    """Its sentence is made where it is read: `hasattr` asks often."""

    def __init__(self, kind: type, name: str, functions: Mapping[str, str] = OF_OBJECTS):
        super().__init__(kind, name, name=name)
        self.kind, self.functions = kind, functions

    def __str__(self) -> str:
        return f"{self.kind.__name__} has no {self.name!r}{_meant(self.kind, str(self.name), self.functions)}"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.kind, self.name, self.functions)


def _unknown(self: Any, name: str) -> Any:
    if name.startswith("_") or hasattr(type(self), name):
        return object.__getattribute__(self, name)  # raises what a property of that name has raised
    raise UnknownAttributeError(type(self), name)


def _meant(kind: type, name: str, functions: Mapping[str, str]) -> str:
    """Return what is meant: an attribute, a call of the object, a function that takes it, or what there is."""
    word = name.lower().replace("_", "")
    fields = getattr(kind, "__dataclass_fields__", {})
    known = [other for other in dict.fromkeys([*fields, *dir(kind)]) if not other.startswith("_")]
    wanted = ATTRIBUTES.get(word, "").split()
    meant = [other for other in wanted if other in known]
    if not meant and "__call__" in wanted and any("__call__" in vars(base) for base in kind.__mro__):
        return "; call the object itself, which is a function"
    if not meant and (written := _call(kind, name, word, functions)):
        return f"; write {written}"
    meant = meant or nearest_names(name, known, ALIKE)
    if meant:
        return f"; did you mean {' or '.join(meant)}?"
    return f"; it has {', '.join(known[:MOST])}{', ...' if len(known) > MOST else ''}"


def _call(kind: type, name: str, word: str, functions: Mapping[str, str]) -> str | None:
    drawn = [PLOTS[base.__name__] for base in kind.__mro__ if base.__name__ in PLOTS]
    known = {**FUNCTIONS, **functions, **(dict.fromkeys(DRAW, drawn[0]) if drawn else {})}
    function = known.get(word, name)
    return next(filter(None, (call(function.split()[0].rstrip(",")) for call in CALLS)), None)
