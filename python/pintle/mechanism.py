"""Scenes built from objects."""

import json

from .scene import parse, plain


class Element:
    """An entry of a mechanism, to be used where a scene has its name; `body["A"]` is a point of a body."""

    def __init__(self, kind, name, entry):
        self.kind, self.name, self._entry = kind, name, entry

    def __getitem__(self, point):
        points = self._entry.get("points", {})
        if point not in points:
            raise KeyError(f'{self.kind} "{self.name}" has no point "{point}"; it has ' + (", ".join(points) or "none"))
        return f"{self.name}.{point}"

    def __str__(self):
        return self.name

    def __repr__(self):
        return f"<{self.kind} {self.name}>"


def _said(value):
    """What a scene says: names in place of elements."""
    if isinstance(value, Element):
        return value.name
    if isinstance(value, dict):
        return {str(key): _said(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_said(one) for one in value]
    return value


def _entry(keywords):
    """The keys of the scene language, which have spaces where keywords have underscores."""
    return {name.replace("_", " "): _said(value) for name, value in keywords.items()}


class Mechanism:
    """Builds a scene: each `add_…` adds an entry with the keys of the scene language, and returns an element that others may name.

    Keywords of the class are sections of the scene, such as `gravity`. An underscore in a keyword is a space of the key."""

    def __init__(self, **sections):
        self._scene = {}
        self.set(**sections)

    def set(self, **sections):
        """Sets whole sections of the scene: title, gravity, ground, run, output …"""
        self._scene.update(_entry(sections))

    @property
    def ground(self):
        """The ground, with the points of the section `ground`."""
        return Element("ground", "ground", self._scene.get("ground", {}))

    def _add(self, kind, section, name, entry):
        entries = self._scene.setdefault(section, {})
        if name in entries:
            raise ValueError(f'there is already a {kind} called "{name}"; give this one another name')
        entries[name] = _entry(entry)
        return Element(kind, name, entries[name])

    def add_parameter(self, name, value):
        """A parameter, which expressions may name."""
        self._scene.setdefault("parameters", {})[name] = value
        return name

    def add_body(self, name, **entry):
        return self._add("body", "bodies", name, entry)

    def add_joint(self, name, **entry):
        return self._add("joint", "joints", name, entry)

    def add_contact(self, name, **entry):
        return self._add("contact", "contacts", name, entry)

    def add_driver(self, name, **entry):
        return self._add("driver", "drivers", name, entry)

    def add_force(self, name, **entry):
        return self._add("force", "forces", name, entry)

    def add_state(self, name, **entry):
        return self._add("state", "states", name, entry)

    def add_event(self, name, **entry):
        return self._add("event", "events", name, entry)

    def start(self, body, **entry):
        """Where a body starts and how fast."""
        self._scene.setdefault("start", {})[str(body)] = _entry(entry)

    def as_dict(self):
        """The scene as it has been built so far."""
        return json.loads(json.dumps(self._scene, default=plain))

    def scene(self):
        """The scene, read and validated."""
        return parse(self._scene)
