"""Usage: expressions.py RULES DASHBOARD METRICS OUTPUT

Says which metric or label of the alert rules and the dashboard is missing in METRICS, the text a
server exports, and writes the dashboard's expressions as recording rules to OUTPUT, so that promtool
can check them.
"""

import json
import re
import sys

OURS = re.compile(r"\b((?:trc|grpc_server)_[a-z_]+)(\{[^}]*\})?")
LABEL = re.compile(r'([a-z_]+) *(?:=~|!~|!=|=)')
GROUPING = re.compile(r"\b(?:by|without) *\(([^)]*)\)")
# Prometheus adds these.
ADDED = {"job", "instance"}


def exported(text):
    """Metric name → names of its labels."""
    labels = {}
    for line in text.splitlines():
        if line and not line.startswith("#"):
            name = re.match(r"[a-z_]+", line).group()
            labels.setdefault(name, set()).update(re.findall(r'([a-z_]+)="', line))
    return labels


def faults_of(expression, labels):
    grouping = {g.strip() for group in GROUPING.findall(expression) for g in group.split(",")}
    used = OURS.findall(GROUPING.sub(" ", expression))
    if not used and "haproxy_" not in expression and "up{" not in expression:
        yield "names no metric of the server"
    known = set(ADDED)
    for name, selector in used:
        if name not in labels:
            yield f"{name} is not exported"
            continue
        known |= labels[name]
        for label in LABEL.findall(selector):
            if label not in labels[name] | ADDED:
                yield f"{name} has no label {label}"
    if used:
        for label in grouping - known:
            yield f"nothing has the label {label}"


def panels_of(dashboard):
    for panel in dashboard["panels"]:
        yield panel
        yield from panel.get("panels", [])


def main(rules_file, dashboard_file, metrics_file, output_file):
    with open(metrics_file, encoding="utf-8") as file:
        labels = exported(file.read())
    with open(dashboard_file, encoding="utf-8") as file:
        dashboard = json.load(file)
    with open(rules_file, encoding="utf-8") as file:
        alerts = re.findall(r"^ *expr: (.*)$", file.read(), re.MULTILINE)

    shown = []
    for panel in panels_of(dashboard):
        if not panel["targets"]:
            sys.exit(f"the panel '{panel['title']}' is empty")
        shown += [target["expr"] for target in panel["targets"]]
    known_variables = {v["name"] for v in dashboard["templating"]["list"]} | {"__rate_interval"}
    bad = [f"{e}: ${v} is not known" for e in shown for v in re.findall(r"\$(\w+)", e)
           if v not in known_variables]
    bad += [f"{e}: {fault}" for e in alerts + shown for fault in faults_of(e, labels)]
    covered = {name for e in shown for name, _ in OURS.findall(e)}
    families = {re.sub("_(bucket|sum|count)$", "", name) for name in labels}
    families -= {re.sub("_(bucket|sum|count)$", "", name) for name in covered}
    families -= {"trc_tls_certificate_reloads_total"}  # an alert is enough
    bad += [f"{name} is exported and not on the dashboard" for name in
            sorted(f for f in families if OURS.match(f))]
    print(*bad, sep="\n", end="\n" if bad else "")

    with open(output_file, "w", encoding="utf-8") as file:
        file.write("groups:\n  - name: dashboard\n    rules:\n")
        for number, expression in enumerate(shown):
            plain = expression.replace("$__rate_interval", "1m").replace("$instance", ".*")
            file.write(f"      - record: dashboard:{number}\n        expr: {json.dumps(plain)}\n")
    return 1 if bad or not alerts or not shown else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
