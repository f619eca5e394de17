"""Exceptions. Those about a scene say where the fault is: `file`, `line`, `key`, `message`."""


class Error(Exception):
    """Base class of the exceptions of this package."""


class _Placed(Error):
    """`file`, `line` and `key` are None if unknown; `message` says what is wrong and how to correct it."""

    file = None
    line = None
    key = None
    message = ""


class SceneError(_Placed, ValueError):
    """The scene, the study or an override is wrong."""


class AssemblyError(_Placed):
    """The mechanism cannot be assembled at t = 0, or drivers do not prescribe all its degrees of freedom."""


class RunError(Error):
    """The analysis failed. `result` is what was computed, or None."""

    def __init__(self, message, result=None):
        super().__init__(message)
        self.result = result


class ModelWarning(UserWarning):
    """A reason to doubt the results."""
