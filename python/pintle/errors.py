"""Errors. Those about a scene say where it is wrong: `file`, `line`, `key`, `message`."""


class Error(Exception):
    """Of this package."""


class _Placed(Error):
    """`file`, `line` and `key` are None where there is none; `message` is what is wrong there and what to do about it."""

    file = None
    line = None
    key = None
    message = ""


class SceneError(_Placed, ValueError):
    """The scene, the study or an override is wrong."""


class AssemblyError(_Placed):
    """The mechanism cannot be put together at t = 0, or is not driven in all its freedoms."""


class RunError(Error):
    """No answer was found. `result` has what was computed, or is None."""

    def __init__(self, message, result=None):
        super().__init__(message)
        self.result = result


class ModelWarning(UserWarning):
    """What makes numbers doubtful."""
