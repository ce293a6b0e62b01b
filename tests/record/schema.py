#!/usr/bin/python3
"""The JSON schema of records of jobs, made of the messages that they are written from.

schema.py: exit code 1 where proto/job_record.schema.json is another one; schema.py --fix writes it.
"""
import json
import os
import subprocess
import sys
import tempfile

from google.protobuf import descriptor_pb2

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCHEMA = os.path.join(TOP, "proto/job_record.schema.json")
PACKAGE = ".trc.v1."
FIELD = descriptor_pb2.FieldDescriptorProto

SHA256 = {"pattern": "^[0-9a-f]{64}$"}
# What the messages do not say: by message and field.
BESIDES = {
    ("JobFile", "sha256"): SHA256,
    ("JobDiagnostics", "sha256"): SHA256,
    ("JobRecord", "format"): {"const": "trc-job-record-1"},
    ("JobRecord", "outputFormat"): {"enum": ["nc", "jsonl", "listing"]},
    ("JobRecord", "outcome"): {"enum": ["DONE", "REFUSED"]},
    ("JobRecord", "clientVersion"): {"minLength": 1},
    ("JobRecord", "clientCommit"): {"minLength": 1},
    ("JobRecord", "serverVersion"): {"minLength": 1},
    ("JobRecord", "serverCommit"): {"minLength": 1},
    ("JobRecord", "started"): {"pattern": r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$"},
    ("JobRecord", "seconds"): {"minimum": 0},
    ("JobRecord", "sha256"): SHA256,
}
REQUIRED = {
    "JobFile": ["name", "sha256"],
    "JobDiagnostics": ["sha256"],
    "JobRecord": ["format", "input", "output", "outputFormat", "outcome", "setup", "clientVersion",
                  "clientCommit", "serverVersion", "serverCommit", "started", "seconds", "sha256",
                  "allDiagnostics"],
}


def read_messages():
    """Messages and enums by their name in the package, and what is said of them."""
    with tempfile.NamedTemporaryFile() as found:
        subprocess.run(["protoc", "-I", os.path.join(TOP, "proto"), "--include_imports",
                        "--include_source_info", "--descriptor_set_out", found.name,
                        "trc/v1/job_record.proto"], check=True)
        files = descriptor_pb2.FileDescriptorSet.FromString(found.read()).file
    messages, enums, said = {}, {}, {}

    def add(message, name, path, comments):
        messages[name] = message
        said[name] = comments.get(path, "")
        for i, field in enumerate(message.field):
            said[name, field.json_name] = comments.get((*path, 2, i), "")
        for i, enum in enumerate(message.enum_type):
            enums[name + "." + enum.name] = enum
        for i, nested in enumerate(message.nested_type):
            add(nested, name + "." + nested.name, (*path, 3, i), comments)

    for file in files:
        comments = {tuple(place.path): " ".join(place.leading_comments.split())
                    for place in file.source_code_info.location}
        for i, message in enumerate(file.message_type):
            add(message, PACKAGE + message.name, (4, i), comments)
        for enum in file.enum_type:
            enums[PACKAGE + enum.name] = enum
    return messages, enums, said


class Schema:
    """Describes the record, and each message in it once."""

    def __init__(self):
        self.messages, self.enums, self.said = read_messages()
        self.described = {}

    def refer(self, name):
        short = name.removeprefix(PACKAGE)
        if short not in self.described:
            self.described[short] = {}
            self.described[short].update(self.message(name))
        return {"$ref": "#/$defs/" + short}

    def message(self, name):
        short = name.removeprefix(PACKAGE)
        schema = {"description": self.said[name], "type": "object", "additionalProperties": False}
        if short in REQUIRED:
            schema["required"] = REQUIRED[short]
        schema["properties"] = {field.json_name: self.field(name, field)
                                for field in self.messages[name].field}
        return schema

    def field(self, name, field):
        schema = {"description": self.said[name, field.json_name]}
        entry = self.messages.get(field.type_name)
        if entry is not None and entry.options.map_entry:
            key, value = entry.field
            if key.type != FIELD.TYPE_STRING:
                schema["propertyNames"] = {"pattern": "^[0-9]+$"}
            schema.update(type="object", additionalProperties=self.value(value))
        elif field.label == FIELD.LABEL_REPEATED:
            schema.update(type="array", items=self.value(field))
        else:
            schema.update(self.value(field))
        schema.update(BESIDES.get((name.removeprefix(PACKAGE), field.json_name), {}))
        return schema

    def value(self, field):
        if field.type == FIELD.TYPE_MESSAGE:
            return self.refer(field.type_name)
        if field.type == FIELD.TYPE_ENUM:
            return {"enum": [value.name for value in self.enums[field.type_name].value]}
        return {
            FIELD.TYPE_BOOL: {"type": "boolean"},
            FIELD.TYPE_DOUBLE: {"type": "number"},
            FIELD.TYPE_INT32: {"type": "integer"},
            FIELD.TYPE_UINT32: {"type": "integer", "minimum": 0},
            # JSON has no whole numbers of 64 bits.
            FIELD.TYPE_INT64: {"type": "string", "pattern": "^-?[0-9]+$"},
            FIELD.TYPE_UINT64: {"type": "string", "pattern": "^[0-9]+$"},
            FIELD.TYPE_STRING: {"type": "string"},
            FIELD.TYPE_BYTES: {"type": "string", "contentEncoding": "base64"},
        }[field.type]

    def document(self):
        record = self.message(PACKAGE + "JobRecord")
        return {
            "$schema": "https://json-schema.org/draft/2020-12/schema",
            "title": "Record of a job of trc",
            **record,
            "if": {"properties": {"outcome": {"const": "DONE"}}},
            "then": {"required": ["summary"]},
            "$defs": dict(sorted(self.described.items())),
        }


def text():
    return json.dumps(Schema().document(), indent=1, ensure_ascii=False) + "\n"


def filed():
    with open(SCHEMA, encoding="utf-8") as file:
        return file.read()


if __name__ == "__main__":
    if sys.argv[1:] == ["--fix"]:
        with open(SCHEMA, "w", encoding="utf-8") as file:
            file.write(text())
    elif filed() != text():
        sys.exit("proto/job_record.schema.json is not made of the messages: "
                 "tests/record/schema.py --fix")
