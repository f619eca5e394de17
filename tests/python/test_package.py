"""What users read is true: doctests, the page of docs/, the scripts of examples/, the stubs for type checkers."""

import ast
import doctest
import inspect
import os
import subprocess
import sys
import unittest

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


if __name__ == "__main__":
    unittest.main()
