"""Validates cases against the JSON Schema of case.toml by an implementation that is not ours.

Usage: check_case_schema.py SCHEMA [+CASE | -CASE]...   + must be valid, - must not be.
"""

import json
import sys
import tomllib

import jsonschema

with open(sys.argv[1], encoding="utf-8") as file:
    schema = json.load(file)
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)

faults = 0
for argument in sys.argv[2:]:
    wanted, path = argument[0] == "+", argument[1:]
    with open(path, "rb") as file:
        case = tomllib.load(file)
    errors = list(validator.iter_errors(case))
    if wanted != (not errors):
        faults += 1
        told = "; ".join(f"{'.'.join(map(str, e.absolute_path))}: {e.message}" for e in errors)
        print(f"{path} is {'not ' if errors else ''}valid: {told}")
sys.exit(min(faults, 1))
