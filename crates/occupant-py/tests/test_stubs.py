"""Stubs and docstrings tell the truth about the module."""

import ast
import inspect
from pathlib import Path

import pytest

import occupant
from occupant import _occupant

STUB = ast.parse((Path(__file__).resolve().parents[1] / "python" / "occupant" / "_occupant.pyi").read_text())
CLASSES = {one.name: one for one in STUB.body if isinstance(one, ast.ClassDef)}
FUNCTIONS = {one.name: one for one in STUB.body if isinstance(one, ast.FunctionDef)}


def is_public(name):
    return not name.startswith("_") or name in ("__getitem__", "__setitem__", "__delitem__", "__len__")


def is_property(stub):
    return any(isinstance(mark, ast.Name) and mark.id == "property" for mark in stub.decorator_list)


def is_static(stub):
    return any(isinstance(mark, ast.Name) and mark.id == "staticmethod" for mark in stub.decorator_list)


def stubbed(stub):
    """Parameters of a stub: name, kind, default as text, `...` for one that is not a literal."""
    given, kinds = stub.args, inspect.Parameter
    plain = given.posonlyargs + given.args
    defaults = [None] * (len(plain) - len(given.defaults)) + given.defaults
    found = [(own.arg, kinds.POSITIONAL_OR_KEYWORD, default) for own, default in zip(plain, defaults)]
    if given.vararg:
        found.append((given.vararg.arg, kinds.VAR_POSITIONAL, None))
    found += [(own.arg, kinds.KEYWORD_ONLY, default) for own, default in zip(given.kwonlyargs, given.kw_defaults)]

    def text(default):
        # the module has no words for lists
        return "..." if isinstance(default, ast.Tuple) else default and ast.unparse(default)

    return [(name, kind, text(default)) for name, kind, default in found if name != "self"]


def told(function):
    """The same of the module."""
    def default(own):
        if own.default is inspect.Parameter.empty:
            return None
        return "..." if own.default is Ellipsis else repr(own.default)

    every = inspect.signature(function).parameters.values()
    return [(own.name, own.kind, default(own)) for own in every if own.name != "self"]


def members():
    for name, stub in CLASSES.items():
        for one in stub.body:
            if isinstance(one, ast.FunctionDef):
                yield name, one


def test_stub_and_module_have_the_same_names():
    names = {name for name in vars(_occupant) if is_public(name)}
    assert names == CLASSES.keys() | FUNCTIONS.keys()
    assert set(occupant.__all__) == names | {"__version__"}
    for name, stub in CLASSES.items():
        if name != "OccupantError":
            own = {one for one in vars(getattr(_occupant, name)) if is_public(one)}
            ours = {one.name for one in stub.body if isinstance(one, ast.FunctionDef)} - {"__init__"}
            assert own == ours, name


@pytest.mark.parametrize("owner, stub", list(members()), ids=lambda one: getattr(one, "name", one))
def test_a_method_is_as_its_stub_says(owner, stub):
    of = getattr(_occupant, owner)
    if stub.name == "__init__":
        assert told(of) == stubbed(stub)
        return
    own = inspect.getattr_static(of, stub.name)
    assert (type(own).__name__ == "getset_descriptor") == is_property(stub)
    assert isinstance(own, staticmethod) == is_static(stub)
    if not is_property(stub) and is_public(stub.name) and not stub.name.startswith("__"):
        assert told(getattr(of, stub.name)) == stubbed(stub)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_is_as_its_stub_says(name):
    assert told(getattr(_occupant, name)) == stubbed(FUNCTIONS[name])


def documented():
    for name in (*CLASSES, *FUNCTIONS):
        own = getattr(_occupant, name)
        yield name, own, FUNCTIONS.get(name)
        for one in CLASSES[name].body if name in CLASSES else ():
            if isinstance(one, ast.FunctionDef) and not one.name.startswith("__"):
                yield f"{name}.{one.name}", getattr(own, one.name), one


@pytest.mark.parametrize("name, own, stub", list(documented()), ids=lambda one: one if isinstance(one, str) else "")
def test_everything_has_a_docstring_that_names_its_parameters(name, own, stub):
    text = inspect.getdoc(own)
    assert text and text.rstrip().endswith("."), name
    if stub is not None and len(stubbed(stub)) > 1:
        missing = [parameter for parameter, *_ in stubbed(stub) if f"`{parameter}`" not in text]
        assert not missing, f"{name} does not say what {missing} is"
