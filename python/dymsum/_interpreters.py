"""Refuses interpreters beside the main one: types of the compiled part belong to one, and the process would be aborted
at the end of another."""

import importlib

for _name in ("_interpreters", "_xxsubinterpreters"):
    try:
        _module = importlib.import_module(_name)
    except ImportError:
        continue
    if _module.get_current() != _module.get_main():
        raise ImportError("dymsum can be imported in the main interpreter of a process alone")
    break
