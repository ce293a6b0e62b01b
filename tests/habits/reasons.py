#!/usr/bin/env python3
"""Fails where a remedy waits for a reason that nobody gives.

help_by_reason.cpp chooses a remedy by a part of the detail of a diagnostic. A reason of
core/base/reasons.h has to be named by who explains it and by who raises it; any other reason has to
stand in a string of who raises it, or in two strings one after the other, of which the first may be
a word of the program; or it is a command of the program, as in #OTC.

  tests/habits/reasons.py [--self-test]
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"')


def literals_of(source):
    """The strings in the source, with those that follow one another made one."""
    source = re.sub(r"//[^\n]*|'(?:[^'\\\n]|\\.)'", "", source)
    return LITERAL.findall(re.sub(r'"\s*\n\s*"', "", source))


def without_raiser(reason, literals):
    """Whether no literal, and no two, give the reason."""
    if re.fullmatch(r"#[A-Z]+=?", reason) or any(reason in literal for literal in literals):
        return False
    for at in (match.start() for match in re.finditer(r"[ ,]", reason)):
        head, tail = reason[:at], reason[at:]
        is_word = re.fullmatch(r"#?[A-Z0-9]+", head)
        begins = is_word or any(literal.rstrip(" ").endswith(head) for literal in literals)
        if head and begins and any(tail.lstrip(" ,") in literal for literal in literals):
            return False
    return True


def faults_in(constants, table, raisers, explainers):
    """What is wrong, a line each."""
    found = []
    for name in constants:
        for who, sources in (("raises", raisers), ("explains", explainers)):
            if not any(f"reason::{name}" in source for source in sources):
                found.append(f"core/base/reasons.h: nobody {who} {name}")
    literals = [literal for source in raisers for literal in literals_of(source)]
    for reason in re.findall(r'^    \{"((?:[^"\\]|\\.)*)"', table, re.MULTILINE):
        if without_raiser(reason, literals):
            found.append(f'help_by_reason.cpp: nobody gives the reason "{reason}"')
    return found


def self_test():
    table = '    {"a jump",\n    {"FL with RL",\n    {"no more",\n'
    raisers = ['refuse("a jump to");', 'word + " with RL or RR"', "reason::given"]
    found = faults_in(["given", "left"], table, raisers, ["reason::given, reason::left"])
    assert found == ["core/base/reasons.h: nobody raises left",
                     'help_by_reason.cpp: nobody gives the reason "no more"'], found


def main():
    if "--self-test" in sys.argv:
        self_test()
    messages = ROOT / "core" / "messages"
    texts = {path: path.read_text() for path in (ROOT / "core").rglob("*.[ch]*")
             if path.suffix in (".h", ".cpp")}
    reasons = ROOT / "core" / "base" / "reasons.h"
    raisers = [text for path, text in texts.items()
               if messages not in path.parents and path != reasons]
    explainers = [text for path, text in texts.items() if messages in path.parents]
    constants = re.findall(r"std::string_view (\w+) =", texts[reasons])
    assert constants, reasons
    found = faults_in(constants, texts[messages / "help_by_reason.cpp"], raisers, explainers)
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
