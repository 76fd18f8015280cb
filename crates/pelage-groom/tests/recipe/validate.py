"""Recipes as JSON, one a line, against the schema: validate.py SCHEMA RECIPES."""

import json
import sys

import jsonschema

schema = json.load(open(sys.argv[1], encoding="utf-8"))
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
lines = open(sys.argv[2], encoding="utf-8").read().splitlines()
assert lines
for line in lines:
    validator.validate(json.loads(line))
wrong = json.loads(lines[0])
wrong["hair"]["cuont"] = 3
assert not validator.is_valid(wrong)
