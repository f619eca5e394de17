"""What users read is true: doctests, the page of docs/, the scripts of examples/, the stubs for type checkers."""

import ast
import builtins
import doctest
import inspect
import os
import subprocess
import sys
import unittest

import numpy
import pintle
from common import examples, root


class Words(unittest.TestCase):
    def setUp(self):
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(root)

    def test_doctests(self):
        self.assertEqual(doctest.testmod(pintle).failed, 0)

    def test_the_page_of_docs(self):
        found = doctest.testfile(str(root / "docs" / "python.md"), module_relative=False, optionflags=doctest.ELLIPSIS)
        self.assertGreater(found.attempted, 20)
        self.assertEqual(found.failed, 0)

    def test_scripts_of_examples(self):
        expected = {
            "worn_pin": ["0.01 mm: 5 contacts, peak 2241 N", "0.1 mm: 19 contacts, peak 5124 N"],
            "control_loop": ["torque 5.886 N m"],
            "own_force": ["at rest at 0.1972 rad for 0.1972"],
            "questions": ["a lever at rest at 53.39 deg, stable: True"],
            "studies": ["0.50 mm: 18 contacts", "the goal is met: True"],
        }
        self.assertEqual(sorted(expected), sorted(file.stem for file in (examples / "python").glob("*.py")))
        for name, lines in expected.items():
            with self.subTest(script=name):
                script = examples / "python" / f"{name}.py"
                done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                for line in lines:
                    self.assertIn(line, done.stdout)


class Stubs(unittest.TestCase):
    """__init__.pyi has the names of the package, with the parameters that functions have."""

    stubs = ast.parse((root / "python" / "pintle" / "__init__.pyi").read_text())

    def parameters(self, function):
        a = function.args
        return [x.arg for x in a.posonlyargs + a.args] + ([a.vararg.arg] if a.vararg else []) + [x.arg for x in a.kwonlyargs] + (
            [a.kwarg.arg] if a.kwarg else [])

    def test_the_same_names(self):
        stubbed = {n.name for n in self.stubs.body if isinstance(n, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(stubbed, set(pintle.__all__))

    def test_the_same_parameters(self):
        for node in self.stubs.body:
            if isinstance(node, ast.FunctionDef):
                self.assertEqual(self.parameters(node), list(inspect.signature(getattr(pintle, node.name)).parameters), node.name)

    def test_the_same_members(self):
        for node in (n for n in self.stubs.body if isinstance(n, ast.ClassDef)):
            kind = getattr(pintle, node.name)
            named = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
            named |= {n.target.id for n in node.body if isinstance(n, ast.AnnAssign)}
            public = {n for n, v in vars(kind).items() if not n.startswith("_") and n not in vars(tuple)}
            if issubclass(kind, tuple):
                public = set(kind._fields)
            self.assertLessEqual(public, named, node.name)
            for member in (n for n in node.body if isinstance(n, ast.FunctionDef) and not n.decorator_list and n.name != "__init__"):
                found = list(inspect.signature(getattr(kind, member.name)).parameters)
                self.assertEqual(self.parameters(member), found, f"{node.name}.{member.name}")

    def fits(self, value, kind):
        """Whether a value is of the kind that an annotation of the stubs names."""
        if isinstance(kind, ast.BinOp):
            return self.fits(value, kind.left) or self.fits(value, kind.right)
        text = "numpy.typing.NDArray[numpy.float64]" if ast.unparse(kind) == "Array" else ast.unparse(kind)
        if text.startswith("numpy.typing.NDArray["):
            return isinstance(value, numpy.ndarray) and f"numpy.typing.NDArray[numpy.{value.dtype}]" == text
        if isinstance(kind, ast.Subscript):
            parts = kind.slice.elts if isinstance(kind.slice, ast.Tuple) else [kind.slice]
            if not self.fits(value, kind.value):
                return False
            if kind.value.id == "dict":
                return all(self.fits(k, parts[0]) and self.fits(v, parts[1]) for k, v in value.items())
            return all(self.fits(one, parts[0]) for one in value)
        if isinstance(kind, ast.Constant):
            return value is kind.value
        if kind.id == "Any":
            return True
        known = {**vars(builtins), **vars(pintle)}[kind.id]
        return isinstance(value, known) and not (known is int and isinstance(value, bool))

    def members(self, value, node):
        """Names and annotations of the attributes and properties of an object, those of its base classes too."""
        for base in node.bases:
            if isinstance(base, ast.Name) and base.id in self.classes:
                yield from self.members(value, self.classes[base.id])
        for one in node.body:
            if isinstance(one, ast.AnnAssign):
                yield one.target.id, one.annotation
            elif isinstance(one, ast.FunctionDef) and any(getattr(d, "id", "") == "property" for d in one.decorator_list):
                yield one.name, one.returns

    def test_calls_return_what_the_stubs_say(self):
        self.classes = {n.name: n for n in self.stubs.body if isinstance(n, ast.ClassDef)}
        returns = {n.name: n.returns for n in self.classes["Scene"].body if isinstance(n, ast.FunctionDef)}
        seen = 0
        for call, scene, given in (
            ("run", "slider_crank_clearance", {"set": {"run.until": "2 ms"}}), ("statics", "statics_lever", {}), ("modes", "modes_beam", {}),
            ("modes", "modes_eye_bar", {}), ("linearize", "pid_arm", {"at_rest": True}), ("inverse", "inverse_four_bar", {}),
            ("kinematics", "kinematics_quick_return", {}), ("static", "modes_beam", {}), ("mesh", "modes_beam", {}), ("check", "pendulum", {}),
        ):
            value = getattr(pintle.load(examples / f"{scene}.yaml", given.pop("set", None)), call)(**given)
            self.assertTrue(self.fits(value, returns[call]), call)
            waiting = [value]
            while waiting:
                one = waiting.pop()
                if type(one).__name__ not in self.classes:
                    continue
                for name, kind in self.members(one, self.classes[type(one).__name__]):
                    member = getattr(one, name)
                    self.assertTrue(self.fits(member, kind), f"{call}: {type(one).__name__}.{name} is {member!r}, not {ast.unparse(kind)}")
                    waiting += member if isinstance(member, list) else [member]
                    seen += 1
        self.assertGreater(seen, 60)


if __name__ == "__main__":
    unittest.main()
