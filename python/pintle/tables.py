"""Tables of numbers whose columns have names and units."""

import csv
import difflib
import io

import numpy


def split(heading):
    """Splits a heading into name and unit: "gudgeon pin.normal [N]", "coupler.fx on crank [N]"."""
    name, bracket, unit = heading.rpartition(" [")
    return (name, unit[:-1]) if bracket and unit.endswith("]") else (heading, "")


class Columns:
    """Names of headings; a name is also found without " on BODY" if that is unique."""

    def __init__(self, headings):
        self.names, self.units = [], []
        self._places = {}
        for place, heading in enumerate(headings):
            name, unit = split(heading)
            self.names.append(name)
            self.units.append(unit)
            for key in {heading, name, name.partition(" on ")[0]}:
                self._places.setdefault(key, []).append(place)
        for place, name in enumerate(self.names):
            self._places[name] = [place]

    def place(self, name):
        places = self._places.get(name)
        if not places:
            near = difflib.get_close_matches(str(name), self.names, 1, 0.5)
            hint = f'; did you mean "{near[0]}"?' if near else "; .names lists all"
            raise KeyError(f'there is no column "{name}"{hint}')
        if len(places) > 1:
            raise KeyError(f'"{name}" may be ' + " or ".join(f'"{self.names[p]}"' for p in places))
        return places[0]


class Headed:
    """Base class of results with named columns and units."""

    def __init__(self, headings):
        self._columns = Columns(headings)

    @property
    def names(self):
        """Names of the columns, in order."""
        return list(self._columns.names)

    def unit(self, name):
        """Unit of a column; "" if it is a number."""
        return self._columns.units[self._columns.place(name)]


class Table(Headed):
    """Rows of numbers with a column for each quantity; `table["crank.angle"]` is an array that shares the memory of the run."""

    def __init__(self, headings, data):
        super().__init__(headings)
        self.data = data

    def __getitem__(self, name):
        return self.data[:, self._columns.place(name)]

    def __contains__(self, name):
        try:
            self._columns.place(name)
        except KeyError:
            return False
        return True

    def __len__(self):
        return len(self.data)

    def __iter__(self):
        return iter(self._columns.names)

    def keys(self):
        return self.names

    def frame(self):
        """A pandas DataFrame; its `attrs["units"]` has the units by column."""
        import pandas

        frame = pandas.DataFrame(self.data, columns=self.names, copy=False)
        frame.attrs["units"] = dict(zip(self._columns.names, self._columns.units))
        return frame

    def plot(self, *names, against=None, axes=None):
        """Draws columns over the time, or over the column `against`, with matplotlib: one plot for each unit.

        Returns the axes, or a list of them if there are several."""
        import matplotlib.pyplot

        units = list(dict.fromkeys(self.unit(name) for name in names))
        if axes is None:
            axes = matplotlib.pyplot.subplots(len(units), 1, sharex=True, squeeze=False)[1][:, 0]
        axes = list(axes) if hasattr(axes, "__len__") else [axes]
        across = self.names[0] if against is None else against
        for name in names:
            axes[units.index(self.unit(name))].plot(self[across], self[name], label=name)
        for one, unit in zip(axes, units):
            one.set_ylabel(f"[{unit}]")
            one.legend()
        axes[-1].set_xlabel(f"{across} [{self.unit(across)}]")
        return axes[0] if len(axes) == 1 else axes

    def __repr__(self):
        return f"<table of {len(self)} rows: " + ", ".join(self.names[:4]) + (", …>" if len(self.names) > 4 else ">")

    def _repr_html_(self):
        head = "".join(f"<th>{n}<br>[{u}]</th>" for n, u in zip(self._columns.names, self._columns.units))
        shown = list(range(len(self))) if len(self) <= 10 else [0, 1, 2, 3, 4, -3, -2, -1]
        rows = ["".join(f"<td>{x:.6g}</td>" for x in self.data[k]) for k in shown]
        if len(self) > 10:
            rows.insert(5, f"<td>… {len(self) - 8} more</td>")
        return f"<table><tr>{head}</tr>" + "".join(f"<tr>{row}</tr>" for row in rows) + "</table>"


class TextTable(Table):
    """A table that holds words too: columns of numbers as of any table, empty fields being NaN; `words` has the others by name."""

    def __init__(self, text):
        header, *rows = csv.reader(io.StringIO(text))
        numbers, self.words, self._order = {}, {}, []
        for heading, column in zip(header, zip(*rows) if rows else [()] * len(header)):
            self._order.append(split(heading)[0])
            try:
                numbers[heading] = [float(x) if x else numpy.nan for x in column]
            except ValueError:
                self.words[self._order[-1]] = list(column)
        super().__init__(list(numbers), numpy.array(list(numbers.values())).T.reshape(len(rows), len(numbers)))

    def frame(self):
        """A pandas DataFrame with the words too, in the order of the file; its `attrs["units"]` has the units of the numbers by column."""
        frame = super().frame()
        for place, name in enumerate(self._order):
            if name in self.words:
                frame.insert(place, name, self.words[name])
        return frame
