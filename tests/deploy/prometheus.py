"""Usage: prometheus.py URL DASHBOARD RULES

Asks a Prometheus whether all its targets are up, its rules are those of RULES, and each expression
of DASHBOARD has values.
"""

import json
import re
import sys
import time
import urllib.parse
import urllib.request


def ask(url, path, **query):
    with urllib.request.urlopen(f"{url}/api/v1/{path}?{urllib.parse.urlencode(query)}", timeout=10) as answer:
        return json.load(answer)["data"]


def faults(url, expressions, alerts):
    targets = ask(url, "targets", state="active")["activeTargets"]
    if len(targets) != 3:
        yield f"{len(targets)} targets"
    for target in targets:
        if target["health"] != "up":
            yield f"{target['scrapeUrl']}: {target['lastError']}"
    rules = {rule["name"] for group in ask(url, "rules")["groups"] for rule in group["rules"]
             if rule["health"] == "ok"}
    for name in sorted(alerts - rules):
        yield f"the rule {name} is missing or fails"
    for expression in expressions:
        plain = expression.replace("$__rate_interval", "1m").replace("$instance", ".*")
        values = ask(url, "query", query=plain)["result"]
        # Without TLS there is no certificate, and without refused certificates no count of them.
        if not values and "trc_tls_" not in expression:
            yield f"no values: {plain}"


def main(url, dashboard_file, rules_file):
    with open(dashboard_file, encoding="utf-8") as file:
        expressions = [t["expr"] for p in json.load(file)["panels"] for t in p["targets"]]
    with open(rules_file, encoding="utf-8") as file:
        alerts = set(re.findall(r"- alert: (\w+)", file.read()))
    end = time.monotonic() + 60
    while True:
        try:
            found = list(faults(url, expressions, alerts))
        except OSError as error:
            found = [str(error)]
        if not found or time.monotonic() > end:
            break
        time.sleep(2)
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
